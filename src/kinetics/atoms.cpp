#include "kinetics/atoms.hpp"

#include <array>
#include <cctype>
#include <string>
#include <utility>

namespace sluice::kinetics {
namespace {

constexpr std::array<std::pair<std::string_view, double>, 22> grams_per_mole = {{
    {"H", 1.008},        {"HE", 4.002602}, {"LI", 6.94},        {"BE", 9.0121831},
    {"B", 10.81},        {"C", 12.011},    {"N", 14.007},       {"O", 15.999},
    {"F", 18.998403162}, {"NE", 20.1797},  {"NA", 22.98976928}, {"MG", 24.305},
    {"AL", 26.9815384},  {"SI", 28.085},   {"P", 30.973761998}, {"S", 32.06},
    {"CL", 35.45},       {"AR", 39.95},    {"K", 39.0983},      {"CA", 40.078},
    {"KR", 83.798},      {"XE", 131.293},
}};

}  // namespace

std::optional<double> atomic_mass(std::string_view symbol) {
  std::string capitals;
  for (const char letter : symbol)
    capitals += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  for (const auto& [name, mass] : grams_per_mole)
    if (name == capitals) return mass * 1e-3;
  return std::nullopt;
}

}  // namespace sluice::kinetics
