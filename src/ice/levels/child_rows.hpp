// Fine cells that are asked for, in rows of children along axis 0: where they go.
//
// A row of a batch holds, for one place along each of the other axes, the children of all its
// coarse cells, cell by cell. Of a line along axis 0 they lie side by side in the fine array, too.
#pragma once
#include <algorithm>
#include <span>

#include "framework/field/region_rows.hpp"
#include "ice/levels/children.hpp"

namespace sluice::ice {

template <int D, int Width>
class ChildRows {
 public:
  ChildRows(std::span<const Prolongation> regions, const Children& children)
      : regions_(regions), children_(children) {}

  // The rows at places y and z along the axes 1 and 2; false when nothing of them is asked for.
  bool find(const Batch<Width>& batch, int y, int z) {
    count_ = 0;
    for (const LinePart& line : batch.parts()) {
      runs_[count_] = run_of(line, {0, y, z});
      if (runs_[count_].count > 0 && runs_[count_].rows > 0) ++count_;
    }
    return count_ > 0;
  }
  // To the array of one quantity.
  void write(std::size_t view, const double* row) const {
    const int each = children_.ratio(0);
    for (int n = 0; n < count_; ++n) {
      const Run& run = runs_[n];
      double* to = (*run.fine)[view].data + run.first;
      for (int k = 0; k < run.rows; ++k)
        copy_row(to + k * run.step, row + run.place + k * each, run.count);
    }
  }

 private:
  // `rows` times `count` cells, `step` apart.
  struct Run {
    const StateViews* fine = nullptr;
    std::ptrdiff_t first = 0, step = 0;
    int place = 0, count = 0, rows = 0;  // `place`: in the row of the batch
  };

  Run run_of(const LinePart& line, IntVec3 places) const {
    const Axes& axes = children_.axes();
    const IndexBox& asked = regions_[line.region].cells;
    const int d0 = axes.direction[0], each = children_.ratio(0);
    const int cells = line.along == d0 ? line.count * each : each;  // of a row
    Run run;
    run.rows = line.along == d0 ? 1 : line.count;
    IntVec3 cell = line.first;
    cell[d0] = std::max(line.first[d0] * each, asked.lower[d0]);
    run.count = std::min(line.first[d0] * each + cells, asked.upper[d0]) - cell[d0];
    int begin = 0;
    for (int a = 1; a < D; ++a) {
      const int d = axes.direction[a], ratio = children_.ratio(a);
      cell[d] = line.first[d] * ratio + places[a];
      if (d == line.along) {
        for (; run.rows > 0 && cell[d] < asked.lower[d]; cell[d] += ratio, ++begin) --run.rows;
        while (run.rows > 0 && cell[d] + (run.rows - 1) * ratio >= asked.upper[d]) --run.rows;
      } else if (cell[d] < asked.lower[d] || cell[d] >= asked.upper[d]) {
        return {};
      }
    }
    run.place = (line.place + begin) * each + cell[d0] - line.first[d0] * each;
    run.fine = regions_[line.region].fine;
    const RealView& view = run.fine->front();
    run.first = view.offset(cell);
    for (int a = 1; a < D; ++a)
      if (axes.direction[a] == line.along) run.step = view.stride[line.along] * children_.ratio(a);
    return run;
  }

  std::span<const Prolongation> regions_;
  const Children& children_;
  int count_ = 0;
  Run runs_[Width];
};

}  // namespace sluice::ice
