// The graph compiler: from declared tasks to a plan of sweeps, in small passes.
//
//   1. collect   the effects that are on declare their tasks into a TaskList
//   2. check     every temporary that is read has one writer; nothing is written twice; no cycle
//   3. prune     backwards from what is wanted: new state, wanted outputs, tasks marked `always`
//   4. order     topological, declaration order breaks ties
//   5. windows   how far beyond a block each task must compute so that no message is needed inside
//                the sweep, and how many planes ahead of its consumers it runs
//   6. buffers   planes of scratch memory of each temporary
//   7. halo      the ghost layers of old state that the sweep reads: one halo point before it
// Placement on blocks and threads is in block_sweep.hpp, messages in halo.hpp.
#pragma once
#include <string>
#include <vector>

#include "framework/task/effect.hpp"
#include "framework/task/task.hpp"

namespace sluice {

// Growth of a window beyond the block, per level direction.
struct Growth {
  IntVec3 low{}, high{};
};

struct PlannedTask {
  int task = 0;   // index into TaskList::tasks()
  Growth window;  // cells (or low faces) computed beyond the block
  int lead = 0;   // planes along the swept axis that it runs ahead of the last task
};

struct PlannedBuffer {
  VariableId variable;
  Growth window;
  int planes = 1;  // depth of the ring along the swept axis, a power of two
};

struct SweepPlan {
  Axes axes;
  std::vector<PlannedTask> tasks;       // in execution order
  std::vector<PlannedBuffer> buffers;   // temporaries that live
  std::vector<VariableId> states_read;  // old state that needs ghosts, with `halo` layers
  IntVec3 halo{};                       // ghost layers of old state read, per direction
  std::vector<bool> used;               // by variable
};

// Pass 2. Throws std::logic_error naming task, variable, effect and the deck line that called for
// the effect.
void check(const TaskList& list, const EffectList& effects);

// Pass 3. True for tasks that stay. `reduces`: tasks marked `always` are wanted too.
std::vector<bool> prune(const TaskList& list, const std::vector<VariableId>& wanted,
                        bool reduces = true);

// Pass 4. Indices of the tasks that stay, producers before consumers. std::logic_error where tasks
// wait for each other in a circle.
std::vector<int> order(const TaskList& list, const std::vector<bool>& keep);

// Passes 5 to 7 for tasks in execution order.
SweepPlan plan_sweep(const TaskList& list, const std::vector<int>& ordered, const Axes& axes);

// All passes; `reduces` as for prune.
SweepPlan compile(const TaskList& list, const EffectList& effects,
                  const std::vector<VariableId>& wanted, const Axes& axes, bool reduces = true);

// The graph as DOT for `sluice plan --graph`.
std::string to_dot(const TaskList& list, const EffectList& effects, const SweepPlan& plan);

// Several graphs in one file, each in a frame with its title, with all that tells one graph from
// another: stencils of reads, components, windows and depths of buffers.
struct TitledGraph {
  std::string title;
  TaskList list;
  SweepPlan plan;
};
std::string to_dot(const std::vector<TitledGraph>& graphs, const EffectList& effects);

}  // namespace sluice
