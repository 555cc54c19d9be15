// Schedules: what is refused, in which order and at which times nodes run, what a rejection undoes.
#include "framework/task/schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "framework/task/sweep_test_support.hpp"

namespace sluice::schedule_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Action good() {
  return [](const StepScope&, StepJournal&) { return Verdict::good; };
}
Node sweep(std::string name, int level, Action a = good()) {
  return {Sweep{std::move(name), level, std::move(a)}};
}

std::string refusal(const Schedule& s) {
  try {
    check(s);
  } catch (const std::logic_error& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Schedule, RefusesWhatCannotRunAndNamesIt) {
  EXPECT_EQ(refusal({sweep("a", 0), {LevelCycle{"fine", 1, 2, {sweep("b", 1)}}}}), "accepted");
  EXPECT_THAT(refusal({sweep("update", 1)}),
              HasSubstr("sweep 'update' of level 1 is used in a step of level 0"));
  EXPECT_THAT(refusal({sweep("empty", 0, {})}), HasSubstr("sweep 'empty' has no action"));
  EXPECT_THAT(refusal({{LevelCycle{"finest", 2, 2, {}}}}),
              HasSubstr("'finest' must go from level 0 to 1"));
  EXPECT_THAT(refusal({{LevelCycle{"fine", 1, 0, {}}}}), HasSubstr("no substeps"));
  EXPECT_THAT(refusal({{Loop{"pressure", {}, {}, 5}}}), HasSubstr("'pressure' would never end"));
  EXPECT_THAT(refusal({{GhostExchange{"state", 0, 0, good()}}}), HasSubstr("'state' has no width"));
  EXPECT_THAT(
      refusal({{LevelCycle{"fine", 1, 2, {{Retry{"again", {}, 1, 0.5, {}}}}}}}),
      HasSubstr("retry 'again' is not outermost: the unit of acceptance is the coarse step"));
  EXPECT_THAT(refusal({{Retry{"step", {}, 1, 1.5, {}}}}), HasSubstr("smaller"));
}

// Two cycles of two substeps: the W that subcycling makes, with times and shares.
TEST(Schedule, NestedCyclesRunInTimeOrderAndKnowTheCoarserStep) {
  std::vector<std::string> order;
  std::vector<double> starts, shares;
  const auto note = [&](const char* name) {
    return [&, name](const StepScope& s, StepJournal&) {
      order.push_back(name + std::to_string(s.level));
      if (s.level == 2) {
        starts.push_back(s.time);
        shares.push_back(s.start_share());
        EXPECT_EQ(s.dt, 0.25);
        EXPECT_EQ(s.coarser->level, 1);
        EXPECT_EQ(s.coarser->coarser->dt, 1);
        EXPECT_EQ(s.coarser->coarser->coarser, nullptr);
      }
      return Verdict::good;
    };
  };
  const Schedule finest = {sweep("a", 2, note("a"))};
  const Schedule fine = {
      sweep("a", 1, note("a")), {LevelCycle{"finest", 2, 2, finest}}, sweep("b", 1, note("b"))};
  const Schedule coarse = {
      sweep("a", 0, note("a")), {LevelCycle{"fine", 1, 2, fine}}, sweep("b", 0, note("b"))};
  check(coarse);
  StepJournal journal;
  EXPECT_EQ(run(coarse, {0, 10, 1}, journal), Verdict::good);
  EXPECT_THAT(order, ElementsAre("a0", "a1", "a2", "a2", "b1", "a1", "a2", "a2", "b1", "b0"));
  EXPECT_THAT(starts, ElementsAre(10, 10.25, 10.5, 10.75));
  EXPECT_THAT(shares, ElementsAre(0, 0.5, 0, 0.5));
  EXPECT_EQ(describe(coarse),
            "sweep a\n"
            "level 1 fine, 2 substeps\n"
            "  sweep a\n"
            "  level 2 finest, 2 substeps\n"
            "    sweep a\n"
            "  sweep b\n"
            "sweep b\n");
}

TEST(Schedule, ALoopEndsWhenConvergedAndRejectsWhenItDoesNot) {
  int passes = 0;
  const Schedule body = {sweep("relax", 0, [&](const StepScope&, StepJournal&) {
    ++passes;
    return Verdict::good;
  })};
  StepJournal journal;
  const auto until = [](int n) { return [n](const StepScope&, int pass) { return pass == n; }; };
  EXPECT_EQ(run({{Loop{"solve", body, until(3), 5}}}, {}, journal), Verdict::good);
  EXPECT_EQ(passes, 3);
  EXPECT_EQ(run({{Loop{"solve", body, until(9), 5}}}, {}, journal), Verdict::reject);
  EXPECT_EQ(passes, 3 + 5);
}

TEST(Schedule, ARejectedNodeEndsTheAttemptAtOnce) {
  int later = 0;
  const Schedule s = {
      sweep("bad", 0, [](const StepScope&, StepJournal&) { return Verdict::reject; }),
      sweep("later", 0, [&](const StepScope&, StepJournal&) {
        ++later;
        return Verdict::good;
      })};
  StepJournal journal;
  EXPECT_EQ(run(s, {}, journal), Verdict::reject);
  EXPECT_EQ(later, 0);
}

TEST(Schedule, OnlyTheAcceptedAttemptIsWrittenIntoTheBooks) {
  std::vector<double> tried, booked;
  std::vector<std::string> order;
  const Schedule body = {sweep("step", 0, [&](const StepScope& s, StepJournal& j) {
    tried.push_back(s.dt);
    j.at_acceptance([&, dt = s.dt] {
      booked.push_back(dt);
      order.push_back("booked");
    });
    return s.dt > 0.3 ? Verdict::reject : Verdict::good;
  })};
  const auto accepted = [&](const StepScope& s, int attempts) {
    EXPECT_EQ(s.dt, 0.25);
    EXPECT_EQ(attempts, 3);
    order.push_back("accepted");
  };
  StepJournal journal;
  EXPECT_EQ(run({{Retry{"step", body, 5, 0.5, accepted}}}, {0, 0, 1}, journal), Verdict::good);
  EXPECT_THAT(tried, ElementsAre(1, 0.5, 0.25));
  EXPECT_THAT(booked, ElementsAre(0.25));
  EXPECT_THAT(order, ElementsAre("accepted", "booked"));
  booked.clear();
  EXPECT_EQ(run({{Retry{"step", body, 1, 0.5, {}}}}, {0, 0, 1}, journal), Verdict::reject);
  EXPECT_TRUE(booked.empty());
  EXPECT_EQ(journal.size(), 0u);
}

}  // namespace
}  // namespace sluice::schedule_test
