// The states of a level: the present one, the new one of an attempt, and, where the level takes
// several substeps in one coarse step, the one at the start of it.
//
// Nothing of the present state is touched by an attempt: a rejected step is simply attempted again.
#pragma once
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/run/component/state_facet.hpp"

namespace sluice {

class LevelStates {
 public:
  // Ghosts hold what the cells do that they stand for.
  static constexpr Arrays arrays = Arrays::shared;

  // `substeps`: of the level in one coarse step.
  LevelStates(const StateFacet& component, const Level& level, int rank, int substeps);
  LevelStates(const LevelStates&) = delete;
  LevelStates& operator=(const LevelStates&) = delete;

  const Level& level() const { return level_; }
  // Ghost layers of every slot: halos, interfaces between levels and redone slopes reach equally
  // far in all of them.
  int width() const { return width_; }
  IntVec3 ghosts() const { return level_.ghosts(width_); }

  Warehouse& present() { return present_; }
  const Warehouse& present() const { return present_; }
  // The new state of the last attempt, interior cells.
  Warehouse& next() { return next_; }
  // The state before the last accepted attempt of this coarse step.
  const Warehouse& previous() const { return next_; }
  // The state at the start of the coarse step, once it was advanced and until it is accepted.
  const Warehouse& start() const { return start_kept_ ? start_ : next_; }
  // The conserved slots: those that are exchanged and kept.
  const std::vector<int>& slots() const { return slots_; }
  void add_slot(SlotInfo info, Contents contents = Contents::zero);

  // Other boxes of the same level: the present state so far is handed back, the new one is to be
  // filled by the caller (interior cells).
  Warehouse lay_out(std::vector<GridBox> boxes);
  // Before an attempt: keeps the start of the coarse step where a substep would overwrite it.
  void store_start_state();
  // The new state becomes the present one.
  void advance();
  // The coarse step is accepted: what it began with is no longer needed.
  void accept();
  // Back to the start of the coarse step; true where the present state was another.
  bool reject();

  // Blocks of these extents in all states.
  void cut(IntVec3 extents);
  std::size_t bytes() const { return present_.bytes() + next_.bytes() + start_.bytes(); }

 private:
  Level level_;
  int rank_ = 0, substeps_ = 1, width_ = 0;
  Warehouse present_, next_, start_;
  std::vector<int> slots_;
  bool start_kept_ = false;  // in start_; else in present_ or, after one substep, in next_
  int advanced_ = 0;         // substeps of this coarse step
};

}  // namespace sluice
