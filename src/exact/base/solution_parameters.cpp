#include "exact/base/solution_parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>

#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

// Reads "[a, b, c]", "a b c" or "a"; false when anything else is in the text.
bool read_reals(const std::string& text, std::vector<double>& out) {
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    if (*at == ' ' || *at == ',' || *at == '[' || *at == ']' || *at == '\n' || *at == '\t') {
      ++at;
      continue;
    }
    if (*at == '+') ++at;
    double value = 0;
    const auto [next, fault] = std::from_chars(at, end, value);
    if (fault != std::errc{} || !std::isfinite(value)) return false;
    out.push_back(value);
    at = next;
  }
  return !out.empty();
}

}  // namespace

const std::string& SolutionParameters::text(const std::string& name) const {
  used_.insert(name);
  const auto found = values_.find(name);
  if (found == values_.end()) {
    throw InputError(
        fmt::format("exact solution '{}' needs the parameter <{}>; add it", type_, name));
  }
  return found->second;
}

void SolutionParameters::refuse(const std::string& name, const std::string& expected) const {
  throw InputError(fmt::format("exact solution '{}': parameter <{}> is '{}', expected {}", type_,
                               name, values_.at(name), expected));
}

std::vector<double> SolutionParameters::reals(const std::string& name) const {
  std::vector<double> out;
  if (!read_reals(text(name), out)) refuse(name, "numbers such as [1, 0, 0.1]");
  return out;
}

std::vector<double> SolutionParameters::state(const std::string& name) const {
  const std::vector<double> values = reals(name);
  if (values.size() == 3) return values;
  throw InputError(
      fmt::format("exact solution '{}': <{}> holds {} numbers, expected [density, velocity, "
                  "pressure]",
                  type_, name, values.size()));
}

double SolutionParameters::real(const std::string& name) const {
  const auto values = reals(name);
  if (values.size() != 1) refuse(name, "one number");
  return values[0];
}

double SolutionParameters::real(const std::string& name, double fallback) const {
  used_.insert(name);
  return has(name) ? real(name) : fallback;
}

double SolutionParameters::positive(const std::string& name) const {
  const double value = real(name);
  if (!(value > 0)) refuse(name, "a number above zero");
  return value;
}

double SolutionParameters::positive(const std::string& name, double fallback) const {
  used_.insert(name);
  return has(name) ? positive(name) : fallback;
}

int SolutionParameters::integer(const std::string& name, int fallback, int low, int high) const {
  used_.insert(name);
  if (!has(name)) return fallback;
  const double value = real(name);
  if (value != std::floor(value) || value < low || value > high) {
    refuse(name, fmt::format("a whole number from {} to {}", low, high));
  }
  return static_cast<int>(value);
}

Vec3 SolutionParameters::vector(const std::string& name) const {
  const auto values = reals(name);
  if (values.size() != 3) refuse(name, "a vector [x, y, z]");
  return {values[0], values[1], values[2]};
}

Vec3 SolutionParameters::vector(const std::string& name, Vec3 fallback) const {
  used_.insert(name);
  return has(name) ? vector(name) : fallback;
}

void SolutionParameters::refuse_unused() const {
  for (const auto& [name, value] : values_) {
    if (used_.contains(name)) continue;
    throw InputError(fmt::format("exact solution '{}' has no parameter <{}>; it knows: {}", type_,
                                 name, fmt::join(used_, ", ")));
  }
}

}  // namespace sluice::exact
