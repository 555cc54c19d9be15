// The rules of <Time>, one after the other.
#include "framework/run/component/time_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/base/error.hpp"
#include "framework/base/json.hpp"
#include "framework/base/text.hpp"

namespace sluice {
namespace {

constexpr double round_off = 1e-10;  // of a step: what a clamp may stretch it by
constexpr int max_messages = 3;      // of one kind; the counts tell the rest

constexpr std::array all_limits = {
    TimeLimit::max_delt_increase, TimeLimit::delt_min,    TimeLimit::delt_max,
    TimeLimit::delt_init,         TimeLimit::output_time, TimeLimit::checkpoint_time,
    TimeLimit::max_time,          TimeLimit::retry,       TimeLimit::override_restart_delt};

// Clamps are what the deck asked for at every output; only these corrections are worth telling.
constexpr std::array told_limits = {TimeLimit::max_delt_increase, TimeLimit::delt_min,
                                    TimeLimit::delt_max, TimeLimit::delt_init,
                                    TimeLimit::override_restart_delt};

unsigned bit(TimeLimit limit) {
  return 1U << static_cast<int>(limit);
}

// Lowers dt to the cap and says so, or leaves both.
void cap(StepPlan& plan, double limit, TimeLimit name) {
  if (limit > 0 && plan.dt > limit) {
    plan.dt = limit;
    plan.limits |= bit(name);
  }
}

// Ends the step on the target when it would reach it, or miss it only by round-off.
void clamp_to(StepPlan& plan, double target, TimeLimit name) {
  const double left = target - plan.start;
  if (left > 0 && plan.dt * (1 + round_off) >= left) {
    plan.dt = left;
    plan.end = target;
    plan.limits |= bit(name);
  }
}

void require_progress(const StepPlan& plan, const char* reason) {
  if (plan.dt > 0 && std::isfinite(plan.dt) && plan.end > plan.start) return;
  throw PhysicsError(
      fmt::format("step {} at time {}: the time step is {} ({}), so that the time cannot advance\n "
                  " look at the state for infinite speeds or vanishing densities; a smaller cfl or "
                  "a smoother initial state may help",
                  plan.step, shortest_text(plan.start), shortest_text(plan.dt), reason));
}

}  // namespace

const char* to_string(TimeLimit limit) {
  switch (limit) {
    case TimeLimit::max_delt_increase:
      return "max_delt_increase";
    case TimeLimit::delt_min:
      return "delt_min";
    case TimeLimit::delt_max:
      return "delt_max";
    case TimeLimit::delt_init:
      return "delt_init";
    case TimeLimit::override_restart_delt:
      return "override_restart_delt";
    case TimeLimit::output_time:
      return "output time";
    case TimeLimit::checkpoint_time:
      return "checkpoint time";
    case TimeLimit::max_time:
      return "maxTime";
    case TimeLimit::retry:
      return "retry";
  }
  return "unknown";
}

TimeControl::TimeControl(const TimeSettings& time, const OutputSettings& output, RunLimits limits)
    : time_(time),
      output_(output),
      limits_(limits),
      schedule_(output),
      next_wall_checkpoint_(schedule_.first_wall_checkpoint()) {
  state_.time = time_.initial_time;
  state_.schedule = schedule_.state_at(time_.initial_time);
  if (reaches(state_.time, time_.max_time, 0)) status_ = RunStatus::done;
}

void TimeControl::restart(const TimeState& state) {
  state_ = state;
  for (std::size_t n = 0; n < switches_.size(); ++n)
    if ((state_.switches >> n & 1U) != 0) take_intervals(switches_[n]);
  state_.schedule = schedule_.state_at(state.time, state.previous_dt);
  just_restarted_ = true;
  status_ = RunStatus::running;
  if (step_limit() > 0 && state_.step >= step_limit()) status_ = RunStatus::max_steps;
  if (reaches(state_.time, time_.max_time, state_.previous_dt)) status_ = RunStatus::done;
}

int TimeControl::step_limit() const {
  int limit = 0;
  for (const int most : {time_.max_timesteps, limits_.max_steps, state_.last_step})
    if (most > 0) limit = limit > 0 ? std::min(limit, most) : most;
  return limit;
}

// By time, in place of whatever the deck had.
void TimeControl::take_intervals(const OutputSwitch& by) {
  output_.interval = by.output_interval;
  output_.timestep_interval = 0;
  CheckpointSettings& checkpoint = output_.checkpoint;
  checkpoint.interval = by.checkpoint_interval;
  checkpoint.timestep_interval = 0;
  checkpoint.walltime_interval = checkpoint.walltime_start = 0;
  schedule_ = OutputSchedule(output_);
  next_wall_checkpoint_ = schedule_.first_wall_checkpoint();
}

bool TimeControl::act_on_switch(std::size_t n) {
  if ((state_.switches >> n & 1U) != 0) return false;
  state_.switches |= 1U << n;
  const OutputSwitch& by = switches_.at(n);
  take_intervals(by);
  state_.schedule = schedule_.state_at(state_.time, state_.previous_dt);
  if (by.remaining_steps > 0) state_.last_step = state_.step + by.remaining_steps;
  return true;
}

bool TimeControl::reaches_end(int step, double end, double dt) const {
  return reaches(end, time_.max_time, dt) || (step_limit() > 0 && step >= step_limit());
}

void TimeControl::apply_limits(StepPlan& plan, double physics_dt) {
  plan.dt = physics_dt * time_.timestep_multiplier;
  const bool overridden = just_restarted_ && time_.override_restart_delt > 0;
  if (overridden) {
    plan.dt = time_.override_restart_delt;
    plan.limits |= bit(TimeLimit::override_restart_delt);
  } else if (time_.max_delt_increase > 0) {
    cap(plan, (1 + time_.max_delt_increase) * state_.uncut_dt, TimeLimit::max_delt_increase);
  }
  if (time_.delt_min > 0 && plan.dt < time_.delt_min) {
    plan.dt = time_.delt_min;
    plan.limits |= bit(TimeLimit::delt_min);
  }
  cap(plan, time_.delt_max, TimeLimit::delt_max);
  if (plan.start <= time_.initial_delt_range || plan.step == 1) {
    cap(plan, time_.delt_init, TimeLimit::delt_init);
  }
  if (plan.set_by(TimeLimit::delt_min) && plan.dt > physics_dt) plan.stable_dt = physics_dt;
}

void TimeControl::apply_clamps(StepPlan& plan) const {
  plan.uncut_dt = plan.dt;
  plan.end = plan.start + plan.dt;
  if (time_.clamp_time_to_output) {
    clamp_to(plan, schedule_.next_output_time(state_.schedule), TimeLimit::output_time);
    clamp_to(plan, schedule_.next_checkpoint_time(state_.schedule), TimeLimit::checkpoint_time);
  }
  if (time_.end_at_max_time_exactly) clamp_to(plan, time_.max_time, TimeLimit::max_time);
}

void TimeControl::decide_saves(StepPlan& plan) const {
  plan.last = reaches_end(plan.step, plan.end, plan.dt);
  plan.output = schedule_.outputs(plan.step, plan.end, plan.dt, state_.schedule) ||
                (plan.last && output_.last_timestep);
  plan.checkpoint = schedule_.checkpoints(plan.step, plan.end, plan.dt, state_.schedule) ||
                    (plan.last && output_.checkpoint.last_timestep);
  const auto act = [&plan](TimeLimit limit, const LimitAction& action) {
    if (!plan.set_by(limit)) return;
    plan.output = plan.output || action.output;
    plan.checkpoint = plan.checkpoint || action.checkpoint;
  };
  act(TimeLimit::max_delt_increase, time_.on_max_delt_increase);
  act(TimeLimit::delt_min, time_.on_delt_min);
  act(TimeLimit::delt_max, time_.on_delt_max);
  act(TimeLimit::delt_init, time_.on_delt_init);
}

// One sentence for the corrections that did not act in the step before; a warning where the step is
// no longer a stable one.
std::string TimeControl::describe(const StepPlan& plan, double physics_dt) {
  std::vector<std::string> names;
  for (const TimeLimit limit : told_limits) {
    if (!plan.set_by(limit) || (told_limits_ & bit(limit)) != 0) continue;
    if (++told_counts_[limit] <= max_messages) names.emplace_back(to_string(limit));
  }
  told_limits_ = plan.limits;
  if (names.empty() || (plan.stable_dt > 0 ? !limits_.warn : !limits_.tell)) return {};
  const double before = physics_dt * time_.timestep_multiplier;
  const std::string text = fmt::format(
      "step {} at time {:.6g}: {} {} the time step from {:.6g} to {:.6g}", plan.step, plan.start,
      join(names, ", then "), plan.dt > before ? "raises" : "lowers", before, plan.dt);
  if (plan.stable_dt == 0) return text;
  return fmt::format(
      "warning: {}, above the stable one: the run may fail, or its result be wrong; "
      "lower <delt_min>",
      text);
}

std::string TimeControl::text_of_delt_min(const StepPlan& failed) const {
  if (time_.delt_min <= 0 || 0.5 * failed.dt >= time_.delt_min) return {};
  return fmt::format(
      "\n  <delt_min> {} {}; lower it", shortest_text(time_.delt_min),
      failed.stable_dt > 0
          ? fmt::format("has raised this step above the stable one, dt = {:.6g}", failed.stable_dt)
          : std::string("allows no smaller step"));
}

StepPlan TimeControl::plan(double physics_dt) {
  StepPlan plan;
  plan.step = state_.step + 1;
  plan.start = state_.time;
  plan.dt = physics_dt;
  plan.end = plan.start + plan.dt;
  if (!(physics_dt > 0) || !std::isfinite(physics_dt)) {
    plan.end = plan.start;
    require_progress(plan, "from the physics");
  }
  apply_limits(plan, physics_dt);
  std::string message = describe(plan, physics_dt);
  apply_clamps(plan);
  require_progress(plan, "after all limits");
  decide_saves(plan);
  plan.message = std::move(message);
  return plan;
}

StepPlan TimeControl::retry(const StepPlan& rejected, double dt) {
  StepPlan plan;
  plan.step = rejected.step;
  plan.start = rejected.start;
  plan.dt = dt;
  plan.limits = bit(TimeLimit::retry);
  if (time_.delt_min > 0 && dt < time_.delt_min) {
    throw PhysicsError(fmt::format(
        "step {} at time {}: the step of {} was rejected, and {} would be below delt_min = {}\n  "
        "lower delt_min, or look in the event ledger for the fault of the state",
        plan.step, shortest_text(plan.start), shortest_text(rejected.dt), shortest_text(dt),
        shortest_text(time_.delt_min)));
  }
  apply_clamps(plan);
  require_progress(plan, "of a repeated step");
  decide_saves(plan);
  return plan;
}

StepEnd TimeControl::accept(const StepPlan& plan, double wall_seconds, bool terminate) {
  state_.step = plan.step;
  state_.time = plan.end;
  state_.previous_dt = plan.dt;
  state_.uncut_dt = plan.uncut_dt;
  state_.physics_dt = 0;
  state_.schedule = schedule_.advance(plan.end, plan.dt, state_.schedule);
  just_restarted_ = false;
  for (const TimeLimit limit : all_limits) {
    if (plan.set_by(limit)) ++limit_counts_[limit];
  }

  StepEnd end;
  end.checkpoint = plan.checkpoint;
  if (wall_seconds >= next_wall_checkpoint_) {
    end.checkpoint = true;
    next_wall_checkpoint_ = schedule_.next_wall_checkpoint(wall_seconds);
  }
  const auto over = [wall_seconds](double limit) { return limit > 0 && wall_seconds >= limit; };
  if (reaches(plan.end, time_.max_time, plan.dt)) {
    end.status = RunStatus::done;
  } else if (plan.last) {
    end.status = RunStatus::max_steps;
  } else if (terminate) {
    end.status = RunStatus::terminated;
  } else if (over(time_.max_wall_time) || over(limits_.wall_seconds)) {
    end.status = RunStatus::wall_limit;
  }
  // Cut short by the clock, a signal or the caller's number of steps: the run must be able to go on
  // from here.
  const bool asked = limits_.max_steps > 0 && plan.step >= limits_.max_steps;
  const bool cut = end.status == RunStatus::terminated || end.status == RunStatus::wall_limit ||
                   (end.status == RunStatus::max_steps && asked);
  const bool last = end.status != RunStatus::running && output_.checkpoint.last_timestep;
  end.checkpoint = end.checkpoint || cut || last;
  status_ = end.status;
  return end;
}

std::string to_json_text(const TimeState& state) {
  return Json{{"step", state.step},
              {"time", state.time},
              {"previous_dt", state.previous_dt},
              {"uncut_dt", state.uncut_dt},
              {"physics_dt", state.physics_dt},
              {"next_output", state.schedule.next_output},
              {"next_checkpoint", state.schedule.next_checkpoint},
              {"switches", state.switches},
              {"last_step", state.last_step}}
      .dump();
}

TimeState time_state_from_json_text(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    TimeState state;
    state.step = json.at("step").get<int>();
    state.time = json.at("time").get<double>();
    state.previous_dt = json.at("previous_dt").get<double>();
    state.physics_dt = json.at("physics_dt").get<double>();
    state.schedule.next_output = json.at("next_output").get<std::int64_t>();
    state.schedule.next_checkpoint = json.at("next_checkpoint").get<std::int64_t>();
    // Archives of earlier versions have neither of these.
    state.uncut_dt =
        json.contains("uncut_dt") ? json.at("uncut_dt").get<double>() : state.previous_dt;
    if (json.contains("switches")) {
      state.switches = json.at("switches").get<unsigned>();
      state.last_step = json.at("last_step").get<int>();
    }
    return state;
  } catch (const JsonError& error) {
    throw InputError(fmt::format(
        "the time state of a checkpoint cannot be read: {}\n  found '{}'; restart from an earlier "
        "checkpoint",
        error.what(), text));
  }
}

}  // namespace sluice
