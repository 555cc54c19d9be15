// Exact sums over the cells of a row that no finer level covers.
#pragma once
#include <algorithm>

#include "framework/refine/coverage.hpp"
#include "framework/task/reductions.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// m^3.
inline double cell_volume(const Row& row) {
  const Vec3 dx = row.step().spacing;
  return dx.x * dx.y * dx.z;
}

// Calls use(first, end), counted from the begin of the row, for each uncovered part of the row's
// cells first to end - 1.
template <class Use>
void for_uncovered(const Row& row, const SchemeOptions& o, int first, int end, Use&& use) {
  if (o.budgets.coverage == nullptr || !o.budgets.coverage->any()) return use(first, end);
  const int low = row.cell()[o.grid.axes.direction[0]];
  for (const LevelCoverage::Segment& s :
       o.budgets.coverage->uncovered_in_row(row.box(), row.cell())) {
    const int from = std::max(s.first - low, first), to = std::min(s.first - low + s.count, end);
    if (from < to) use(from, to);
  }
}
template <class Use>
void for_uncovered(const Row& row, const SchemeOptions& o, Use&& use) {
  for_uncovered(row, o, 0, row.count(), use);
}

// Adds value(i) of the cells first to end - 1, in any unit, to a sum of the step.
template <class Value>
void add_to_sum(ExactSum& sum, int first, int end, Value value) {
  constexpr int chunk = 256;
  double values[chunk];
  for (int begin = first; begin < end; begin += chunk) {
    const int n = std::min(chunk, end - begin);
    for (int i = 0; i < n; ++i) values[i] = value(begin + i);
    sum.add(values, n);
  }
}

}  // namespace sluice::ice
