// Where a part of a component stands among all: numbers of effects, reductions, faults, materials.
//
// A component may be made of parts that each count their own from 0: a fluid and a solid in one
// step, declared into one list of tasks. The list adds these places, so that a part reads the same
// alone and beside others.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "framework/field/label.hpp"
#include "framework/task/reduction_layout.hpp"

namespace sluice {

// Of what a row kernel reduces.
struct ReductionOffsets {
  int maximum = 0, sum = 0, fault = 0;
  const std::vector<int>* material = nullptr;  // null: as the part counts them
};

struct IndexOffsets {
  int effect = 0;             // of the part's first effect in the EffectList
  MaximumGroup maxima;        // its own among those of the step
  SumGroup sums;              // likewise
  int fault = 0;              // added to the kinds of its faults
  std::vector<int> material;  // the scene's number of each of its own; empty: the same
  std::vector<Label> common;  // what all materials share is saved as of the scene's first

  int output_of(Label label, int own) const {
    return std::find(common.begin(), common.end(), label) == common.end() ? material_of(own) : 0;
  }
  int material_of(int own) const { return material.empty() ? own : material[own]; }
  ReductionOffsets reduction_offsets() const {
    return {maxima.first(), sums.first(), fault, material.empty() ? nullptr : &material};
  }
};

}  // namespace sluice
