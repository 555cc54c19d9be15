// Substeps that are rejected or redone on any level: what is undone, redone, told.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "framework/base/temporary_folder.hpp"
#include "framework/run/simulation/simulation.hpp"
#include "framework/run/test_support/hierarchy_test_run.hpp"

namespace sluice::hierarchy_rejection_test {
namespace {

using namespace hierarchy_test;
using testing::AllOf;
using testing::HasSubstr;

constexpr double dt = 0.5;

// Three levels in a flow that is smooth nowhere.
Scene three_levels() {
  Shape shape;
  shape.ratios = {2, 4};
  Scene scene = scene_of(shape);
  add_boxes(scene, 1, {{4, 4, 0}, {12, 12, 1}}, {2, 1, 1});
  add_boxes(scene, 2, {{12, 12, 0}, {18, 20, 1}}, {1, 2, 1});
  return scene;
}

Wishes rough_flow() {
  Wishes w;
  w.velocity_a = {0.25, 0.125, 0};
  w.velocity_b = {0.125, 0.25, 0};
  w.diffusion = 0.015625;
  w.start = [](Vec3 x) {
    return Values{2 + std::cos(0.7 * x.x), 1 + std::cos(2 * x.y), 1 + std::sin(x.x + 2 * x.y)};
  };
  return w;
}

// What one substep was not to be: the n-th of its level, at a time in the coarse step.
struct Planted {
  int level = 0;
  double time = 0;
};

// A cell of a level, under none finer on level 0 and 1.
IntVec3 cell_on(int level) {
  return level == 0 ? IntVec3{2, 3, 0} : level == 1 ? IntVec3{10, 9, 0} : IntVec3{50, 49, 0};
}

class Rejection : public OnLevels {
 protected:
  // Every substep of a coarse step that starts at `start`.
  static std::vector<Planted> substeps(double start) {
    std::vector<Planted> all{{0, start}};
    for (int n = 0; n < 2; ++n) all.push_back({1, start + n * dt / 2});
    for (int n = 0; n < 8; ++n) all.push_back({2, start + n * dt / 8});
    return all;
  }
};

TEST_F(Rejection, OfAnySubstepPutsAllLevelsBackAndTheCoarseStepIsRedone) {
  for (const Planted& p : substeps(dt)) {
    Wishes w = rough_flow(), good = rough_flow();
    bool planted = false;
    w.inadmissible = [&](const Sweeping& s) {
      return planted && s.level == p.level && s.time == p.time && s.cell == cell_on(p.level) &&
             s.dt == dt / (p.level == 0   ? 1
                           : p.level == 1 ? 2
                                          : 8);
    };
    Scene scene = three_levels();
    LevelRun run(scene, w), direct(scene, good);
    for (LevelRun* r : {&run, &direct}) ASSERT_TRUE(r->attempt(dt));
    const States before = run.states();
    planted = true;
    EXPECT_FALSE(run.attempt(dt));
    EXPECT_TRUE(same_bits(run.states(), before)) << p.level << ' ' << p.time;
    EXPECT_EQ(run.result.faults, 1);
    EXPECT_EQ(run.result.first_fault.level, p.level);
    EXPECT_EQ(run.result.first_fault.cell, cell_on(p.level));
    // Twice: the levels are whole again, and what follows is as if nothing had been tried.
    EXPECT_FALSE(run.attempt(dt));
    EXPECT_TRUE(same_bits(run.states(), before));
    ASSERT_TRUE(run.attempt(dt / 2));
    ASSERT_TRUE(direct.attempt(dt / 2));
    EXPECT_TRUE(same_bits(run.states(), direct.states())) << p.level << ' ' << p.time;
    EXPECT_EQ(run.result.sums, direct.result.sums);
    planted = false;
    for (LevelRun* r : {&run, &direct}) ASSERT_TRUE(r->attempt(dt));
    EXPECT_TRUE(same_bits(run.states(), direct.states()));
  }
}

TEST_F(Rejection, IsFirstARedoOfThatSubstepAloneWithMaskedSlopes) {
  for (const Planted& p : substeps(0)) {
    Wishes w = rough_flow(), good = rough_flow();
    w.inadmissible = [&](const Sweeping& s) {
      return !s.masked && s.level == p.level && s.time == p.time && s.cell == cell_on(p.level);
    };
    Scene scene = three_levels();
    LevelRun run(scene, w), direct(scene, good);
    ASSERT_TRUE(run.attempt(dt));
    ASSERT_TRUE(direct.attempt(dt));
    // The same calls, but for one more: the masked one.
    std::vector<Call> calls = direct.mock.sweeps;
    const auto at = std::find_if(calls.begin(), calls.end(), [&](const Call& c) {
      return c.level == p.level && c.time == p.time;
    });
    ASSERT_NE(at, calls.end());
    Call redone = *at;
    redone.masked = true;
    calls.insert(at + 1, redone);
    EXPECT_EQ(run.mock.sweeps, calls);
    ASSERT_EQ(run.ledger.records().size(), 1u);
    const auto& [name, record] = *run.ledger.records().begin();
    EXPECT_EQ(name, "step redone with first-order faces");
    EXPECT_EQ(record.count, 1);
    EXPECT_EQ(record.first.level, p.level);
    EXPECT_EQ(record.first.cell, cell_on(p.level));
    // One slope less: another solution, of the same mass.
    EXPECT_FALSE(same_bits(run.states(), direct.states()));
    EXPECT_NEAR(run.totals()[0], direct.totals()[0], 1e-14 * direct.totals()[0]);
  }
}

TEST_F(Rejection, MasksOfASubstepAreForgottenInTheNext) {
  Wishes w = rough_flow();
  w.inadmissible = [&](const Sweeping& s) {
    return !s.masked && s.level == 1 && s.cell == IntVec3{9, 9, 0};
  };
  LevelRun run(three_levels(), w);
  ASSERT_TRUE(run.attempt(dt));
  ASSERT_TRUE(run.attempt(dt));
  EXPECT_EQ(run.ledger.records().begin()->second.count, 4);  // two substeps of two coarse steps
}

TEST_F(Rejection, IsForGoodWhereAStateHoldsNoNumber) {
  for (int l = 0; l < 3; ++l) {
    Wishes w = rough_flow();
    LevelRun run(three_levels(), w);
    Warehouse& state = run.hierarchy.level(l).state();
    const int slot = state.find(mock_labels().a, 0);
    const IntVec3 cell = cell_on(l);
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      if (state.local_boxes()[b].cells.contains(cell))
        state.view(slot, 0, b)(cell) = std::numeric_limits<double>::quiet_NaN();
    run.hierarchy.level(l).mark_modified();
    EXPECT_FALSE(run.attempt(dt));
    ASSERT_TRUE(run.result.unsound) << l;
    EXPECT_EQ(run.result.unsound->where.level, l);
    EXPECT_EQ(run.result.unsound->where.cell, cell);
    EXPECT_EQ(run.result.unsound->label, mock_labels().a);
  }
}

// Runs have their own clock.
class RejectionInARun : public testing::Test {
 protected:
  static RunReport run(const Wishes& w) {
    Scene scene = three_levels();
    scene.time.max_time = 1;
    scene.time.end_at_max_time_exactly = true;
    RunOptions o;
    o.output = false;
    o.progress = ProgressMode::none;
    return Simulation(scene, HierarchyMock(scene, w), world(), o).run();
  }
};

TEST_F(RejectionInARun, FailureNamesLevelAndCell) {
  Wishes w = rough_flow();
  w.inadmissible = [](const Sweeping& s) {
    return s.time >= 0.25 && s.level == 2 && s.cell == IntVec3{49, 51, 0};
  };
  const RunReport r = run(w);
  EXPECT_EQ(r.status, RunStatus::failed);
  EXPECT_THAT(r.message, AllOf(HasSubstr("cell [49, 51, 0] of level 2"), HasSubstr("material 0"),
                               HasSubstr("mock value (none is allowed)")));
  EXPECT_LE(r.worst_drift, 1e-14);
}

TEST_F(RejectionInARun, HalvesTheCoarseStepUntilTheFinestLevelBearsIt) {
  Wishes w = rough_flow();
  w.inadmissible = [](const Sweeping& s) { return s.level == 2 && s.dt > 0.016; };
  w.rate = [](int l) { return l == 0 ? 0.5 : l == 1 ? 1.0 : 4.0; };  // 0.5 on every level
  const RunReport r = run(w);
  EXPECT_EQ(r.status, RunStatus::done);
  EXPECT_EQ(r.time, 1);
  EXPECT_GE(r.steps, 8);  // of 0.125 at most: 0.5 and 0.25 were tried
  EXPECT_LE(r.worst_drift, 1e-14);
  EXPECT_THAT(r.events_json, HasSubstr("step redone with a smaller one"));
}

}  // namespace
}  // namespace sluice::hierarchy_rejection_test
