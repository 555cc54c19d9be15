// What users ask for by name: a label, or one number of it, as vel_CC.x or p.stress.vonMises.
#pragma once
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"

namespace sluice {

// Parts of a vector: x, y, z, size. Of a tensor t with the deviator s: xx to zz, vonMises
// sqrt(3/2 s:s), pressure -tr(t)/3, det, size sqrt(t:t). In the unit of the label, det in its cube.
enum class Part { all, component, size, von_mises, pressure, determinant };

struct Quantity {
  std::string label;
  Part part = Part::all;
  int component = 0;  // of Part::component

  int count(ValueType type) const { return part == Part::all ? component_count(type) : 1; }
  // From all components of a place to `count` numbers.
  void evaluate(const double* components, int components_count, double* numbers) const;
};

// A label of this name in the step, of the grid or of particles, else a part of one. InputError for
// a part that the label does not have; a label that is not there at all is left to select_fields.
Quantity find_quantity(const ArchiveStep& step, const std::string& name);

}  // namespace sluice
