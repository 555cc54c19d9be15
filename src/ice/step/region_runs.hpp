// Which cells of a level a region of space holds, as runs of cells along one direction.
//
// Found once for a level: kernels look a row up and then know the runs of its cells.
#pragma once
#include <vector>

#include "framework/geometry/piece.hpp"
#include "framework/grid/level.hpp"

namespace sluice::ice {

class RegionRuns {
 public:
  struct Run {
    int first = 0, end = 0;  // cells along the direction of the runs
  };

  // The cells of the domain whose centres are inside, in rows along level direction `along`.
  RegionRuns(const GeometryPiece& piece, const Level& level, int along);

  // Calls f(first, end) for the cells of the row from `cell` on that are inside, counted from it.
  template <class F>
  void for_each(IntVec3 cell, int count, F&& f) const {
    const int a = cell[across_[0]] - rows_.lower[across_[0]];
    const int b = cell[across_[1]] - rows_.lower[across_[1]];
    if (a < 0 || b < 0 || a >= width_ || b >= height_) return;
    const auto row = static_cast<std::size_t>(a) +
                     static_cast<std::size_t>(b) * static_cast<std::size_t>(width_);
    for (std::size_t n = first_[row]; n < first_[row + 1]; ++n) {
      const int low = runs_[n].first - cell[along_], high = runs_[n].end - cell[along_];
      if (low < count && high > 0) f(low > 0 ? low : 0, high < count ? high : count);
    }
  }
  bool empty() const { return runs_.empty(); }

 private:
  int along_ = 0, across_[2] = {1, 2};
  IndexBox rows_{};  // bounding box of the region's cells
  int width_ = 0, height_ = 0;
  std::vector<std::size_t> first_;  // run of each row; one more
  std::vector<Run> runs_;
};

}  // namespace sluice::ice
