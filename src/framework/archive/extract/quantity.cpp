// Splitting names of parts from labels, whose names have dots as well; invariants of tensors.
#include "framework/archive/extract/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "framework/base/error.hpp"
#include "framework/field/component_name.hpp"

namespace sluice {
namespace {

std::optional<ValueType> type_of(const ArchiveStep& step, const std::string& label) {
  for (const std::vector<FieldInfo>* fields : {&step.fields(), &step.particle_fields()})
    for (const FieldInfo& f : *fields)
      if (f.name == label) return f.type;
  return std::nullopt;
}

std::optional<Quantity> part_of(const std::string& label, ValueType type, const std::string& word) {
  const int count = component_count(type);
  for (int c = 0; count > 1 && c < count; ++c)
    if (word == component_name(count, c)) return Quantity{label, Part::component, c};
  if (count > 1 && word == "size") return Quantity{label, Part::size};
  if (count != 9) return std::nullopt;
  static const std::map<std::string, Part> invariants = {
      {"vonMises", Part::von_mises}, {"pressure", Part::pressure}, {"det", Part::determinant}};
  const auto found = invariants.find(word);
  if (found == invariants.end()) return std::nullopt;
  return Quantity{label, found->second};
}

// sqrt(3/2 s:s), s = t - tr(t)/3 1
double von_mises(const double* t) {
  const double mean = (t[0] + t[4] + t[8]) / 3;
  double sum = 0;
  for (int c = 0; c < 9; ++c) {
    const double s = t[c] - (c % 4 == 0 ? mean : 0);
    sum += s * s;
  }
  return std::sqrt(1.5 * sum);
}

double determinant(const double* t) {
  return t[0] * (t[4] * t[8] - t[5] * t[7]) - t[1] * (t[3] * t[8] - t[5] * t[6]) +
         t[2] * (t[3] * t[7] - t[4] * t[6]);
}

double size_of_values(const double* v, int count) {
  double sum = 0;
  for (int c = 0; c < count; ++c) sum += v[c] * v[c];
  return std::sqrt(sum);
}

}  // namespace

void Quantity::evaluate(const double* components, int components_count, double* numbers) const {
  switch (part) {
    case Part::all:
      std::copy_n(components, components_count, numbers);
      break;
    case Part::component:
      *numbers = components[component];
      break;
    case Part::size:
      *numbers = size_of_values(components, components_count);
      break;
    case Part::von_mises:
      *numbers = von_mises(components);
      break;
    case Part::pressure:
      *numbers = -(components[0] + components[4] + components[8]) / 3;
      break;
    case Part::determinant:
      *numbers = determinant(components);
      break;
  }
}

Quantity find_quantity(const ArchiveStep& step, const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (type_of(step, name) || dot == std::string::npos) return {name};
  const std::string label = name.substr(0, dot);
  const std::optional<ValueType> type = type_of(step, label);
  if (!type) return {name};
  if (const auto quantity = part_of(label, *type, name.substr(dot + 1))) return *quantity;
  const char* const parts =
      component_count(*type) == 9 ? "is a tensor: its parts are xx, xy to zz, vonMises, pressure, "
                                    "det and size"
      : component_count(*type) == 3 ? "is a vector: its parts are x, y, z and size"
                                    : "is one number: it has no parts";
  throw InputError(fmt::format("{}: {} {}", name, label, parts));
}

}  // namespace sluice
