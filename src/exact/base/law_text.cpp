#include "exact/base/law_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

using Values = std::vector<std::pair<std::string, double>>;

template <class Law>
eos::EquationOfState filled(const Values& values) {
  Law law{};
  for (const auto& [key, value] : values) {
    bool found = false;
    std::string known;
    for (const auto& parameter : Law::parameters()) {
      known += (known.empty() ? "" : ", ") + std::string(parameter.name);
      if (key != parameter.name) continue;
      law.*parameter.member = value;
      found = true;
    }
    if (!found) {
      throw InputError(fmt::format("equation of state {} has no parameter '{}'; it knows: {}",
                                   Law::name, key, known));
    }
  }
  return law;
}

double number(const std::string& word, const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [next, fault] = std::from_chars(text.data(), end, value);
  if (fault != std::errc{} || next != end || !std::isfinite(value)) {
    throw InputError(fmt::format(
        "equation of state: '{}' contains no number; expected NAME=NUMBER such as gamma=1.4",
        word));
  }
  return value;
}

}  // namespace

std::string known_laws() {
  std::string known;
  eos::AllLaws::for_each([&]<class Law>() {
    if constexpr (eos::is_named_by_decks<Law>())
      known += (known.empty() ? "" : ", ") + std::string(Law::name);
  });
  return known;
}

eos::EquationOfState law_from_text(const std::string& text) {
  std::istringstream words(text);
  std::string name, word;
  words >> name;
  Values values;
  while (words >> word) {
    const auto equals = word.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw InputError(fmt::format(
          "equation of state: '{}' is not NAME=NUMBER; write for instance ideal_gas gamma=1.4",
          word));
    }
    values.emplace_back(word.substr(0, equals), number(word, word.substr(equals + 1)));
  }
  std::optional<eos::EquationOfState> law;
  eos::AllLaws::for_each([&]<class Law>() {
    if constexpr (eos::is_named_by_decks<Law>())
      if (name == Law::name) law = filled<Law>(values);
  });
  if (law) return *law;
  throw InputError(
      fmt::format("there is no equation of state '{}'; known are: {}", name, known_laws()));
}

}  // namespace sluice::exact
