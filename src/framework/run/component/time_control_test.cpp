// The rules of <Time> one by one, exact ends, retries, restarts and the ways a run stops.
#include "framework/run/component/time_control.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "framework/base/error.hpp"

namespace sluice::time_control_test {
namespace {

using testing::HasSubstr;

TimeSettings plain_time() {
  TimeSettings time;
  time.max_time = 10;
  return time;
}

// Growth is limited, and steps are shortened to meet outputs.
TimeSettings growing_time() {
  TimeSettings time = plain_time();
  time.max_delt_increase = 0.1;
  time.clamp_time_to_output = true;
  return time;
}

TimeState state_after(int step, double time, double previous_dt) {
  TimeState state;
  state.step = step;
  state.time = time;
  state.previous_dt = previous_dt;
  return state;
}

// As from a checkpoint.
TimeControl restarted(const TimeSettings& time, const OutputSettings& output,
                      const TimeState& state) {
  TimeControl control(time, output);
  control.restart(time_state_from_json_text(to_json_text(state)));
  return control;
}

StepEnd accept(TimeControl& control, const StepPlan& plan) {
  return control.accept(plan, 0.0, false);
}

TEST(TimeControl, multiplier_scales_what_the_physics_allows) {
  TimeSettings time = plain_time();
  time.timestep_multiplier = 0.5;
  TimeControl control(time, {});
  const StepPlan plan = control.plan(0.25);
  EXPECT_EQ(plan.step, 1);
  EXPECT_EQ(plan.start, 0);
  EXPECT_EQ(plan.dt, 0.125);
  EXPECT_EQ(plan.end, 0.125);
  EXPECT_EQ(plan.limits, 0U);
  EXPECT_EQ(plan.message, "");
}

TEST(TimeControl, increase_is_a_fraction_of_the_last_step) {
  TimeSettings time = plain_time();
  time.max_delt_increase = 0.5;
  TimeControl control(time, {});
  accept(control, control.plan(0.125));  // the first step has nothing to grow from
  EXPECT_EQ(control.state().time, 0.125);
  const StepPlan second = control.plan(1.0);
  EXPECT_EQ(second.dt, 0.1875);
  EXPECT_TRUE(second.set_by(TimeLimit::max_delt_increase));
  accept(control, second);
  EXPECT_EQ(control.plan(0.2).dt, 0.2);  // within the increase
  EXPECT_EQ(control.plan(0.01).dt, 0.01);
}

// What is no longer stable is told, whatever else is silent; and it is named where the step fails.
TEST(TimeControl, a_floor_above_the_stable_step_is_a_warning) {
  TimeSettings time = plain_time();
  time.delt_min = 0.1;
  RunLimits silent;
  silent.tell = false;
  TimeControl control(time, {}, silent);
  const StepPlan raised = control.plan(0.02);
  EXPECT_EQ(raised.dt, 0.1);
  EXPECT_EQ(raised.stable_dt, 0.02);
  EXPECT_THAT(raised.message, HasSubstr("warning: step 1 at time 0: delt_min raises the time step "
                                        "from 0.02 to 0.1, above the stable one"));
  EXPECT_THAT(control.text_of_delt_min(raised),
              HasSubstr("<delt_min> 0.1 has raised this step above the stable one, dt = 0.02"));
  accept(control, raised);
  EXPECT_EQ(control.plan(0.02).message, "") << "told once";
  const StepPlan free = control.plan(0.3);
  EXPECT_EQ(free.stable_dt, 0);
  EXPECT_EQ(control.text_of_delt_min(free), "") << "a smaller step is allowed";
  EXPECT_THAT(control.text_of_delt_min(control.plan(0.15)), HasSubstr("allows no smaller step"));
  silent.warn = false;
  EXPECT_EQ(TimeControl(time, {}, silent).plan(0.02).message, "");
}

// Below the stable step a floor only undoes another limit.
TEST(TimeControl, a_floor_below_the_stable_step_is_none) {
  TimeSettings time = plain_time();
  time.delt_min = 0.5;
  time.max_delt_increase = 0.5;
  TimeState state = state_after(3, 1.0, 0.1);
  state.uncut_dt = 0.1;
  const StepPlan plan = restarted(time, {}, state).plan(1.0);
  EXPECT_EQ(plan.dt, 0.5);
  EXPECT_EQ(plan.stable_dt, 0);
  EXPECT_THAT(plan.message, testing::Not(HasSubstr("warning")));
}

TEST(TimeControl, floor_then_cap_then_initial_cap) {
  TimeSettings time = plain_time();
  time.delt_min = 0.1;
  time.delt_max = 0.4;
  EXPECT_EQ(TimeControl(time, {}).plan(0.01).dt, 0.1);
  EXPECT_TRUE(TimeControl(time, {}).plan(0.01).set_by(TimeLimit::delt_min));
  EXPECT_EQ(TimeControl(time, {}).plan(0.9).dt, 0.4);
  EXPECT_TRUE(TimeControl(time, {}).plan(0.9).set_by(TimeLimit::delt_max));
  time.delt_init = 0.02;  // comes after the floor and goes below it
  EXPECT_EQ(TimeControl(time, {}).plan(0.9).dt, 0.02);
  time.delt_min = 0.5;  // contradicts the cap, which comes later
  time.delt_init = 0;
  EXPECT_EQ(TimeControl(time, {}).plan(0.01).dt, 0.4);
}

TEST(TimeControl, initial_cap_holds_over_its_range) {
  TimeSettings time = plain_time();
  time.delt_init = 0.125;
  TimeControl first_only(time, {});
  EXPECT_EQ(first_only.plan(1).dt, 0.125);
  accept(first_only, first_only.plan(1));
  EXPECT_EQ(first_only.plan(1).dt, 1);
  time.initial_delt_range = 0.25;  // steps that start at 0, .125 and .25
  TimeControl ranged(time, {});
  for (int step = 0; step < 3; ++step) {
    const StepPlan plan = ranged.plan(1);
    EXPECT_EQ(plan.dt, 0.125);
    EXPECT_TRUE(plan.set_by(TimeLimit::delt_init));
    accept(ranged, plan);
  }
  EXPECT_EQ(ranged.plan(1).dt, 1);
}

TEST(TimeControl, first_step_cap_also_when_time_starts_late) {
  TimeSettings time = plain_time();
  time.initial_time = 5;
  time.delt_init = 0.125;
  EXPECT_EQ(TimeControl(time, {}).plan(1).dt, 0.125);
}

TEST(TimeControl, ends_at_the_very_bits_of_max_time) {
  for (const double max_time : {0.1, 0.3, 1.0 / 3.0, 0.7, 12.34e-5}) {
    TimeSettings time = plain_time();
    time.max_time = max_time;
    time.end_at_max_time_exactly = true;
    TimeControl control(time, {});
    int steps = 0;
    while (control.status() == RunStatus::running) {
      const StepPlan plan = control.plan(max_time / 10);  // ten of them miss it by round-off
      EXPECT_EQ(plan.last, plan.set_by(TimeLimit::max_time));
      accept(control, plan);
      ++steps;
    }
    EXPECT_EQ(steps, 10);
    EXPECT_EQ(control.state().time, max_time);
    EXPECT_EQ(control.status(), RunStatus::done);
  }
}

TEST(TimeControl, without_the_flag_the_last_step_runs_over) {
  TimeSettings time = plain_time();
  time.max_time = 1;
  TimeControl control(time, {});
  while (control.status() == RunStatus::running) accept(control, control.plan(0.375));
  EXPECT_EQ(control.state().time, 1.125);
  EXPECT_EQ(control.state().step, 3);
}

TEST(TimeControl, clamps_to_outputs_and_checkpoints_below_the_floor) {
  TimeSettings time = plain_time();
  time.clamp_time_to_output = true;
  time.delt_min = 0.2;
  time.max_time = 1;
  OutputSettings output;
  output.interval = 0.3;
  output.checkpoint.interval = 0.5;
  TimeControl control(time, output);
  std::vector<double> ends;
  std::vector<int> outputs, checkpoints;
  while (control.status() == RunStatus::running) {
    const StepPlan plan = control.plan(0.2);
    ends.push_back(plan.end);
    if (plan.output) outputs.push_back(plan.step);
    if (plan.checkpoint) checkpoints.push_back(plan.step);
    accept(control, plan);
  }
  const double third = 3 * 0.3;
  EXPECT_EQ(ends, (std::vector<double>{0.2, 0.3, 0.5, 0.6, 0.8, third, 1.0}));
  EXPECT_EQ(outputs, (std::vector<int>{1, 2, 4, 6}));
  EXPECT_EQ(checkpoints, (std::vector<int>{3, 7}));
}

TEST(TimeControl, limits_may_ask_for_output_and_checkpoint) {
  TimeSettings time = plain_time();
  time.delt_max = 0.5;
  time.on_delt_max.output = true;
  time.delt_min = 0.1;
  time.on_delt_min.checkpoint = true;
  TimeControl control(time, {});
  EXPECT_TRUE(control.plan(1).output);
  EXPECT_FALSE(control.plan(1).checkpoint);
  EXPECT_FALSE(control.plan(0.25).output);
  EXPECT_TRUE(control.plan(0.01).checkpoint);
}

TEST(TimeControl, a_correction_is_told_once_per_change) {
  TimeSettings time = plain_time();
  time.delt_max = 0.5;
  TimeControl control(time, {});
  std::vector<std::string> messages;
  for (const double dt : {1.0, 1.0, 1.0, 0.25, 1.0, 0.25, 1.0, 0.25, 1.0, 0.25, 1.0}) {
    const StepPlan plan = control.plan(dt);
    if (!plan.message.empty()) messages.push_back(plan.message);
    accept(control, plan);
  }
  ASSERT_EQ(messages.size(), 3U) << "the first changes only; the count tells the rest";
  EXPECT_THAT(messages[0], HasSubstr("step 1 at time 0: delt_max lowers the time step"));
  EXPECT_THAT(messages[0], HasSubstr("from 1 to 0.5"));
  EXPECT_THAT(messages[1], HasSubstr("step 5 "));
  EXPECT_EQ(control.limit_counts().at(TimeLimit::delt_max), 7);
}

TEST(TimeControl, last_steps_are_kept_when_asked) {
  TimeSettings time = plain_time();
  time.max_timesteps = 3;
  OutputSettings output;
  output.timestep_interval = 100;
  output.last_timestep = true;
  output.checkpoint.last_timestep = true;
  TimeControl control(time, output);
  EXPECT_TRUE(control.plan(0.1).output);  // step 1
  accept(control, control.plan(0.1));
  EXPECT_FALSE(control.plan(0.1).output);
  accept(control, control.plan(0.1));
  const StepPlan last = control.plan(0.1);
  EXPECT_TRUE(last.last);
  EXPECT_TRUE(last.output);
  EXPECT_TRUE(last.checkpoint);
  EXPECT_EQ(accept(control, last).status, RunStatus::max_steps);
}

TEST(TimeControl, the_smaller_number_of_steps_counts) {
  TimeSettings time = plain_time();
  time.max_timesteps = 5;
  for (const int option : {0, 2, 9}) {
    RunLimits limits;
    limits.max_steps = option;
    TimeControl control(time, {}, limits);
    while (control.status() == RunStatus::running) accept(control, control.plan(0.01));
    EXPECT_EQ(control.status(), RunStatus::max_steps);
    EXPECT_EQ(control.state().step, option == 2 ? 2 : 5);
  }
}

TEST(TimeControl, clock_and_signal_end_with_a_checkpoint) {
  TimeSettings time = plain_time();
  time.max_wall_time = 100;
  RunLimits limits;
  limits.wall_seconds = 50;
  TimeControl control(time, {}, limits);
  EXPECT_EQ(control.accept(control.plan(0.1), 49, false).status, RunStatus::running);
  const StepEnd end = control.accept(control.plan(0.1), 50, false);
  EXPECT_EQ(end.status, RunStatus::wall_limit);
  EXPECT_TRUE(end.checkpoint);
  TimeControl other(time, {});
  const StepEnd terminated = other.accept(other.plan(0.1), 1, true);
  EXPECT_EQ(terminated.status, RunStatus::terminated);
  EXPECT_TRUE(terminated.checkpoint);
  EXPECT_STREQ(to_string(other.status()), "terminated");
}

TEST(TimeControl, a_run_that_is_done_is_done_whatever_the_signal) {
  TimeSettings time = plain_time();
  time.max_time = 0.1;
  TimeControl control(time, {});
  const StepEnd end = control.accept(control.plan(0.1), 1e9, true);
  EXPECT_EQ(end.status, RunStatus::done);
  EXPECT_FALSE(end.checkpoint);
}

TEST(TimeControl, wall_clock_checkpoints) {
  OutputSettings output;
  output.checkpoint.walltime_interval = 10;
  TimeControl control(plain_time(), output);
  std::vector<int> checkpoints;
  for (const double wall : {4.0, 9.0, 11.0, 19.0, 43.0, 49.0, 50.0}) {
    const StepPlan plan = control.plan(0.01);
    if (control.accept(plan, wall, false).checkpoint) checkpoints.push_back(plan.step);
  }
  EXPECT_EQ(checkpoints, (std::vector<int>{3, 5, 7}));
}

TEST(TimeControl, a_retry_is_the_same_step_with_its_own_saves) {
  TimeSettings time = plain_time();
  time.max_time = 1;
  time.end_at_max_time_exactly = true;
  OutputSettings output;
  output.interval = 0.75;
  TimeControl control(time, output);
  accept(control, control.plan(0.5));
  const StepPlan plan = control.plan(0.5);
  EXPECT_TRUE(plan.output);
  EXPECT_TRUE(plan.last);
  const StepPlan smaller = control.retry(plan, 0.125);
  EXPECT_EQ(smaller.step, plan.step);
  EXPECT_EQ(smaller.start, 0.5);
  EXPECT_EQ(smaller.end, 0.625);
  EXPECT_FALSE(smaller.output);
  EXPECT_FALSE(smaller.last);
  EXPECT_TRUE(smaller.set_by(TimeLimit::retry));
  accept(control, smaller);
  EXPECT_EQ(control.state().previous_dt, 0.125);
  EXPECT_EQ(control.limit_counts().at(TimeLimit::retry), 1);
  EXPECT_EQ(control.limit_counts().count(TimeLimit::max_time), 0U);
}

// A step that an output cuts to a sliver says nothing about the physics: the next may be as large
// as if it had not been cut.
TEST(TimeControl, steps_cut_for_an_output_do_not_hold_back_those_after) {
  const TimeSettings time = growing_time();
  OutputSettings output;
  output.interval = 1;
  TimeControl control(time, output);
  for (const double end : {0.75, 1.0, 1.75, 2.0}) {
    const StepPlan plan = control.plan(0.75);
    EXPECT_EQ(plan.end, end);
    accept(control, plan);
  }
  EXPECT_EQ(control.state().previous_dt, 0.25);
  EXPECT_EQ(control.state().uncut_dt, 0.75);
  TimeControl again = restarted(time, output, control.state());
  EXPECT_EQ(again.plan(10).uncut_dt, (1 + 0.1) * 0.75);
  // One that was redone with less does.
  const StepPlan redone = control.retry(control.plan(0.75), 0.125);
  accept(control, redone);
  EXPECT_EQ(control.plan(0.75).dt, (1 + 0.1) * 0.125);
}

TEST(TimeControl, refuses_steps_that_lead_nowhere) {
  TimeSettings time = plain_time();
  TimeControl control(time, {});
  EXPECT_THROW(control.plan(0), PhysicsError);
  EXPECT_THROW(control.plan(-1), PhysicsError);
  EXPECT_THROW(control.plan(std::numeric_limits<double>::quiet_NaN()), PhysicsError);
  EXPECT_THROW(control.plan(std::numeric_limits<double>::infinity()), PhysicsError);
  accept(control, control.plan(1.0));
  EXPECT_THROW(control.plan(1e-17), PhysicsError) << "1 + 1e-17 is 1: time stands still";
  EXPECT_THROW(control.retry(control.plan(0.5), 1e-17), PhysicsError);
  time.delt_min = 0.1;
  TimeControl floored(time, {});
  EXPECT_THROW(floored.retry(floored.plan(0.15), 0.075), PhysicsError);
}

TEST(TimeControl, restarts_go_on_with_the_same_bits) {
  TimeSettings time = growing_time();
  time.end_at_max_time_exactly = true;
  time.max_time = 2;
  OutputSettings output;
  output.interval = 0.1;
  output.checkpoint.interval = 0.35;
  const auto physics = [](int step) { return 0.05 + 0.04 * std::sin(step); };
  TimeControl whole(time, output);
  std::vector<TimeState> states;
  std::vector<StepPlan> plans;
  while (whole.status() == RunStatus::running) {
    plans.push_back(whole.plan(physics(whole.state().step)));
    accept(whole, plans.back());
    whole.remember_physics_dt(physics(whole.state().step));
    states.push_back(whole.state());
  }
  EXPECT_EQ(whole.state().time, 2.0);
  for (const std::size_t at : {0UL, 7UL, states.size() / 2}) {
    TimeControl again = restarted(time, output, states[at]);
    for (std::size_t i = at + 1; i < states.size(); ++i) {
      const StepPlan plan = again.plan(again.state().physics_dt);
      EXPECT_EQ(plan.end, plans[i].end);
      EXPECT_EQ(plan.output, plans[i].output);
      EXPECT_EQ(plan.checkpoint, plans[i].checkpoint);
      accept(again, plan);
      again.remember_physics_dt(physics(again.state().step));
      EXPECT_EQ(again.state(), states[i]);
    }
    EXPECT_EQ(again.status(), RunStatus::done);
  }
}

// Intervals that a run takes once it has come to something; a restart behind it keeps them.
TEST(TimeControl, a_switch_changes_intervals_once_and_ends_the_run) {
  OutputSettings output;
  output.timestep_interval = 1;
  output.checkpoint.timestep_interval = 1;
  const std::vector<OutputSwitch> switches = {{0.3, 0.5, 0}, {0.2, 0.4, 6}};
  TimeControl whole(plain_time(), output);
  whole.set_switches(switches);
  std::vector<TimeState> states;
  std::vector<StepPlan> plans;
  while (whole.status() == RunStatus::running) {
    plans.push_back(whole.plan(0.1));
    accept(whole, plans.back());
    if (plans.back().step == 4) {
      EXPECT_TRUE(whole.act_on_switch(0));
    }
    if (plans.back().step == 10) {
      EXPECT_TRUE(whole.act_on_switch(1));
    }
    if (plans.back().step > 10) {
      EXPECT_FALSE(whole.act_on_switch(0));
    }
    states.push_back(whole.state());
  }
  EXPECT_EQ(whole.status(), RunStatus::max_steps);
  std::vector<int> outputs, checkpoints;
  for (const StepPlan& plan : plans) {
    if (plan.output) outputs.push_back(plan.step);
    if (plan.checkpoint) checkpoints.push_back(plan.step);
  }
  EXPECT_EQ(outputs, (std::vector<int>{1, 2, 3, 4, 6, 9, 12, 14, 16}));
  EXPECT_EQ(checkpoints, (std::vector<int>{2, 3, 4, 5, 10, 12, 16}));
  for (const std::size_t at : {2UL, 5UL, 11UL}) {
    TimeControl again(plain_time(), output);
    again.set_switches(switches);
    again.restart(time_state_from_json_text(to_json_text(states[at])));
    for (std::size_t i = at + 1; i < states.size(); ++i) {
      const StepPlan plan = again.plan(0.1);
      EXPECT_EQ(plan.output, plans[i].output) << i;
      EXPECT_EQ(plan.checkpoint, plans[i].checkpoint) << i;
      accept(again, plan);
      if (plan.step == 4) again.act_on_switch(0);
      if (plan.step == 10) again.act_on_switch(1);
      EXPECT_EQ(again.state(), states[i]);
    }
    EXPECT_EQ(again.status(), RunStatus::max_steps);
  }
}

TEST(TimeControl, restart_may_override_its_first_step) {
  TimeSettings time = plain_time();
  time.override_restart_delt = 0.5;
  time.max_delt_increase = 0.1;
  TimeControl fresh(time, {});
  EXPECT_EQ(fresh.plan(0.1).dt, 0.1);
  TimeControl control = restarted(time, {}, state_after(10, 1, 0.1));
  const StepPlan first = control.plan(0.1);
  EXPECT_EQ(first.step, 11);
  EXPECT_EQ(first.dt, 0.5);
  EXPECT_TRUE(first.set_by(TimeLimit::override_restart_delt));
  accept(control, first);
  EXPECT_EQ(control.plan(0.1).dt, 0.1);
}

TEST(TimeControl, restart_at_the_end_has_nothing_to_do) {
  TimeSettings time = plain_time();
  time.max_timesteps = 20;
  TimeControl control = restarted(time, {}, state_after(20, 1, 0));
  EXPECT_EQ(control.status(), RunStatus::max_steps);
  control.restart(state_after(20, 10, 0));
  EXPECT_EQ(control.status(), RunStatus::done);
  time.max_time = 0;
  EXPECT_EQ(TimeControl(time, {}).status(), RunStatus::done);
}

TEST(TimeControl, restart_with_another_interval_counts_anew) {
  TimeState state = state_after(10, 1, 0.1);
  state.schedule.next_output = 11;
  OutputSettings output;
  output.interval = 0.4;
  output.checkpoint.interval = 0.3;
  const TimeControl control = restarted(plain_time(), output, state);
  EXPECT_EQ(control.state().schedule.next_output, 3);      // 1.2
  EXPECT_EQ(control.state().schedule.next_checkpoint, 4);  // 1.2
}

TEST(TimeControl, state_reads_back_exactly_or_is_refused) {
  TimeState state;
  state.step = 123456;
  state.time = 1.0 / 3.0;
  state.previous_dt = std::nextafter(1e-9, 1.0);
  state.uncut_dt = std::nextafter(2e-9, 1.0);
  state.physics_dt = 5e-324;
  state.schedule.next_output = 1234567890123;
  state.schedule.next_checkpoint = -3;
  EXPECT_EQ(time_state_from_json_text(to_json_text(state)), state);
  EXPECT_THROW(time_state_from_json_text("{\"step\": 1}"), InputError);
  EXPECT_THROW(time_state_from_json_text("{\"step\": \"x\""), InputError);
  EXPECT_THROW(time_state_from_json_text(""), InputError);
}

}  // namespace
}  // namespace sluice::time_control_test
