// Comparing two steps whose grids differ: means on the coarser grid, over all levels together.
#pragma once
#include "framework/archive/compare/compare.hpp"
#include "framework/archive/compare/step_log.hpp"

namespace sluice {

// InputError where the grids do not nest, or the second does not hold the domain of the first.
void compare_means(const ArchiveStep& a, const ArchiveStep& b, const CompareOptions& options,
                   StepLog& log);

}  // namespace sluice
