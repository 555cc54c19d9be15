// The least and the largest value of a saved label, with their places.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"

namespace sluice {

struct ValuePlace {
  double value = 0;            // in the unit of the label
  Vec3 at;                     // m
  IntVec3 index{};             // of a cell, face or node
  std::int64_t particle = -1;  // its number; -1: a value of the grid
};
// "cell [3, 4, 0]", "x face [1, 0, 0]" or "particle 12".
std::string place_text(const FieldInfo& field, const ValuePlace& place);

// Of one component of a label, of one material and level.
struct FieldExtremes {
  FieldInfo field;
  int component = 0;
  std::int64_t values = 0;                // that are numbers
  std::int64_t not_numbers = 0;           // NaN: where the material is absent, or a fault
  std::optional<ValuePlace> least, most;  // among the numbers
  std::optional<ValuePlace> first_nan;
};

// `field`: of the grid or of particles. Values that a finer level covers count as well.
FieldExtremes extremes_of(const ArchiveStep& step, const FieldInfo& field, int component);

// Of every label, component, material and level that the step holds; the numbers of particles are
// left out.
std::vector<FieldExtremes> all_extremes(const ArchiveStep& step);

}  // namespace sluice
