// Declaring and compiling the graphs that a plan counts.
#include "app/plan/planned_graph.hpp"

#include "framework/refine/face_table.hpp"

namespace sluice {
namespace {

void compile_wanted(PlannedGraph& g, const Component& component, const Level& level,
                    const std::set<Label>& wanted) {
  std::vector<VariableId> variables;
  for (std::size_t n = 0; n < g.list.variables().size(); ++n) {
    const Variable& v = g.list.variables()[n];
    if (v.storage == Storage::new_state ||
        (v.storage == Storage::output && wanted.count(v.label) > 0))
      variables.push_back({static_cast<int>(n)});
  }
  g.plan = compile(g.list, component.effects(), variables, active_axes(level));
}

}  // namespace

PlannedGraph plan_step_graph(const Component& component, const Level& level,
                             const std::set<Label>& wanted, int kind) {
  PlannedGraph g;
  StepVariant variant;
  variant.kind = kind < 0 ? component.step_kinds() - 1 : kind;
  component.declare_step(g.list, variant);
  compile_wanted(g, component, level, wanted);
  return g;
}

PlannedGraph plan_diagnostic_graph(const Component& component, const Level& level,
                                   const std::set<Label>& wanted) {
  PlannedGraph g;
  component.declare_diagnostics(g.list, 0);
  compile_wanted(g, component, level, wanted);
  return g;
}

void add_outputs(const TaskList& list, MaterialsOfLabels& materials) {
  for (const Variable& v : list.variables())
    if (v.storage == Storage::output) materials[v.label].insert(v.material);
}

std::set<Label> output_labels(const TaskList& list) {
  std::set<Label> labels;
  for (const Variable& v : list.variables())
    if (v.storage == Storage::output) labels.insert(v.label);
  return labels;
}

double state_components(const Component& component) {
  double n = 0;
  for (const SlotInfo& s : component.state_slots()) n += s.components;
  return n;
}

}  // namespace sluice
