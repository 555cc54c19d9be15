// Which steps are kept: the rules of <DataArchiver> as functions of step number and time alone.
//
// By time: the first computed step always, then whenever the end of a step reaches the next
// multiple of the interval (multiples of the interval itself, not of the start). By steps: 1,
// 1 + N, 1 + 2N, ...; with <outputInitTimestep/> the initial state is kept and steps count from
// 0: 0, N, 2N, ... Checkpoints: by time at every multiple, by steps at 1 + N, 1 + 2N, ..., by
// wall clock at `walltimeStart` (or one interval) and every interval after it; never step 0.
// "Reaches" means up to 1e-10 of the step: the round-off of a sum of steps delays no output.
// All times and intervals in s.
#pragma once
#include <cstdint>

#include "framework/scene/output_settings.hpp"

namespace sluice {

// t >= target, up to the round-off of time in steps of dt.
bool reaches(double t, double target, double dt);

// The smallest multiple number k with k interval > t, up to the round-off as above.
std::int64_t next_multiple(double t, double interval, double dt);

// What a schedule has to remember between steps.
struct ScheduleState {
  std::int64_t next_output = 0;      // multiple of the output interval, when by time
  std::int64_t next_checkpoint = 0;  // multiple of the checkpoint interval, when by time

  bool operator==(const ScheduleState&) const = default;
};

class OutputSchedule {
 public:
  explicit OutputSchedule(const OutputSettings& settings) : settings_(settings) {}

  // The state for a run that stands at this time and has just done what was due there. Also the
  // state after a restart with other intervals.
  ScheduleState state_at(double time, double dt = 0) const;

  bool outputs_initial_state() const;
  bool outputs(int step, double end, double dt, const ScheduleState& state) const;
  bool checkpoints(int step, double end, double dt, const ScheduleState& state) const;
  // After the step has ended.
  ScheduleState advance(double end, double dt, const ScheduleState& state) const;

  // Times that steps should meet exactly; +infinity when nothing is due by time.
  double next_output_time(const ScheduleState& state) const;
  double next_checkpoint_time(const ScheduleState& state) const;

  // Wall seconds of this process at which the first and every later checkpoint is due.
  double first_wall_checkpoint() const;
  double next_wall_checkpoint(double wall_seconds) const;

 private:
  OutputSettings settings_;
};

}  // namespace sluice
