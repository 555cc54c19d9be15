// Words matched to options.
#include "app/classic/classic_arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "framework/archive/xml_text.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/nearest_name.hpp"

namespace sluice {
namespace {

// -timestepLow and --timestep_low are one option.
std::string plain_name(std::string_view word) {
  std::string plain;
  for (const char c : word)
    if (c != '-' && c != '_')
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return plain;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool looks_like_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' &&
         std::isalpha(static_cast<unsigned char>(word[word[1] == '-' ? 2 : 1])) != 0;
}

}  // namespace

std::string usage_of(const ClassicSpec& spec) {
  std::string text = fmt::format("Usage: {} {}\n\nValid options are:\n", spec.name, spec.arguments);
  for (const ClassicOption& o : spec.options) {
    std::string names = o.names;
    if (!o.values.empty()) names += ' ' + o.values;
    text += fmt::format("  {:<44} {}\n", names, o.text);
  }
  return text;
}

ClassicArguments::ClassicArguments(ClassicSpec spec, const std::vector<std::string>& words)
    : spec_(std::move(spec)) {
  for (std::size_t n = 0; n < words.size(); ++n) {
    if (!looks_like_option(words[n])) {
      positional_.push_back(words[n]);
      continue;
    }
    const ClassicOption& option = find(words[n]);
    const std::size_t count = words_of(option.values).size();
    if (n + count >= words.size()) refuse(fmt::format("{} takes {}", words[n], option.values));
    const auto first = words.begin() + static_cast<std::ptrdiff_t>(n) + 1;
    given_[words_of(option.names).front()].emplace_back(first,
                                                        first + static_cast<std::ptrdiff_t>(count));
    n += count;
  }
}

const ClassicOption& ClassicArguments::find(const std::string& word) const {
  std::vector<std::string> known;
  for (const ClassicOption& o : spec_.options)
    for (const std::string& name : words_of(o.names)) {
      if (plain_name(name) == plain_name(word)) return o;
      known.push_back(name);
    }
  refuse(fmt::format("there is no option {} ({})", word, suggest_name(word, known)));
}

void ClassicArguments::refuse(const std::string& why) const {
  throw InputError(fmt::format("{}\n\n{}", why, usage_of(spec_)));
}

const std::string& ClassicArguments::value(const std::string& option, std::size_t n) const {
  return given_.at(option).back().at(n);
}

std::string ClassicArguments::text(const std::string& option, const std::string& fallback) const {
  return has(option) ? value(option, 0) : fallback;
}

int ClassicArguments::integer(const std::string& option, int fallback) const {
  return has(option) ? parse_int(value(option, 0), option) : fallback;
}

double ClassicArguments::real(const std::string& option, double fallback) const {
  return has(option) ? parse_real(value(option, 0), option) : fallback;
}

std::optional<IntVec3> ClassicArguments::integers(const std::string& option) const {
  if (!has(option)) return std::nullopt;
  IntVec3 v;
  for (int d = 0; d < 3; ++d) v[d] = parse_int(value(option, static_cast<std::size_t>(d)), option);
  return v;
}

std::optional<std::pair<int, int>> ClassicArguments::pair(const std::string& option) const {
  if (!has(option)) return std::nullopt;
  return std::pair{parse_int(value(option, 0), option), parse_int(value(option, 1), option)};
}

std::optional<Vec3> ClassicArguments::reals(const std::string& option, std::size_t first) const {
  if (!has(option)) return std::nullopt;
  Vec3 v;
  for (int d = 0; d < 3; ++d)
    v[d] = parse_real(value(option, first + static_cast<std::size_t>(d)), option);
  return v;
}

std::vector<std::string> ClassicArguments::all(const std::string& option) const {
  std::vector<std::string> values;
  if (has(option))
    for (const std::vector<std::string>& one : given_.at(option)) values.push_back(one.front());
  return values;
}

const std::string& ClassicArguments::only_positional(const char* what) const {
  if (positional_.empty()) refuse(fmt::format("no {} is given", what));
  if (positional_.size() > 1)
    refuse(fmt::format("one {} is expected, '{}' is a second", what, positional_[1]));
  return positional_.front();
}

}  // namespace sluice
