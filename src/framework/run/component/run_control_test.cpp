// Signals set a flag, are agreed upon by all ranks, and end the process when repeated.
#include "framework/run/component/run_control.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>
#include <thread>

#include "framework/base/close_ranks_test_support.hpp"
#include "framework/base/communicator.hpp"

namespace sluice::run_control_test {
namespace {

RunControl::Answer ask_once(const RunControl& control) {
  Reduction step;
  const RunControl::Question question = control.ask(step);
  world().reduce(step);
  return control.read(step, question);
}

TEST(RunControl, without_a_signal_the_run_goes_on) {
  const RunControl control;
  EXPECT_FALSE(ask_once(control).terminate());
}

// Runs serially here and on three ranks by ctest: one rank's signal stops all.
TEST(RunControl, a_signal_to_the_last_rank_stops_all) {
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1, SIGUSR2}) {
    const RunControl control;
    if (world().rank() == world().size() - 1) std::raise(signal);
    const RunControl::Answer answer = ask_once(control);
    EXPECT_TRUE(answer.terminate());
    EXPECT_EQ(answer.signal, signal);
  }
}

TEST(RunControl, clock_is_the_slowest_of_all_ranks) {
  const RunControl control;
  if (world().is_root()) std::this_thread::sleep_for(std::chrono::milliseconds(30));
  const double wall = ask_once(control).wall_seconds;
  EXPECT_GE(wall, 0.03);
  if (world().size() == 1) {
    EXPECT_LE(wall, control.wall_seconds());
  }
}

TEST(RunControl, second_sigterm_ends_at_once) {
  if (world().size() > 1) GTEST_SKIP() << "forks; MPI does not like that";
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        const RunControl control;
        std::raise(SIGTERM);
        std::raise(SIGTERM);
        std::exit(0);
      },
      testing::KilledBySignal(SIGTERM), "");
}

TEST(RunControl, hands_the_former_handlers_back) {
  std::signal(SIGUSR1, SIG_IGN);
  { const RunControl control; }
  EXPECT_EQ(std::signal(SIGUSR1, SIG_DFL), SIG_IGN);
}

TEST(RunControl, only_one_at_a_time) {
  const RunControl control;
  EXPECT_THROW(RunControl(), std::logic_error);
}

TEST(RunControl, signals_have_names) {
  EXPECT_EQ(RunControl::signal_name(SIGTERM), "SIGTERM");
  EXPECT_EQ(RunControl::signal_name(SIGUSR1), "SIGUSR1");
  EXPECT_EQ(RunControl::signal_name(99), "signal 99");
}

}  // namespace
}  // namespace sluice::run_control_test
