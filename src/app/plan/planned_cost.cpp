#include "app/plan/planned_cost.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/console.hpp"

namespace sluice {
namespace {

// Of the cells of a run whose uniform blocks are skipped: the mean over the decks of ./dev bench.
constexpr double awake_share = 0.75;
// A second rank or thread does this much of its share.
constexpr double parallel_efficiency = 0.95;
// Levels are small at the start: of what they hold on the average over that.
constexpr double levels_grow = 2;

// Initial state, in s of the recorded machine; set-up of a solver, and of solids in a fluid: the
// cells that they cut.
double start_of(const CostedRun& run) {
  const bool coupled = run.component == "mpmice";
  const bool solves =
      std::find(run.effects.begin(), run.effects.end(), "pressure solve") != run.effects.end();
  const double per_particle = start_particle_ns * (coupled ? 5 : 1);
  return start_s + (solves ? 0.1 : 0) + (coupled ? 0.1 : 0) +
         1e-9 * (run.cells * start_cell_ns + run.particles * per_particle);
}

double parallel(const CostedRun& run) {
  const double workers = std::max(1, run.ranks) * std::max(1, run.threads);
  return workers == 1 ? 1 : 1 + parallel_efficiency * (workers - 1);
}

}  // namespace

PlannedCost planned_cost(const CostedRun& run, const PlannedSteps& steps) {
  const UnitCosts unit =
      recorded_costs(run.component, run.dimensions, run.effects, run.levels, run.interpolator);
  PlannedCost cost;
  cost.known = steps.steps > 0 && (unit.cell_ns > 0 || unit.particle_ns > 0);
  cost.steps = steps;
  cost.cell_updates = run.cell_updates;
  cost.particles = run.particles;
  cost.machine = machine_factor();
  cost.from_rest = run.from_rest;
  cost.cell_ns = unit.cell_ns * (run.skipping ? awake_share : 1) * cost.machine;
  cost.particle_ns = unit.particle_ns * (run.levels ? levels_grow : 1) * cost.machine;
  const double work = 1e-9 * (run.cell_updates * cost.cell_ns + run.particles * cost.particle_ns);
  cost.stepping_s = steps.steps * (unit.step_s * cost.machine + work / parallel(run));
  cost.start_s = cost.machine * start_of(run);
  const double grown = run.levels ? levels_grow : 1;
  const double written =
      grown * (steps.outputs * run.output_bytes + steps.checkpoints * run.checkpoint_bytes);
  cost.output_s = (steps.outputs + steps.checkpoints) * output_s + written / written_bytes_per_s;
  cost.outputs_bytes = steps.outputs * (grown * run.output_bytes + output_overhead_bytes);
  cost.checkpoints_bytes = steps.kept * (grown * run.checkpoint_bytes + output_overhead_bytes);
  return cost;
}

std::string cost_text(const PlannedCost& c) {
  if (!c.known) return "";
  const auto count = [](double n) { return human_count(static_cast<std::int64_t>(n)); };
  std::string unit = fmt::format("{:.0f} ns per cell", c.cell_ns);
  if (c.particles > 0) unit += fmt::format(" and {:.0f} ns per particle", c.particle_ns);
  std::string text = fmt::format(
      "  cost {}: start {}, {} steps {} ({} and step), {} outputs and {} checkpoints {}\n",
      human_duration(c.seconds()), human_duration(c.start_s), count(c.steps.steps),
      human_duration(c.stepping_s), unit, count(c.steps.outputs), count(c.steps.checkpoints),
      human_duration(c.output_s));
  text += fmt::format("  archive {}: outputs {}, checkpoints {}\n", human_bytes(c.bytes()),
                      human_bytes(c.outputs_bytes), human_bytes(c.checkpoints_bytes));
  if (c.from_rest)
    text +=
        "  the pressure solve starts from rest: its steps are taken as 50 times that of sound\n";
  return text;
}

}  // namespace sluice
