// Values at faces of a level where fluxes are recorded, found by row without a search: what passes
// in a step, per volume of a cell of the level, in the component's quantities.
#pragma once
#include <span>
#include <vector>

#include "framework/grid/level.hpp"
#include "framework/task/row.hpp"

namespace sluice {

class InterfaceDistance;

// The active directions of a level in order.
Axes active_axes(const Level& level);

class FaceTable {
 public:
  // `count` faces in a row: the low (high = false) or high faces, along an axis, of the cells
  // `first`, first + 1, ... of the row (index along the row's direction); values go to
  // slot, slot + 1, ... Along axis 0, the row's own, every face is a segment of its own.
  struct Segment {
    int first = 0, count = 0;
    bool high = false;
    std::ptrdiff_t slot = 0;
  };

  FaceTable() = default;
  // Boxes are the local ones of a warehouse; `quantities` numbers a face.
  FaceTable(const std::vector<GridBox>& boxes, const Axes& axes, int quantities);

  bool empty() const { return faces_ == 0; }
  std::ptrdiff_t faces() const { return faces_; }
  // Faces along `axis` of the row of cells of local box `box` on which `cell` lies, low and high
  // ones, ascending by `first`: of the whole row, so that a caller clips them to its part. None for
  // a row outside the box.
  std::span<const Segment> segments(int box, int axis, IntVec3 cell) const;
  // The smallest box with all cells of this block that have faces along `axis`.
  IndexBox cells_with_faces(int box, int axis, const IndexBox& block) const;
  // Faces that belong to cells of this block, in any axis: such a block must not sleep.
  bool touches(int box, const IndexBox& block) const;
  // Of all faces, by slot.
  double* values(int quantity) { return values_.data() + quantity * faces_; }
  const double* values(int quantity) const { return values_.data() + quantity * faces_; }
  void clear();  // all values zero
  std::size_t bytes() const;

  // Appends the faces of `cells` (one layer thick along the axis; low or high faces) of a local
  // box; the first slot. Rows of the region follow each other, x fastest. seal() ends building.
  // std::logic_error for cells that are not such a layer of the box.
  std::ptrdiff_t add(int box, int axis, bool high, const IndexBox& cells);
  void seal();

 private:
  // Of one box and axis. Rows of all that have faces are numbered through.
  struct Rows {
    std::ptrdiff_t first = -1;  // of its rows; -1: no faces
    IndexBox cells{};           // all that have such faces
  };
  // What was added: a segment in every row of `cells`.
  struct Layer {
    int box = 0, axis = 0;
    bool high = false;
    IndexBox cells;
    std::ptrdiff_t slot = 0;
  };
  template <class F>
  void for_each_row(const Layer& layer, F&& f) const;
  std::ptrdiff_t number_rows();
  Rows& rows(int box, int axis) { return rows_[box * axes_.count + axis]; }
  const Rows& rows(int box, int axis) const { return rows_[box * axes_.count + axis]; }
  // Rows of a box are numbered along the second axis first.
  int cells_along(const IndexBox& box, int axis) const {
    return axis < axes_.count ? box.size()[axes_.direction[axis]] : 1;
  }
  int place(const IndexBox& box, int axis, IntVec3 cell) const {
    const int d = axes_.direction[axis];
    return axis < axes_.count ? cell[d] - box.lower[d] : 0;
  }

  std::vector<IndexBox> boxes_;
  std::vector<Rows> rows_;           // by box * axes + axis
  std::vector<Layer> layers_;        // while building
  std::vector<std::int32_t> begin_;  // by row: first segment; one more at the end
  std::vector<Segment> segments_;
  std::vector<double> values_;  // by quantity and slot
  std::ptrdiff_t faces_ = 0;
  int quantities_ = 0;
  Axes axes_;
};

// What a sweep over one level records into; either may be null. The component's recording task
// keeps a pointer to this, the run changes what it points to when boxes are laid out anew.
struct FluxRecorder {
  FaceTable* as_coarse = nullptr;  // towards the next finer level
  FaceTable* as_fine = nullptr;    // towards the next coarser level
  // Where the level ends, if the component asked for it.
  const InterfaceDistance* ends = nullptr;
};

inline std::span<const FaceTable::Segment> FaceTable::segments(int box, int axis,
                                                               IntVec3 cell) const {
  const Rows& r = rows(box, axis);
  if (r.first < 0) return {};
  const IndexBox& cells = boxes_[box];
  const int j = place(cells, 1, cell), k = place(cells, 2, cell);
  const int n = cells_along(cells, 1);
  if (j < 0 || j >= n || k < 0 || k >= cells_along(cells, 2)) return {};
  const std::int32_t* begin = begin_.data() + r.first + (j + static_cast<std::ptrdiff_t>(n) * k);
  return {segments_.data() + begin[0], static_cast<std::size_t>(begin[1] - begin[0])};
}

}  // namespace sluice
