// Cells in which a repeated step drops slopes: those that an attempt has found inadmissible.
#pragma once
#include <cstdint>
#include <span>

#include "framework/run/levels/level_ghosts.hpp"
#include "framework/task/reductions.hpp"

namespace sluice {

class SlopeMasks {
 public:
  // `label`: of the slot that holds 0 where slopes are dropped, else 1; it is added when needed.
  SlopeMasks(Label label, LevelStates& states, LevelGhosts& ghosts, Communicator& ranks)
      : label_(label), states_(&states), ghosts_(&ghosts), ranks_(&ranks) {}

  bool any() const { return any_; }
  void clear() { any_ = false; }
  // Masks these cells of this rank beside those masked so far in the step; where all of them were
  // masked, the cells next to those. The number of cells masked now, over all ranks. Collective;
  // `count`: of the faults of all ranks.
  std::int64_t add(std::span<const CellFault> faults, std::int64_t count);

 private:
  std::int64_t over_ranks(std::int64_t count) const;
  std::int64_t mask(std::span<const CellFault> faults, int slot);
  std::int64_t widen(int slot);
  void extend_outside(int slot);

  Label label_;
  LevelStates* states_;
  LevelGhosts* ghosts_;
  Communicator* ranks_;
  bool any_ = false;
};

}  // namespace sluice
