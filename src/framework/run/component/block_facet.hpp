// Kinds of blocks of a component: which work a block does not need. The defaults know one kind.
#pragma once
#include <optional>

#include "framework/field/warehouse.hpp"
#include "framework/task/sweep_blocks.hpp"

namespace sluice {

class BlockFacet {
 public:
  virtual ~BlockFacet() = default;

  // Kinds of blocks, each with a graph of its own (StepVariant::kind): a block that holds one
  // material alone need not know of the others. The last kind is the general one, right for every
  // block and taken by all with force_all; the others only leave out work whose result is known, so
  // that no choice changes a bit of the state, of reductions, of fluxes recorded (all quantities
  // are recorded by each kind) or of step labels. Graphs of kinds that do not occur are not made.
  virtual int kinds() const { return 1; }
  // The kind of a block: a function of the old state alone, in the block and all ghost layers
  // around it. Asked in every step; Warehouse::any_nonzero is made for it.
  virtual int kind_of(const Warehouse& /*old_state*/, int /*local_box*/,
                      const IndexBox& /*cells_with_ghosts*/) const {
    return 0;
  }
  // What a state slot or step label that a kind's graph does not write holds throughout a block of
  // that kind after the step; nothing: it is left as it is. Asked with several kinds only.
  virtual std::optional<double> absent_value(Label /*label*/, int /*material*/,
                                             int /*kind*/) const {
    return 0.0;
  }

  // How large blocks are where the user chose nothing.
  virtual BlockSize size() const { return BlockSize::large; }

  // May a block of uniform state sleep: nothing in the scene acts on uniform states.
  virtual bool skipping_allowed() const { return false; }
  // And of one kind, where it may.
  virtual bool may_be_skipped(int /*kind*/) const { return true; }
};

}  // namespace sluice
