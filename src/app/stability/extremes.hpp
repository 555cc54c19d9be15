// The least and largest value of a saved label, with their places.
#pragma once
#include <string>
#include <vector>

namespace sluice {

struct LabelRequest {
  std::string name;  // of cells, faces, nodes or particles
  int material = 0, component = 0;
};

struct PlacedValue {
  double value = 0;   // in the unit of the label
  std::string place;  // "step 12, t = 0.5, level 0, cell [3, 4, 0]"
};

struct Extremes {
  PlacedValue least, most;  // a value that is not a number is both
};

// Of the last output of an archive, or of each in their order, on all levels; outputs without a
// value (all particles are gone) are left out. InputError where the archive has no output or an
// output does not have the label.
std::vector<Extremes> extremes_of(const std::string& archive, const LabelRequest& label,
                                  bool all_outputs);

}  // namespace sluice
