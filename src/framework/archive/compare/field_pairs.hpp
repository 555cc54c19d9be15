// Labels of two steps that mean the same, on all levels, and whether their grids are the same.
#pragma once
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"
#include "framework/archive/compare/label_names.hpp"
#include "framework/archive/selection.hpp"

namespace sluice {

// A label of one material on the levels that have it.
struct PairedFields {
  std::vector<FieldInfo> of_a, of_b;  // by level; of_b is empty where the second has none
  const FieldInfo* of_second(int level) const;
};

// Every label and material of the first that the filter selects, with that of the second of the
// same type and centring; between formats by label_names.hpp, `names` before its table.
std::vector<PairedFields> pair_fields(const ArchiveStep& a, const ArchiveStep& b,
                                      const LabelFilter& labels,
                                      const std::vector<LabelName>& names);

// Whether a level of the first is not one of the second, with the same spacing, or (above the
// coarsest) has cells that the second does not have.
bool grids_differ(const Grid& a, const Grid& b);

}  // namespace sluice
