// Multiples of an interval are counted as integers, so that no round-off can gather in them.
#include "framework/run/component/output_schedule.hpp"
#include "framework/base/infinity.hpp"

#include <algorithm>
#include <cmath>

namespace sluice {
namespace {

constexpr double round_off = 1e-10;  // of a step
// Beyond this an interval is so short that every step is due; counting on would overflow.
constexpr double max_multiples = 9e15;

bool due(double end, double dt, double interval, std::int64_t multiple) {
  return interval > 0 && reaches(end, static_cast<double>(multiple) * interval, dt);
}

double time_of(double interval, std::int64_t multiple) {
  return interval > 0 ? static_cast<double>(multiple) * interval : infinity;
}

}  // namespace

bool reaches(double t, double target, double dt) {
  return t >= target - round_off * dt;
}

std::int64_t next_multiple(double t, double interval, double dt) {
  const double passed = std::floor((t + round_off * dt) / interval);
  auto multiple = static_cast<std::int64_t>(std::clamp(passed, -max_multiples, max_multiples));
  // The quotient is rounded: step back or on until the definition holds.
  while (!reaches(t, static_cast<double>(multiple) * interval, dt)) --multiple;
  if (passed < max_multiples) {
    while (reaches(t, static_cast<double>(multiple) * interval, dt)) ++multiple;
  }
  return multiple;
}

ScheduleState OutputSchedule::state_at(double time, double dt) const {
  ScheduleState state;
  if (settings_.interval > 0) state.next_output = next_multiple(time, settings_.interval, dt);
  if (settings_.checkpoint.interval > 0) {
    state.next_checkpoint = next_multiple(time, settings_.checkpoint.interval, dt);
  }
  return state;
}

bool OutputSchedule::outputs_initial_state() const {
  return settings_.initial_timestep && settings_.any();
}

bool OutputSchedule::outputs(int step, double end, double dt, const ScheduleState& state) const {
  if (const int interval = settings_.timestep_interval; interval > 0) {
    const int first = settings_.initial_timestep ? 0 : 1;
    if (step % interval == first % interval) return true;
  }
  if (settings_.interval > 0 && step == 1) return true;
  return due(end, dt, settings_.interval, state.next_output);
}

bool OutputSchedule::checkpoints(int step, double end, double dt,
                                 const ScheduleState& state) const {
  const CheckpointSettings& settings = settings_.checkpoint;
  if (const int interval = settings.timestep_interval; interval > 0) {
    if (step > 1 && (step - 1) % interval == 0) return true;
  }
  return due(end, dt, settings.interval, state.next_checkpoint);
}

ScheduleState OutputSchedule::advance(double end, double dt, const ScheduleState& state) const {
  ScheduleState result = state;
  if (due(end, dt, settings_.interval, state.next_output)) {
    result.next_output = next_multiple(end, settings_.interval, dt);
  }
  if (due(end, dt, settings_.checkpoint.interval, state.next_checkpoint)) {
    result.next_checkpoint = next_multiple(end, settings_.checkpoint.interval, dt);
  }
  return result;
}

double OutputSchedule::next_output_time(const ScheduleState& state) const {
  return time_of(settings_.interval, state.next_output);
}

double OutputSchedule::next_checkpoint_time(const ScheduleState& state) const {
  return time_of(settings_.checkpoint.interval, state.next_checkpoint);
}

double OutputSchedule::first_wall_checkpoint() const {
  const CheckpointSettings& settings = settings_.checkpoint;
  if (settings.walltime_interval <= 0) return infinity;
  return settings.walltime_start > 0 ? settings.walltime_start : settings.walltime_interval;
}

double OutputSchedule::next_wall_checkpoint(double wall_seconds) const {
  const double interval = settings_.checkpoint.walltime_interval;
  const double first = first_wall_checkpoint();
  if (interval <= 0 || wall_seconds < first) return first;
  return first + interval * (std::floor((wall_seconds - first) / interval) + 1);
}

}  // namespace sluice
