// Passes 5 to 7 of the graph compiler: windows, buffers, halo.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>
#include <string>

#include "framework/task/graph.hpp"

namespace sluice {
namespace {

IntVec3 only_active(IntVec3 v, const Axes& axes) {
  IntVec3 r{};
  for (int a = 0; a < axes.count; ++a) r[axes.direction[a]] = v[axes.direction[a]];
  return r;
}

// What consumers need of one variable.
struct Need {
  bool used = false;
  Growth window{IntVec3::all(std::numeric_limits<int>::min() / 2),
                IntVec3::all(std::numeric_limits<int>::min() / 2)};
  int lead_high = std::numeric_limits<int>::min() / 2;  // planes that must be ready ahead
  int lead_low = std::numeric_limits<int>::max() / 2;   // oldest plane still read

  void include(const Growth& g, int ahead, int behind) {
    used = true;
    window.low = max(window.low, g.low);
    window.high = max(window.high, g.high);
    lead_high = std::max(lead_high, ahead);
    lead_low = std::min(lead_low, behind);
  }
};

void check_reach(const TaskList& list, const Task& task, const Access& a) {
  const IntVec3 reach = max(a.stencil.low, a.stencil.high);
  const int far = std::max({reach.x, reach.y, reach.z});
  if (far > max_reach)
    throw std::logic_error("task '" + task.name + "' reads '" + list[a.variable].name + "' " +
                           std::to_string(far) + " cells away; at most " +
                           std::to_string(max_reach) + " are possible");
}

// The direction along which blocks are swept, or -1 in 1-D (a block is one row).
int swept_direction(const Axes& axes) {
  return axes.count > 1 ? axes.direction[axes.count - 1] : -1;
}

// What the sweep reads of the state and keeps in buffers, once its tasks have windows and leads.
void plan_storage(const TaskList& list, const std::vector<Need>& need, int swept, SweepPlan& plan) {
  for (std::size_t v = 0; v < need.size(); ++v) {
    const Variable& variable = list.variables()[v];
    const VariableId id{static_cast<int>(v)};
    if (variable.storage == Storage::old_state && need[v].used) {
      plan.states_read.push_back(id);
      plan.halo = max(plan.halo, max(need[v].window.low, need[v].window.high));
    }
    if (variable.storage == Storage::temporary && plan.used[v]) {
      int lead = 0;  // of the writer
      Growth window;
      for (const PlannedTask& p : plan.tasks)
        for (VariableId w : list.tasks()[p.task].writes)
          if (w == id) {
            lead = p.lead;
            window = p.window;
          }
      const int oldest = need[v].used ? need[v].lead_low : lead;
      const int planes = swept >= 0 ? lead - oldest + 1 : 1;
      plan.buffers.push_back(
          {id, window, static_cast<int>(std::bit_ceil(static_cast<unsigned>(planes)))});
    }
  }
}

}  // namespace

SweepPlan plan_sweep(const TaskList& list, const std::vector<int>& ordered, const Axes& axes) {
  SweepPlan plan;
  plan.axes = axes;
  const int swept = swept_direction(axes);
  std::vector<Need> need(list.variables().size());
  plan.used.assign(list.variables().size(), false);
  plan.tasks.resize(ordered.size());

  // Backwards: a task's window and lead are the largest that its consumers ask for.
  for (std::size_t n = ordered.size(); n-- > 0;) {
    const Task& t = list.tasks()[ordered[n]];
    Growth window;  // the block itself, for state, outputs and reductions
    int lead = 0;
    for (VariableId v : t.writes) {
      plan.used[v.index] = true;
      const Need& wanted = need[v.index];
      if (wanted.used) {
        window.low = max(window.low, wanted.window.low);
        window.high = max(window.high, wanted.window.high);
        lead = std::max(lead, wanted.lead_high);
      }
      // What closes a block is stored too: whoever owns the cell beyond writes the same.
      if (list[v].storage == Storage::output) window.high = max(window.high, list[v].closing);
    }
    window.low = only_active(window.low, axes);
    window.high = only_active(window.high, axes);
    plan.tasks[n] = {ordered[n], window, lead};
    for (const Access& a : t.reads) {
      check_reach(list, t, a);
      Growth g{window.low + only_active(a.stencil.low, axes),
               window.high + only_active(a.stencil.high, axes)};
      const int ahead = swept >= 0 ? lead + a.stencil.high[swept] : 0;
      const int behind = swept >= 0 ? lead - a.stencil.low[swept] : 0;
      need[a.variable.index].include(g, ahead, behind);
      plan.used[a.variable.index] = true;
    }
  }
  plan_storage(list, need, swept, plan);
  return plan;
}

SweepPlan compile(const TaskList& list, const EffectList& effects,
                  const std::vector<VariableId>& wanted, const Axes& axes, bool reduces) {
  check(list, effects);
  return plan_sweep(list, order(list, prune(list, wanted, reduces)), axes);
}

std::string to_dot(const TaskList& list, const EffectList& effects, const SweepPlan& plan) {
  std::string dot = "digraph step {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n";
  for (const PlannedTask& p : plan.tasks) {
    const Task& t = list.tasks()[p.task];
    const std::string node = "  \"" + t.name + "\"";
    dot += node + " [shape=box, tooltip=\"" + effects[t.effect].name + "\"];\n";
    for (const Access& a : t.reads)
      dot += "  \"" + list[a.variable].name + "\" -> \"" + t.name + "\";\n";
    for (VariableId v : t.writes) dot += node + " -> \"" + list[v].name + "\";\n";
  }
  return dot + "}\n";
}

namespace {

std::string text_of(const IntVec3& low, const IntVec3& high) {
  return fmt::format("[{},{},{}] to [{},{},{}]", -low.x, -low.y, -low.z, high.x, high.y, high.z);
}

std::string frame_of(const TitledGraph& g, const EffectList& effects, std::size_t number) {
  std::string dot = fmt::format("  subgraph cluster_{} {{\n    label=\"{}\";\n", number, g.title);
  const auto task = [&](const Task& t) { return fmt::format("\"{}: {}\"", number, t.name); };
  const auto variable = [&](VariableId v) {
    return fmt::format("\"{}: {} ({})\"", number, g.list[v].name, g.list[v].components);
  };
  for (const PlannedTask& p : g.plan.tasks) {
    const Task& t = g.list.tasks()[p.task];
    dot += fmt::format("    {} [shape=box, tooltip=\"{}, {}, {} planes ahead\"];\n", task(t),
                       effects[t.effect].name, text_of(p.window.low, p.window.high), p.lead);
    for (const Access& a : t.reads)
      dot += fmt::format("    {} -> {} [label=\"{}\"];\n", variable(a.variable), task(t),
                         text_of(a.stencil.low, a.stencil.high));
    for (const VariableId v : t.writes) dot += fmt::format("    {} -> {};\n", task(t), variable(v));
  }
  for (const PlannedBuffer& b : g.plan.buffers)
    dot += fmt::format("    {} [tooltip=\"{}, {} planes\"];\n", variable(b.variable),
                       text_of(b.window.low, b.window.high), b.planes);
  return dot + "  }\n";
}

}  // namespace

std::string to_dot(const std::vector<TitledGraph>& graphs, const EffectList& effects) {
  std::string dot = "digraph steps {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n";
  for (std::size_t n = 0; n < graphs.size(); ++n) dot += frame_of(graphs[n], effects, n);
  return dot + "}\n";
}

}  // namespace sluice
