// The graphs that the blocks of a sweep choose from: what a block holds decides what it must run.
#pragma once
#include <functional>
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/task/graph.hpp"

namespace sluice {

// A new state slot or an output that a graph does not write, and what it holds throughout a block
// after the step.
struct AbsentSlot {
  Label label;
  int material = 0;
  double value = 0;  // in the unit of the label
  bool output = false;
  IntVec3 closing{};
};

// What blocks of one kind run; the list must outlive the sweep.
struct SweepGraph {
  const TaskList* list = nullptr;
  SweepPlan plan;
  std::vector<AbsentSlot> absent;
  bool may_be_skipped = true;  // blocks of uniform state
};

// The last kind is right for every block.
struct SweepKinds {
  int count = 1;
  std::function<SweepGraph(int kind)> graph;  // asked once, when the kind is first met
  // Of a local box and a block in it, grown by `halo`; none: all blocks are of the last kind.
  std::function<int(const Warehouse& old_state, int box, const IndexBox& cells_with_halo)> kind_of;
  IntVec3 halo{};
};

}  // namespace sluice
