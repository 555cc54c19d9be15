// Finding the runs: plane by plane, so that no more than one plane of cells is ever held.
#include "ice/step/cell_runs.hpp"

#include <algorithm>
#include <cmath>

#include "framework/geometry/sampling.hpp"

namespace sluice::ice {
namespace {

int first_active(const Level& level) {
  for (int d = 0; d < 3; ++d)
    if (level.active[d]) return d;
  return 0;
}

// Cells of the domain whose centres may lie within the bounds.
IndexBox cells_around(const Bounds& bounds, const Level& level) {
  IndexBox box = level.domain;
  for (int d = 0; d < 3; ++d) {
    const auto index = [&](double x, int fallback) {
      const double cell = std::floor((x - level.anchor[d]) / level.spacing[d]);
      if (!(cell > level.domain.lower[d] && cell < level.domain.upper[d])) return fallback;
      return static_cast<int>(cell);
    };
    const bool after = bounds.lower[d] > level.anchor[d] + level.spacing[d] * box.upper[d];
    const bool before = bounds.upper[d] < level.anchor[d] + level.spacing[d] * box.lower[d];
    if (after || before) box.upper[d] = box.lower[d];
    if (after || before) continue;
    box.lower[d] = std::max(level.domain.lower[d], index(bounds.lower[d], box.lower[d]) - 1);
    box.upper[d] = std::min(level.domain.upper[d], index(bounds.upper[d], box.upper[d]) + 2);
  }
  return box;
}

}  // namespace

CellRuns::CellRuns(const GeometryPiece& piece, const Level& level)
    : along_(first_active(level)), box_(cells_around(piece.bounds(), level)) {
  const CellLattice lattice{level.anchor, level.spacing};
  const int a = along_, b = (a + 1) % 3, c = (a + 2) % 3;
  begin_.push_back(0);
  if (box_.empty()) return;
  for (int k = box_.lower[c]; k < box_.upper[c]; ++k) {
    IntVec3 low = box_.lower, high = box_.upper;
    low[c] = k;
    high[c] = k + 1;
    const std::vector<std::int32_t> inside =
        count_inside(piece, lattice, low, high, IntVec3::all(1));
    // The counts run x fastest, whatever the direction of rows is.
    const IntVec3 size = {high.x - low.x, high.y - low.y, high.z - low.z};
    const std::ptrdiff_t strides[3] = {1, size.x, std::ptrdiff_t{size.x} * size.y};
    for (int j = low[b]; j < high[b]; ++j) {
      const std::int32_t* row = inside.data() + (j - low[b]) * strides[b];
      for (int i = 0; i < size[a]; ++i) {
        if (row[i * strides[a]] == 0) continue;
        const int first = i;
        while (i < size[a] && row[i * strides[a]] != 0) ++i;
        runs_.push_back({low[a] + first, low[a] + i});
      }
      begin_.push_back(runs_.size());
    }
  }
}

std::size_t CellRuns::row_of(IntVec3 cell) const {
  const int b = (along_ + 1) % 3, c = (along_ + 2) % 3;
  return static_cast<std::size_t>(cell[c] - box_.lower[c]) * (box_.upper[b] - box_.lower[b]) +
         (cell[b] - box_.lower[b]);
}

std::span<const CellRuns::Run> CellRuns::runs(IntVec3 cell) const {
  cell[along_] = box_.lower[along_];
  if (!box_.contains(cell)) return {};
  const std::size_t row = row_of(cell);
  return std::span(runs_).subspan(begin_[row], begin_[row + 1] - begin_[row]);
}

bool CellRuns::contains(IntVec3 cell) const {
  for (const Run& run : runs(cell))
    if (run.first <= cell[along_] && cell[along_] < run.end) return true;
  return false;
}

}  // namespace sluice::ice
