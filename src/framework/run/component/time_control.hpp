// The size of each step, what is kept of it, and when the run ends: the deck's <Time> rules.
//
// The step that the physics allows passes, in this order:
//   timestep_multiplier -> max_delt_increase (a fraction: at most (1 + x) times the last step, as
//   it was before an output, a checkpoint or the end cut it)
//   -> delt_min -> delt_max -> delt_init (while the step starts at or before initial_delt_range,
//   and the very first step) -> next output -> next checkpoint (both with
//   clamp_time_to_output) -> maxTime (with end_at_max_time_exactly).
// The last three may go below delt_min; a step that they set ends on the very bits of that time,
// and one that would fall short of it by round-off is stretched onto it.
//
// No clock, signal or message is asked here: the same calls give the same answers on all ranks.
// Times and steps in s, also those of the wall clock.
//
//   TimeControl control(scene.time, scene.output, limits);
//   while (control.status() == RunStatus::running) {
//     StepPlan plan = control.plan(physics_dt);
//     while (!advance(plan)) plan = control.retry(plan, plan.dt / 2);
//     StepEnd end = control.accept(plan, wall_seconds, terminate);
//     if (end.checkpoint) ...
//   }
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "framework/run/component/output_schedule.hpp"
#include "framework/run/component/run_status.hpp"
#include "framework/scene/output_switch.hpp"
#include "framework/scene/time_settings.hpp"

namespace sluice {

// What may set the size of a step, besides the physics.
enum class TimeLimit {
  max_delt_increase,
  delt_min,
  delt_max,
  delt_init,
  override_restart_delt,
  output_time,
  checkpoint_time,
  max_time,
  retry
};
const char* to_string(TimeLimit limit);

// Limits of this run beside those of the deck (options of the command); 0: none.
struct RunLimits {
  int max_steps = 0;        // step number, as max_Timesteps
  double wall_seconds = 0;  // as max_wall_time
  bool tell = true;         // a message when a limit of the deck sets the step
  bool warn = true;         // a warning when one raises it above the stable step
};

// All that a restart needs to go on with the same bits.
struct TimeState {
  int step = 0;  // steps done
  double time = 0;
  double previous_dt = 0;  // of the last step; 0 before the first
  double uncut_dt = 0;     // the same before an output, a checkpoint or the end cut it
  double physics_dt = 0;   // what the physics allows next, where it is known already; else 0
  ScheduleState schedule;
  unsigned switches = 0;  // which have acted, one bit for each
  int last_step = 0;      // that one of them has set; 0: none

  bool operator==(const TimeState&) const = default;
};
// One line of JSON; doubles read back to the same bits.
std::string to_json_text(const TimeState& state);
TimeState time_state_from_json_text(const std::string& text);

struct StepPlan {
  int step = 0;  // number of this step; the first is 1
  double start = 0;
  double dt = 0;
  double uncut_dt = 0;  // before an output, a checkpoint or the end cut it
  double end = 0;       // the time that the run has after it: exactly the one aimed at
  unsigned limits = 0;  // what has set dt, one bit for each TimeLimit
  bool output = false;
  bool checkpoint = false;
  bool last = false;     // the run ends with it whatever the clock says
  double stable_dt = 0;  // what the physics allows, where delt_min has raised dt above it; else 0
  std::string message;   // a correction worth telling; empty when told before

  bool set_by(TimeLimit limit) const { return (limits >> static_cast<int>(limit) & 1U) != 0; }
};

struct StepEnd {
  RunStatus status = RunStatus::running;
  bool checkpoint = false;
};

class TimeControl {
 public:
  TimeControl(const TimeSettings& time, const OutputSettings& output, RunLimits limits = {});

  // What may change the intervals later: known before a restart.
  void set_switches(std::vector<OutputSwitch> switches) { switches_ = std::move(switches); }
  // The n-th acts from the step behind the last on; again: nothing. Whether it has.
  bool act_on_switch(std::size_t n);

  // Another component goes on: its limits of the step, with the same times of the run.
  void take_limits(const TimeSettings& time) { time_ = time; }

  // Goes on from a checkpoint. Intervals of outputs and checkpoints may have changed since: what is
  // due next are the multiples of those of now.
  void restart(const TimeState& state);

  const TimeState& state() const { return state_; }
  RunStatus status() const { return status_; }
  bool outputs_initial_state() const { return schedule_.outputs_initial_state(); }

  // The next step. PhysicsError when physics_dt is not a positive number or too small for the
  // time to move.
  StepPlan plan(double physics_dt);
  // The same step once more, smaller. PhysicsError below delt_min or when time stands still.
  StepPlan retry(const StepPlan& rejected, double dt);
  // For the message of a failure: what delt_min has to do with it; empty where it has nothing.
  std::string text_of_delt_min(const StepPlan& failed) const;
  // The step is done. wall_seconds and terminate must have been agreed upon by all ranks.
  StepEnd accept(const StepPlan& plan, double wall_seconds, bool terminate);
  // What the physics allows next, when it is known at the end of a step: kept in checkpoints.
  void remember_physics_dt(double dt) { state_.physics_dt = dt; }

  // How often each limit has set a step.
  const std::map<TimeLimit, std::int64_t>& limit_counts() const { return limit_counts_; }

 private:
  void apply_limits(StepPlan& plan, double physics_dt);
  void apply_clamps(StepPlan& plan) const;
  void decide_saves(StepPlan& plan) const;
  std::string describe(const StepPlan& plan, double physics_dt);
  bool reaches_end(int step, double end, double dt) const;
  int step_limit() const;
  void take_intervals(const OutputSwitch& by);

  TimeSettings time_;
  OutputSettings output_;
  RunLimits limits_;
  OutputSchedule schedule_;
  std::vector<OutputSwitch> switches_;
  TimeState state_;
  RunStatus status_ = RunStatus::running;
  bool just_restarted_ = false;
  double next_wall_checkpoint_;
  unsigned told_limits_ = 0;  // the corrections of the last step: told once per change
  std::map<TimeLimit, int> told_counts_;
  std::map<TimeLimit, std::int64_t> limit_counts_;
};

}  // namespace sluice
