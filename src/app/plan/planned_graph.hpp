// Graphs of a step, compiled without running them.
#pragma once
#include <map>
#include <set>

#include "framework/run/component/component.hpp"
#include "framework/scene/scene.hpp"
#include "framework/task/graph.hpp"

namespace sluice {

// A graph with some outputs wanted.
struct PlannedGraph {
  TaskList list;
  SweepPlan plan;
};

// Of a step of a kind of blocks; -1: the general one, which is right for every block.
PlannedGraph plan_step_graph(const Component& component, const Level& level,
                             const std::set<Label>& wanted, int kind = -1);
// Of what is computed from a state.
PlannedGraph plan_diagnostic_graph(const Component& component, const Level& level,
                                   const std::set<Label>& wanted);

// Every graph that a run of this component may compile, but for choices of outputs: of each level
// and kind of blocks the plain step, a repeated one, one that stores all its labels; of each level
// what is computed from a state.
std::vector<TitledGraph> every_graph(const Component& component, const Scene& scene);

// The materials that have each label among the outputs of these tasks.
using MaterialsOfLabels = std::map<Label, std::set<int>>;
void add_outputs(const TaskList& list, MaterialsOfLabels& materials);
std::set<Label> output_labels(const TaskList& list);

// How many components the state has, over all slots.
double state_components(const Component& component);

}  // namespace sluice
