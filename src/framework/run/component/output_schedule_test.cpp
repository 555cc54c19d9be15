// The rules of <DataArchiver> step by step.
#include "framework/run/component/output_schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace sluice::output_schedule_test {
namespace {

// The steps that are kept when time advances by dt.
struct Kept {
  std::vector<int> outputs, checkpoints;
};
Kept run(const OutputSettings& settings, double start, double dt, int steps) {
  const OutputSchedule schedule(settings);
  ScheduleState state = schedule.state_at(start);
  Kept kept;
  double time = start;
  for (int step = 1; step <= steps; ++step) {
    const double end = time + dt;
    if (schedule.outputs(step, end, dt, state)) kept.outputs.push_back(step);
    if (schedule.checkpoints(step, end, dt, state)) kept.checkpoints.push_back(step);
    state = schedule.advance(end, dt, state);
    time = end;
  }
  return kept;
}

TEST(OutputSchedule, by_steps) {
  OutputSettings settings;
  settings.timestep_interval = 4;
  EXPECT_EQ(run(settings, 0, 0.1, 10).outputs, (std::vector<int>{1, 5, 9}));
  EXPECT_FALSE(OutputSchedule(settings).outputs_initial_state());
  settings.initial_timestep = true;
  EXPECT_EQ(run(settings, 0, 0.1, 10).outputs, (std::vector<int>{4, 8}));
  EXPECT_TRUE(OutputSchedule(settings).outputs_initial_state());
  settings.timestep_interval = 1;
  EXPECT_EQ(run(settings, 0, 0.1, 3).outputs, (std::vector<int>{1, 2, 3}));
  settings.initial_timestep = false;
  EXPECT_EQ(run(settings, 0, 0.1, 3).outputs, (std::vector<int>{1, 2, 3}));
}

TEST(OutputSchedule, by_time_first_step_then_multiples) {
  OutputSettings settings;
  settings.interval = 0.35;
  // Ends .1 .2 .3 .4 .5 .6 .7 .8 .9 1.0 1.1: multiples .35, .7 and 1.05 are reached in 4, 7, 11.
  EXPECT_EQ(run(settings, 0, 0.1, 11).outputs, (std::vector<int>{1, 4, 7, 11}));
  EXPECT_TRUE(run(settings, 0, 0.1, 11).checkpoints.empty());
  settings.interval = 0.01;  // shorter than a step: every step, once
  EXPECT_EQ(run(settings, 0, 0.1, 4).outputs, (std::vector<int>{1, 2, 3, 4}));
}

TEST(OutputSchedule, multiples_count_from_zero_not_from_the_start) {
  OutputSettings settings;
  settings.interval = 1.0;
  EXPECT_EQ(run(settings, 5.25, 0.25, 9).outputs, (std::vector<int>{1, 3, 7}));
  EXPECT_EQ(run(settings, -1.5, 0.25, 7).outputs, (std::vector<int>{1, 2, 6}));
}

TEST(OutputSchedule, round_off_of_time_delays_nothing) {
  OutputSettings settings;
  settings.interval = 0.1;
  settings.checkpoint.interval = 0.3;
  // Ten steps of 0.01 add up to 0.09999999999999999.
  const Kept kept = run(settings, 0, 0.01, 100);
  EXPECT_EQ(kept.outputs, (std::vector<int>{1, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100}));
  EXPECT_EQ(kept.checkpoints, (std::vector<int>{30, 60, 90}));
}

TEST(OutputSchedule, checkpoints_by_steps_start_one_interval_late) {
  OutputSettings settings;
  settings.checkpoint.timestep_interval = 3;
  EXPECT_EQ(run(settings, 0, 0.1, 10).checkpoints, (std::vector<int>{4, 7, 10}));
  settings.checkpoint.timestep_interval = 1;
  EXPECT_EQ(run(settings, 0, 0.1, 4).checkpoints, (std::vector<int>{2, 3, 4}));
}

TEST(OutputSchedule, restarted_anywhere_keeps_the_same_steps) {
  OutputSettings settings;
  settings.interval = 0.7;
  settings.checkpoint.interval = 1.1;
  const OutputSchedule schedule(settings);
  ScheduleState state = schedule.state_at(0);
  double time = 0;
  for (int step = 1; step <= 200; ++step) {
    const double dt = 0.1 + 0.05 * std::sin(step);
    time += dt;
    state = schedule.advance(time, dt, state);
    EXPECT_EQ(schedule.state_at(time, dt), state) << step;
  }
}

TEST(OutputSchedule, knows_the_times_to_meet) {
  OutputSettings settings;
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(OutputSchedule(settings).next_output_time({}), infinity);
  EXPECT_EQ(OutputSchedule(settings).next_checkpoint_time({}), infinity);
  settings.interval = 0.1;
  settings.checkpoint.interval = 0.25;
  const OutputSchedule schedule(settings);
  const ScheduleState state = schedule.state_at(0.3, 0.01);
  EXPECT_EQ(schedule.next_output_time(state), 4 * 0.1);
  EXPECT_EQ(schedule.next_checkpoint_time(state), 0.5);
}

TEST(OutputSchedule, wall_clock_checkpoints) {
  OutputSettings settings;
  EXPECT_EQ(OutputSchedule(settings).first_wall_checkpoint(),
            std::numeric_limits<double>::infinity());
  settings.checkpoint.walltime_interval = 10;
  EXPECT_EQ(OutputSchedule(settings).first_wall_checkpoint(), 10);
  EXPECT_EQ(OutputSchedule(settings).next_wall_checkpoint(10), 20);
  settings.checkpoint.walltime_start = 3;
  const OutputSchedule schedule(settings);
  EXPECT_EQ(schedule.first_wall_checkpoint(), 3);
  EXPECT_EQ(schedule.next_wall_checkpoint(1), 3);
  EXPECT_EQ(schedule.next_wall_checkpoint(3), 13);
  EXPECT_EQ(schedule.next_wall_checkpoint(47), 53);
}

TEST(OutputSchedule, absurdly_short_intervals_do_not_overflow) {
  OutputSettings settings;
  settings.interval = 1e-300;
  EXPECT_EQ(run(settings, 0, 1.0, 3).outputs, (std::vector<int>{1, 2, 3}));
}

}  // namespace
}  // namespace sluice::output_schedule_test
