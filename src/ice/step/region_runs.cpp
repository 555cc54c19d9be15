// Finding the runs.
#include "ice/step/region_runs.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::ice {
namespace {

// Cells of the domain whose centres may lie in the bounds.
IndexBox cells_of(const Bounds& bounds, const Level& level) {
  IndexBox cells = level.domain;
  const Vec3 origin = level.centre(level.domain.lower);
  for (int d = 0; d < 3; ++d) {
    // In doubles first: bounds may be as large as numbers are.
    const double size = level.domain.size()[d];
    const double low = std::floor((bounds.lower[d] - origin[d]) / level.spacing[d]);
    const double high = std::ceil((bounds.upper[d] - origin[d]) / level.spacing[d]) + 1.0;
    cells.lower[d] = level.domain.lower[d] + static_cast<int>(std::clamp(low, 0.0, size));
    cells.upper[d] = level.domain.lower[d] + static_cast<int>(std::clamp(high, 0.0, size));
  }
  return cells;
}

}  // namespace

RegionRuns::RegionRuns(const GeometryPiece& piece, const Level& level, int along)
    : along_(along), across_{along == 0 ? 1 : 0, along == 2 ? 1 : 2} {
  const Bounds bounds = piece.bounds();
  if (!bounds.empty()) rows_ = cells_of(bounds, level);
  width_ = std::max(0, rows_.size()[across_[0]]);
  height_ = std::max(0, rows_.size()[across_[1]]);
  for (int b = 0; b < height_; ++b)
    for (int a = 0; a < width_; ++a) {
      first_.push_back(runs_.size());
      IntVec3 cell = rows_.lower;
      cell[across_[0]] += a;
      cell[across_[1]] += b;
      bool open = false;
      for (; cell[along_] < rows_.upper[along_]; ++cell[along_]) {
        const bool inside = piece.inside(level.centre(cell));
        if (inside && !open) runs_.push_back({cell[along_], cell[along_]});
        if (inside) runs_.back().end = cell[along_] + 1;
        open = inside;
      }
    }
  first_.push_back(runs_.size());
}

}  // namespace sluice::ice
