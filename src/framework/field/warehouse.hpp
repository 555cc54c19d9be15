// Storage of all fields of one time level, for the boxes of one level that this rank owns. Numbers
// have the units of their labels.
//
// A *slot* is one label of one material. Every slot holds, for every local box, one array a
// component: the interior cells plus the slot's ghost layers (none in inactive directions). Those
// of one box follow each other at equal distances. Slots are added while a graph is compiled;
// nothing is allocated inside a step.
//
// A warehouse may remember which of its blocks are *uniform*: known to hold one value in all cells
// and components of a slot, so that nobody need look or write it again. Whoever writes interior
// cells says so (forget); ghost cells are never known. With blocks come marks of parts of rows,
// whose meaning is the component's: they are forgotten likewise.
#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "framework/field/array_view.hpp"
#include "framework/field/block_lattice.hpp"
#include "framework/field/label.hpp"
#include "framework/field/row_marks.hpp"
#include "framework/grid/box_frames.hpp"
#include "framework/grid/level.hpp"

namespace sluice {

// What a new array holds: zeros, or whatever (sanitizers see NaN) where all of it is written before
// it is read.
enum class Contents { zero, undefined };

// Memory of one array, aligned for the widest vector registers.
class AlignedArray {
 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t count, Contents contents = Contents::zero);
  double* data() const { return data_.get(); }
  std::size_t size() const { return count_; }

 private:
  struct Free {
    Free() noexcept : base(nullptr) {}
    explicit Free(void* allocated) noexcept : base(allocated) {}
    void* base;  // what was allocated; the data start at the next cache line
    void operator()(double*) const;
  };
  std::unique_ptr<double[], Free> data_;
  std::size_t count_ = 0;
};

// A box of cells laid out with unit stride along the first active direction; and a part of it.
RealView lay_out(double* data, const IndexBox& box, const Level& level);
RealView part_of(const RealView& whole, const IndexBox& part);

struct SlotInfo {
  Label label;
  int material = 0;
  int components = 1;
  int ghosts = 0;
};

class Warehouse {
 public:
  // Keeps a reference to `level`; `rank` owns the boxes whose owner it is.
  Warehouse(const Level& level, int rank, Arrays arrays = Arrays::own);

  // Adds a slot (or returns the existing one of the same label and material, whose ghost width and
  // component count must then suffice) and allocates it.
  int add(const SlotInfo& info, Contents contents = Contents::zero);
  int find(Label label, int material) const;  // -1 when absent
  const SlotInfo& info(int slot) const { return slots_[slot].info; }
  int slot_count() const { return static_cast<int>(slots_.size()); }

  const Level& level() const { return *level_; }
  const std::vector<GridBox>& local_boxes() const { return local_; }
  // View of component `c` over the interior and ghosts of local box number `b`.
  RealView view(int slot, int c, int b) const {
    const Slot& s = slots_[slot];
    return s.views[b * s.info.components + c];
  }
  // Cuts the boxes into blocks, of which nothing is known yet, nor of their rows.
  void cut(IntVec3 extents);
  const BlockLattice& blocks() const { return blocks_; }
  // What a block is known to hold throughout; NaN where it is not known to be uniform.
  double uniform(int slot, int block) const { return slots_[slot].uniform[block]; }
  void set_uniform(int slot, int block, double value) { slots_[slot].uniform[block] = value; }
  void forget(int slot, int block) { set_uniform(slot, block, unknown); }
  void forget();  // all slots and blocks, all marks
  // Of local box number `b`, all slots and marks of the blocks that a region meets.
  void forget(int b, const IndexBox& region);
  // The same of the blocks of which meets(their cells) is true.
  template <class Meets>
  void forget_where(int b, Meets&& meets) {
    if (blocks_.size() == 0) return;
    blocks_.any_block(b, local_[b].cells, [&](int block, const IndexBox& cells) {
      if (meets(cells)) forget_block(b, block, cells);
      return false;
    });
  }
  // Zeros in all components of a slot in local box number `b`, ghost cells too. What is known to be
  // zero is not written again.
  void clear(int slot, int b);
  // The same for a slot that its only writer fills in these parts of the box alone, ghost cells
  // too, before the next call: only the parts of the last call are cleared.
  void clear_for(int slot, int b, const std::vector<IndexBox>& parts);
  // Of the rows of local box number `b`; null where no blocks were cut.
  RowMarks* marks(int b) { return marks_.empty() ? nullptr : &marks_[b]; }
  const RowMarks* marks(int b) const { return marks_.empty() ? nullptr : &marks_[b]; }
  // Is any number (a NaN too) of a region of a view other than zero. Reads what is unknown, row by
  // row, and stops at the first that is.
  bool any_nonzero(int slot, int c, int b, const IndexBox& region) const;
  // act(cells) for the parts of local box number `b` not known to hold one value throughout.
  template <class F>
  void for_each_part_other(int slot, int b, double value, F&& act) const {
    const IndexBox& cells = local_[b].cells;
    if (blocks_.size() == 0) return act(cells);
    blocks_.any_block(b, cells, [&](int block, const IndexBox& part) {
      if (uniform(slot, block) != value) act(part);
      return false;
    });
  }
  std::size_t bytes() const;

  void swap(Warehouse& other) noexcept;

 private:
  struct Slot {
    SlotInfo info;
    std::vector<AlignedArray> arrays;
    std::vector<RealView> views;
    std::vector<double> uniform;  // by block
    // By local box: parts outside of which all is zero (clear_for); none: it is not known.
    std::vector<std::optional<std::vector<IndexBox>>> filled;
    std::int64_t numbers = 0;  // in arrays
  };
  void forget_block(int b, int block, const IndexBox& cells);
  // Boxes that lie in one array each, by frame; found once for slots that follow each other and
  // are as wide.
  const std::vector<BoxFrame>& frames(int ghosts);
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const Level* level_;
  Arrays arrays_;
  std::vector<GridBox> local_;
  std::vector<Slot> slots_;
  std::vector<BoxFrame> frames_;  // of slots with `framed_` ghost layers; -1: not found yet
  int framed_ = -1;
  BlockLattice blocks_;
  std::vector<RowMarks> marks_;  // by local box
};

}  // namespace sluice
