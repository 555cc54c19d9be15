#include "app/plan/planned_steps.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"
#include "framework/run/component/time_control.hpp"

namespace sluice {
namespace {

constexpr int most_followed = 100'000;  // steps; later ones go on as these ended

double kept_of(const CheckpointSettings& settings, double written) {
  return settings.cycle > 0 ? std::min<double>(settings.cycle, written) : written;
}

// How many of an interval lie in a time.
double by_time(double interval, double duration) {
  return interval > 0 ? std::floor(duration / interval) : 0;
}

// What is left of a run whose steps stay as long as they are.
void add_rest(const Scene& scene, const TimeState& state, double dt, int max_steps,
              PlannedSteps& planned) {
  const OutputSettings& o = scene.output;
  double rest = std::max(scene.time.max_time - state.time, 0.0), steps = std::ceil(rest / dt);
  int limit = scene.time.max_timesteps;
  if (max_steps > 0 && (limit == 0 || max_steps < limit)) limit = max_steps;
  if (limit > 0) steps = std::min(steps, static_cast<double>(limit - state.step));
  rest = std::min(rest, steps * dt);
  planned.steps += steps;
  planned.outputs += by_time(o.interval, rest) + by_time(o.timestep_interval, steps);
  planned.checkpoints +=
      by_time(o.checkpoint.interval, rest) + by_time(o.checkpoint.timestep_interval, steps);
}

}  // namespace

PlannedSteps planned_steps(const Scene& scene, double physics_dt, int max_steps) {
  RunLimits limits;
  limits.max_steps = max_steps;
  limits.tell = limits.warn = false;
  TimeControl control(scene.time, scene.output, limits);
  PlannedSteps planned;
  planned.outputs = control.outputs_initial_state() ? 1 : 0;
  double dt = physics_dt;
  try {
    while (control.status() == RunStatus::running && planned.steps < most_followed) {
      const StepPlan plan = control.plan(physics_dt);
      dt = plan.uncut_dt;
      planned.steps += 1;
      planned.outputs += plan.output ? 1 : 0;
      planned.checkpoints += control.accept(plan, 0, false).checkpoint ? 1 : 0;
    }
  } catch (const PhysicsError&) {
    return planned;  // the run will say so
  }
  if (control.status() == RunStatus::running)
    add_rest(scene, control.state(), dt, max_steps, planned);
  planned.kept = kept_of(scene.output.checkpoint, planned.checkpoints);
  return planned;
}

}  // namespace sluice
