// What a row kernel sees: pointers to rows of its inputs and outputs, and where the row lies.
//
// Axes are the active directions of the level in order. Axis 0 runs along the row with unit
// stride; the last axis is the one along which a block is swept, and temporaries keep only the few
// planes of it that are still needed (a ring), which is why rows must be asked for by shift.
#pragma once
#include <array>
#include <cstddef>

#include "framework/base/vec3.hpp"
#include "framework/task/places.hpp"

namespace sluice {

class PartReductions;
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

// Cells that a stencil may reach along one axis.
constexpr int max_reach = 3;

// Where the row at hand begins in what its task reads and writes: found once a row, asked for
// hundreds of times. By number of the access.
struct RowStarts {
  double* const* first = nullptr;              // its first cell, component 0
  const std::ptrdiff_t* component = nullptr;   // from one component to the next
  const std::ptrdiff_t* const* along[3] = {};  // steps along each axis, by shift

  [[gnu::always_inline]] double* at(int n, int c) const { return first[n] + c * component[n]; }
  [[gnu::always_inline]] std::ptrdiff_t step(int n, int axis, int shift) const {
    if (__builtin_constant_p(axis) && axis == 0) return shift;  // a number in the instruction
    return along[axis][n][shift];
  }
};

// Constants of the step that kernels need, set once before a sweep.
struct StepConstants {
  double time = 0.0;      // start of the step, s
  double dt = 0.0;        // length of the step, s
  Vec3 spacing{1, 1, 1};  // of the level, m
  int level = 0;
  bool rates = true;       // whether the rates of the new state are asked for
  double dt_before = 0.0;  // length of the step before, s; 0: there was none
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
    r.first_ += first;
    r.cell_[along_] += first;
    return r;
  }
  PartReductions reductions() const;  // of the part that declared the task: task/reductions.hpp

  // Row of an input, shifted by `shift` cells along `axis` (of the active axes).
  [[gnu::always_inline]] const double* operator()(In in, int component = 0, int axis = 0,
                                                  int shift = 0) const {
    return starts_.at(in.index, component) + (first_ + starts_.step(in.index, axis, shift));
  }
  // Shifted along two different axes.
  const double* at_corner(In in, int component, int axis, int shift, int other, int step) const {
    return (*this)(in, component, axis, shift) + starts_.step(in.index, other, step);
  }
  // Shifted along all axes at once, in their order.
  const double* at_offset(In in, int component, std::array<int, 3> offset) const {
    return (*this)(in, component, 0, offset[0]) +
           (starts_.step(in.index, 1, offset[1]) + starts_.step(in.index, 2, offset[2]));
  }
  [[gnu::always_inline]] double* operator()(Out out, int component = 0) const {
    return starts_.at(first_write_ + out.index, component) + first_;
  }

 private:
  friend class BlockSweep;
  RowStarts starts_;
  int first_write_ = 0;       // writes come after reads
  std::ptrdiff_t first_ = 0;  // of a part
  int along_ = 0;             // level direction of axis 0
  int count_ = 0, whole_vectors_ = 0, box_ = 0;
  IntVec3 cell_{}, block_low_{}, block_high_{};
  const RowMarks* old_marks_ = nullptr;
  RowMarks* new_marks_ = nullptr;
  const StepConstants* step_ = nullptr;
  Reductions* reductions_ = nullptr;
  const ReductionOffsets* places_ = nullptr;
};

}  // namespace sluice
