// What a row kernel sees: pointers to rows of its inputs and outputs, and where the row lies.
//
// Axes are the active directions of the level in order. Axis 0 runs along the row with unit
// stride; the last axis is the one along which a block is swept, and temporaries keep only the few
// planes of it that are still needed (a ring), which is why rows must be asked for by shift.
#pragma once
#include <array>
#include <cstddef>

#include "framework/base/vec3.hpp"

namespace sluice {

class Reductions;
class RowMarks;

struct In {
  int index = -1;
};
struct Out {
  int index = -1;
};

struct Axes {
  int count = 1;                 // active directions
  int direction[3] = {0, 1, 2};  // level direction of each axis
};

// One variable as it is bound for one block. Canonical coordinates: axis 0 (unit stride), middle
// axis (3-D only), swept axis (2-D and 3-D). Asked for hundreds of times a row.
struct BoundArray {
  double* const* components = nullptr;   // where cell (0, 0, low) of each would lie
  std::ptrdiff_t middle = 0, swept = 0;  // strides
  int low = 0;                           // along the swept axis
  int mask = -1;                         // ring of planes along the swept axis: plane & mask

  [[gnu::always_inline]] double* at(int component, int i, int j, int k) const {
    return components[component] + i + j * middle + ((k - low) & mask) * swept;
  }
};

// Constants of the step that kernels need, set once before a sweep.
struct StepConstants {
  double time = 0.0;      // start of the step
  double dt = 0.0;        // length of the step
  Vec3 spacing{1, 1, 1};  // of the level
  int level = 0;
  bool rates = true;  // whether the rates of the new state are asked for
};

class Row {
 public:
  int count() const { return count_; }
  // So many cells may be computed instead: whole vectors, where nothing is stored beyond the row
  // and nobody reads it. Inputs there hold any number.
  int whole_vectors() const { return whole_vectors_; }
  IntVec3 cell() const { return cell_; }            // level index of the first cell of the row
  int box() const { return box_; }                  // number of the local box
  IntVec3 block_low() const { return block_low_; }  // interior cells of the block
  IntVec3 block_high() const { return block_high_; }
  // What old and new state remember of the box's rows; null: nothing. Of tasks that read the old
  // state, and write the new one.
  const RowMarks* old_marks() const { return old_marks_; }
  RowMarks* new_marks() const { return new_marks_; }
  const StepConstants& step() const { return *step_; }
  // `count` cells of the row, from its cell number `first` on.
  Row part(int first, int count) const {
    Row r = *this;
    r.count_ = r.whole_vectors_ = count;
    r.index_[0] += first;
    r.cell_[along_] += first;
    return r;
  }
  Reductions& reductions() const { return *reductions_; }

  // Row of an input, shifted by `shift` cells along `axis` (of the active axes).
  [[gnu::always_inline]] const double* operator()(In in, int component = 0, int axis = 0,
                                                  int shift = 0) const {
    return at(reads_[in.index], component, axis, shift);
  }
  // Shifted along two different axes.
  const double* at_corner(In in, int component, int axis, int shift, int other, int step) const {
    int offset[3] = {0, 0, 0};
    offset[axis] += shift;
    offset[other] += step;
    return at(reads_[in.index], component, offset);
  }
  // Shifted along all axes at once, in their order.
  const double* at_offset(In in, int component, std::array<int, 3> offset) const {
    return at(reads_[in.index], component, offset.data());
  }
  [[gnu::always_inline]] double* operator()(Out out, int component = 0) const {
    return at(writes_[out.index], component, 0, 0);
  }

 private:
  friend class BlockSweep;
  [[gnu::always_inline]] double* at(const BoundArray* a, int component, int axis, int shift) const {
    const int i = axis == 0 ? index_[0] + shift : index_[0];
    const int j = axis == 1 && axes_ == 3 ? index_[1] + shift : index_[1];
    const int k = axis != 0 && axis == axes_ - 1 ? index_[2] + shift : index_[2];
    return a->at(component, i, j, k);
  }
  double* at(const BoundArray* a, int component, const int* offset) const {
    const int middle = axes_ == 3 ? offset[1] : 0;
    const int swept = axes_ == 1 ? 0 : offset[axes_ - 1];
    return a->at(component, index_[0] + offset[0], index_[1] + middle, index_[2] + swept);
  }

  const BoundArray* const* reads_ = nullptr;
  const BoundArray* const* writes_ = nullptr;
  int axes_ = 1;
  int along_ = 0;             // level direction of axis 0
  int index_[3] = {0, 0, 0};  // canonical coordinates of the row's first cell
  int count_ = 0, whole_vectors_ = 0, box_ = 0;
  IntVec3 cell_{}, block_low_{}, block_high_{};
  const RowMarks* old_marks_ = nullptr;
  RowMarks* new_marks_ = nullptr;
  const StepConstants* step_ = nullptr;
  Reductions* reductions_ = nullptr;
};

}  // namespace sluice
