// Which cells of a level a geometry piece covers (by their centres), as runs along rows.
//
// Rows run along the first active direction, as those of kernels. Runs are found once, when the
// scene is set up; only the box around the piece is looked at and kept.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "framework/geometry/piece.hpp"
#include "framework/grid/level.hpp"

namespace sluice::ice {

class CellRuns {
 public:
  struct Run {
    int first = 0, end = 0;  // level indices along the row
  };

  CellRuns(const GeometryPiece& piece, const Level& level);

  // Of the row through this cell, low to high.
  std::span<const Run> runs(IntVec3 cell) const;
  bool contains(IntVec3 cell) const;
  // Calls f(first, end) for the cells of the row from `cell` on that are covered, counted from it.
  template <class F>
  void for_each(IntVec3 cell, int count, F&& f) const {
    for (const Run& run : runs(cell)) {
      const int low = run.first - cell[along_], high = run.end - cell[along_];
      if (low < count && high > 0) f(low > 0 ? low : 0, high < count ? high : count);
    }
  }
  int along() const { return along_; }

 private:
  std::size_t row_of(IntVec3 cell) const;

  int along_ = 0;
  IndexBox box_;                    // around the piece
  std::vector<std::size_t> begin_;  // of each row among the runs, and the end
  std::vector<Run> runs_;
};

}  // namespace sluice::ice
