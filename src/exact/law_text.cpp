#include "exact/law_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <functional>
#include <sstream>
#include <utility>
#include <vector>

#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

template <class Law>
struct Parameter {
  const char* name;
  double Law::*member;
};

// One list of parameters a law, in the order of the law's own file.
inline constexpr Parameter<eos::IdealGas> ideal_gas[] = {
    {"gamma", &eos::IdealGas::gamma}, {"specific_heat", &eos::IdealGas::specific_heat}};
inline constexpr Parameter<eos::StiffenedGas> stiffened_gas[] = {
    {"gamma", &eos::StiffenedGas::gamma},
    {"pinf", &eos::StiffenedGas::pinf},
    {"q", &eos::StiffenedGas::q},
    {"specific_heat", &eos::StiffenedGas::specific_heat}};
inline constexpr Parameter<eos::HardSphereGas> hard_sphere_gas[] = {
    {"gamma", &eos::HardSphereGas::gamma},
    {"b", &eos::HardSphereGas::b},
    {"specific_heat", &eos::HardSphereGas::specific_heat}};
inline constexpr Parameter<eos::TstGas> tst[] = {
    {"a", &eos::TstGas::a},         {"b", &eos::TstGas::b},
    {"u", &eos::TstGas::u},         {"w", &eos::TstGas::w},
    {"Gamma", &eos::TstGas::Gamma}, {"specific_heat", &eos::TstGas::specific_heat}};
inline constexpr Parameter<eos::Jwl> jwl[] = {{"A", &eos::Jwl::A},
                                              {"B", &eos::Jwl::B},
                                              {"R1", &eos::Jwl::R1},
                                              {"R2", &eos::Jwl::R2},
                                              {"om", &eos::Jwl::om},
                                              {"rho0", &eos::Jwl::rho0},
                                              {"specific_heat", &eos::Jwl::specific_heat}};
inline constexpr Parameter<eos::Jwlc> jwlc[] = {
    {"A", &eos::Jwlc::A},       {"B", &eos::Jwlc::B},
    {"C", &eos::Jwlc::C},       {"R1", &eos::Jwlc::R1},
    {"R2", &eos::Jwlc::R2},     {"om", &eos::Jwlc::om},
    {"rho0", &eos::Jwlc::rho0}, {"specific_heat", &eos::Jwlc::specific_heat}};
inline constexpr Parameter<eos::Murnaghan> murnaghan[] = {
    {"n", &eos::Murnaghan::n},
    {"K", &eos::Murnaghan::K},
    {"rho0", &eos::Murnaghan::rho0},
    {"P0", &eos::Murnaghan::P0},
    {"specific_heat", &eos::Murnaghan::specific_heat}};
inline constexpr Parameter<eos::BirchMurnaghan> birch_murnaghan[] = {
    {"n", &eos::BirchMurnaghan::n},
    {"K", &eos::BirchMurnaghan::K},
    {"rho0", &eos::BirchMurnaghan::rho0},
    {"P0", &eos::BirchMurnaghan::P0},
    {"specific_heat", &eos::BirchMurnaghan::specific_heat}};
inline constexpr Parameter<eos::MieGruneisen> mie_gruneisen[] = {
    {"C0", &eos::MieGruneisen::C0},         {"S", &eos::MieGruneisen::S},
    {"Gamma0", &eos::MieGruneisen::Gamma0}, {"rho0", &eos::MieGruneisen::rho0},
    {"T0", &eos::MieGruneisen::T0},         {"specific_heat", &eos::MieGruneisen::specific_heat}};
inline constexpr Parameter<eos::LinearGruneisen> linear_gruneisen[] = {
    {"A", &eos::LinearGruneisen::A},       {"B", &eos::LinearGruneisen::B},
    {"rho0", &eos::LinearGruneisen::rho0}, {"T0", &eos::LinearGruneisen::T0},
    {"P0", &eos::LinearGruneisen::P0},     {"specific_heat", &eos::LinearGruneisen::specific_heat}};
inline constexpr Parameter<eos::Tillotson> tillotson[] = {
    {"a", &eos::Tillotson::a},
    {"b", &eos::Tillotson::b},
    {"A", &eos::Tillotson::A},
    {"B", &eos::Tillotson::B},
    {"E0", &eos::Tillotson::E0},
    {"Es", &eos::Tillotson::Es},
    {"Esp", &eos::Tillotson::Esp},
    {"alpha", &eos::Tillotson::alpha},
    {"beta", &eos::Tillotson::beta},
    {"rho0", &eos::Tillotson::rho0},
    {"specific_heat", &eos::Tillotson::specific_heat}};
inline constexpr Parameter<eos::ThomsenHartkaWater> thomsen_hartka[] = {
    {"a", &eos::ThomsenHartkaWater::a},   {"b", &eos::ThomsenHartkaWater::b},
    {"co", &eos::ThomsenHartkaWater::co}, {"ko", &eos::ThomsenHartkaWater::ko},
    {"To", &eos::ThomsenHartkaWater::To}, {"L", &eos::ThomsenHartkaWater::L},
    {"vo", &eos::ThomsenHartkaWater::vo}};
inline constexpr Parameter<eos::KnaussSeaWater> knauss[] = {
    {"a", &eos::KnaussSeaWater::a},
    {"b", &eos::KnaussSeaWater::b},
    {"K", &eos::KnaussSeaWater::K},
    {"T0", &eos::KnaussSeaWater::T0},
    {"P0", &eos::KnaussSeaWater::P0},
    {"S", &eos::KnaussSeaWater::S},
    {"S0", &eos::KnaussSeaWater::S0},
    {"rho0", &eos::KnaussSeaWater::rho0},
    {"specific_heat", &eos::KnaussSeaWater::specific_heat}};

using Values = std::vector<std::pair<std::string, double>>;

template <class Law, std::size_t size>
eos::EquationOfState filled(const Parameter<Law> (&parameters)[size], const std::string& name,
                            const Values& values) {
  Law law{};
  for (const auto& [key, value] : values) {
    bool found = false;
    std::string known;
    for (const auto& parameter : parameters) {
      known += (known.empty() ? "" : ", ") + std::string(parameter.name);
      if (key != parameter.name) continue;
      law.*parameter.member = value;
      found = true;
    }
    if (!found) {
      throw InputError(fmt::format("equation of state {} has no parameter '{}'; it knows: {}", name,
                                   key, known));
    }
  }
  return law;
}

struct LawText {
  const char* name;
  std::function<eos::EquationOfState(const std::string&, const Values&)> make;
};

const std::vector<LawText>& texts() {
  const auto of = [](const auto& parameters) {
    return [&parameters](const std::string& name, const Values& values) {
      return filled(parameters, name, values);
    };
  };
  static const std::vector<LawText> all = {{"ideal_gas", of(ideal_gas)},
                                           {"StiffenedGas", of(stiffened_gas)},
                                           {"hard_sphere_gas", of(hard_sphere_gas)},
                                           {"TST", of(tst)},
                                           {"JWL", of(jwl)},
                                           {"JWLC", of(jwlc)},
                                           {"Murnaghan", of(murnaghan)},
                                           {"BirchMurnaghan", of(birch_murnaghan)},
                                           {"MieGruneisen", of(mie_gruneisen)},
                                           {"Gruneisen", of(linear_gruneisen)},
                                           {"Tillotson", of(tillotson)},
                                           {"Thomsen_Hartka_water", of(thomsen_hartka)},
                                           {"KnaussSeaWater", of(knauss)}};
  return all;
}

double number(const std::string& word, const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [next, fault] = std::from_chars(text.data(), end, value);
  if (fault != std::errc{} || next != end || !std::isfinite(value)) {
    throw InputError(fmt::format(
        "equation of state: '{}' holds no number; expected NAME=NUMBER such as gamma=1.4", word));
  }
  return value;
}

}  // namespace

std::string known_laws() {
  std::string known;
  for (const LawText& kind : texts()) known += (known.empty() ? "" : ", ") + std::string(kind.name);
  return known;
}

std::string law_name(const eos::EquationOfState& law) {
  const std::size_t index = law.index();  // the list above has the variant's order
  return index < texts().size() ? texts()[index].name : "thermally perfect gas";
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
  for (const LawText& kind : texts()) {
    if (name == kind.name) return kind.make(name, values);
  }
  throw InputError(
      fmt::format("there is no equation of state '{}'; known are: {}", name, known_laws()));
}

}  // namespace sluice::exact
