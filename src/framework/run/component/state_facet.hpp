// What a component keeps in cells and nodes: its variables, their start, their ghost cells outside
// the domain. The defaults are those of a component that keeps nothing there.
#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "framework/base/exact_sum.hpp"
#include "framework/field/warehouse.hpp"
#include "framework/task/thread_team.hpp"

namespace sluice {

class StateFacet {
 public:
  virtual ~StateFacet() = default;

  // The conserved state: what steps advance, ghost exchanges fill and checkpoints keep.
  virtual std::vector<SlotInfo> slots() const { return {}; }
  // The labels under which checkpoints keep the components of each slot: its own where it has one.
  virtual std::vector<std::vector<Label>> checkpoint_labels() const {
    std::vector<std::vector<Label>> labels;
    for (const SlotInfo& s : slots()) labels.push_back({s.label});
    return labels;
  }
  virtual void initialise(Warehouse& /*state*/) const {}
  // Ghost cells outside the domain, after the ghost exchange has filled the others (on a finer
  // level also those at its interface), of the level state.level(), at a time (s). `sums`: of the
  // coarsest one, those of add_boundary_sums rounded.
  virtual void fill_boundary(Warehouse& /*state*/, double /*time*/,
                             std::span<const double> /*sums*/, const ThreadTeam& /*team*/) const {}
  // What the boundary needs to know of all cells of the coarsest level, whoever holds them: exact
  // sums, taken whenever its ghosts are filled and good for the finer levels until the next time.
  // 0: nothing is summed, no message is sent.
  virtual int boundary_sums() const { return 0; }
  virtual void add_boundary_sums(const Warehouse& /*state*/, std::span<ExactSum> /*sums*/) const {}

  // Cell fields beside the state that a stage of the step writes and sweeps read as old state, with
  // its ghosts: neither exchanged with it, nor kept, nor carried to the next step.
  virtual std::vector<SlotInfo> work_slots() const { return {}; }
  // Ghost cells of one of them outside the domain, when the others are filled.
  virtual void fill_work_boundary(Warehouse& /*state*/, Label /*label*/,
                                  const ThreadTeam& /*team*/) const {}
};

// Ghost layers that every state slot gets: as many as the one that asks for most.
inline int halo_width(const StateFacet& state) {
  int width = 0;
  for (const SlotInfo& s : state.slots()) width = std::max(width, s.ghosts);
  return width;
}

}  // namespace sluice
