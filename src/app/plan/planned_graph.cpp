// Declaring and compiling the graphs that a plan counts.
#include "app/plan/planned_graph.hpp"

#include <fmt/format.h>

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
  variant.kind = kind < 0 ? component.blocks().kinds() - 1 : kind;
  component.step().declare(g.list, variant);
  compile_wanted(g, component, level, wanted);
  return g;
}

PlannedGraph plan_diagnostic_graph(const Component& component, const Level& level,
                                   const std::set<Label>& wanted) {
  PlannedGraph g;
  component.outputs().declare_diagnostics(g.list, 0);
  compile_wanted(g, component, level, wanted);
  return g;
}

std::vector<TitledGraph> every_graph(const Component& component, const Scene& scene) {
  std::vector<TitledGraph> graphs;
  const auto add = [&](const std::string& title, const Level& level, bool stores, auto declare) {
    PlannedGraph g;
    declare(g.list);
    compile_wanted(g, component, level, stores ? output_labels(g.list) : std::set<Label>());
    graphs.push_back({title, std::move(g.list), std::move(g.plan)});
  };
  for (const Level& level : scene.grid.levels) {
    const auto step = [&](bool masked, int kind) {
      return [&component, &level, masked, kind](TaskList& list) {
        StepVariant variant;
        variant.level = level.index;
        variant.masked = masked;
        variant.kind = kind;
        component.step().declare(list, variant);
      };
    };
    const std::string where = fmt::format("level {}", level.index);
    for (int kind = 0; kind < component.blocks().kinds(); ++kind) {
      const std::string blocks = fmt::format("{}, blocks of kind {}", where, kind);
      add(blocks + ": step", level, false, step(false, kind));
      add(blocks + ": repeated step", level, false, step(true, kind));
      add(blocks + ": step with all its labels", level, true, step(false, kind));
    }
    add(where + ": labels of a state", level, true, [&component, &level](TaskList& list) {
      component.outputs().declare_diagnostics(list, level.index);
    });
  }
  return graphs;
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
  for (const SlotInfo& s : component.state().slots()) n += s.components;
  return n;
}

}  // namespace sluice
