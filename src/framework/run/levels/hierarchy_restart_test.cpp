// Runs on levels that move: restarts, and (see CMakeLists.txt) boxes that change ranks.
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>

#include "framework/archive/archive.hpp"
#include "framework/archive/compare/compare.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/run/simulation/simulation.hpp"
#include "framework/run/test_support/hierarchy_test_run.hpp"

namespace sluice::hierarchy_restart_test {
namespace {

using namespace hierarchy_test;
namespace fs = std::filesystem;

// A spot that moves and, for a while, is not there.
Wishes passing_spot() {
  Wishes w;
  w.velocity_a = {0.25, 0.125, 0};
  w.velocity_b = {0.125, 0.25, 0};
  w.diffusion = 0.015625;
  w.cfl = 0.1875;
  w.start = [](Vec3 x) {
    return Values{2 + std::sin(x.x), 1 + std::cos(x.y), 1 + std::sin(x.x + 2 * x.y)};
  };
  w.flagged = [](Vec3 x, double t) {
    const double r = std::hypot(x.x - 4 - t, x.y - 8);
    return r < 1.5 && std::fmod(t, 4) < 3;
  };
  return w;
}

Scene adaptive_scene(IntVec3 boxes = {1, 1, 1}) {
  Shape shape;
  shape.ratios = {2, 4};
  shape.boxes = boxes;
  Scene scene = scene_of(shape);
  make_adaptive(scene, {4, 4, 1});
  scene.time.max_time = 6;
  scene.time.end_at_max_time_exactly = true;
  return scene;
}

class RestartOnLevels : public testing::Test {
 protected:
  RunReport run(const char* sub, const Scene& scene, int steps, const fs::path& restart = {}) {
    RunOptions o;
    o.parent = folder_ / sub;
    fs::create_directories(o.parent);
    o.progress = ProgressMode::none;
    o.deck_xml = "<Uintah_specification/>";
    o.limits.max_steps = steps;
    o.restart = restart;
    return Simulation(scene, HierarchyMock(scene, wishes_), world(), o).run();
  }
  static Scene saving(Scene scene) {
    scene.output.filebase = "levels.uda";
    scene.output.checkpoint.timestep_interval = 1;
    scene.output.checkpoint.cycle = 0;
    return scene;
  }
  static ArchiveStep last_checkpoint(const RunReport& r) {
    const Archive archive = Archive::open(r.archive.value());
    return archive.read_checkpoint(archive.select_checkpoint());
  }
  const Wishes wishes_ = passing_spot();
  TemporaryFolder folder_;
};

// All stored values of two checkpoints, and what else they keep of levels.
void expect_same(const ArchiveStep& x, const ArchiveStep& y) {
  EXPECT_EQ(x.info().time, y.info().time);
  EXPECT_EQ(x.info().state.at("regrid"), y.info().state.at("regrid"));
  ASSERT_EQ(x.grid().levels.size(), y.grid().levels.size());
  ASSERT_EQ(x.fields().size(), y.fields().size());
  ASSERT_EQ(x.fields().size(), x.grid().levels.size() * quantities);
  for (const FieldInfo& f : x.fields()) {
    const FieldInfo* other = y.find(f.name, f.material, f.level);
    ASSERT_NE(other, nullptr);
    const DenseField a = x.read(f), b = y.read(*other);
    EXPECT_EQ(a.cells, b.cells);
    EXPECT_EQ(a.present, b.present);
    EXPECT_EQ(a.components, b.components) << f.name << " on level " << f.level;
  }
}

TEST_F(RestartOnLevels, BetweenAnyTwoStepsGivesTheSameBits) {
  const Scene scene = saving(adaptive_scene()), other = saving(adaptive_scene({4, 2, 1}));
  const RunReport whole = run("whole", scene, 0);
  ASSERT_EQ(whole.status, RunStatus::done);
  ASSERT_GT(whole.steps, 10);
  EXPECT_GT(whole.regrids, 5);
  for (int steps = 2; steps < whole.steps; steps += 3) {
    const std::string name = std::to_string(steps);
    const RunReport half = run(("half" + name).c_str(), scene, steps);
    ASSERT_EQ(half.status, RunStatus::max_steps);
    const RunReport rest =
        run(("rest" + name).c_str(), steps % 2 == 0 ? scene : other, 0, half.archive.value());
    EXPECT_EQ(rest.status, RunStatus::done);
    EXPECT_EQ(rest.last_step, whole.last_step);
    EXPECT_EQ(rest.conservation_json, whole.conservation_json) << steps;
    expect_same(last_checkpoint(whole), last_checkpoint(rest));
  }
}

TEST_F(RestartOnLevels, KeepsMassesAcrossTheRestart) {
  const Scene scene = saving(adaptive_scene());
  const RunReport half = run("half", scene, 7);
  const RunReport rest = run("rest", scene, 0, half.archive.value());
  EXPECT_LE(rest.worst_drift, 1e-14);
}

// Substeps of the deck as it is now, of the finest level's rate: 8 in a coarse step, or 1.
TEST_F(RestartOnLevels, StepsInLockStepWhereTheDeckSaysSoNow) {
  Scene scene = saving(adaptive_scene());
  const RunReport half = run("half", scene, 7);
  const double start = last_checkpoint(half).info().time;
  const double subcycled = run("rest", scene, 8, half.archive.value()).time - start;
  scene.refinement.lock_step = true;
  const double locked = run("locked", scene, 8, half.archive.value()).time - start;
  EXPECT_EQ(half.last_step, 7);
  EXPECT_EQ(subcycled, 8 * locked);
}

// A run by hand, with the work of all cells in one corner of the domain.
class HierarchyOnRanks : public OnLevels {};

Wishes uneven_labour() {
  Wishes w = passing_spot();
  w.flagged = [](Vec3 x, double t) { return std::hypot(x.x - 4 - t, x.y - 8) < 2.5; };
  w.labour = [](IntVec3 cell) {
    if (cell.y >= 5) return;
    const auto until = std::chrono::steady_clock::now() + std::chrono::microseconds(30);
    while (std::chrono::steady_clock::now() < until) {
    }
  };
  return w;
}

TEST_F(HierarchyOnRanks, BoxesThatChangeRanksChangeNoBit) {
  const Wishes w = uneven_labour();
  Scene scene = adaptive_scene({4, 4, 1});
  LevelRun still(scene, w), moving(scene, w);
  bool moved = false;
  for (int n = 0; n < 6; ++n) {
    ASSERT_TRUE(still.attempt(0.5));
    ASSERT_TRUE(moving.attempt(0.5));
    const int layouts = moving.hierarchy.levels().layouts();
    const bool now = moving.hierarchy.balance(50);  // asked for as if it were due
    EXPECT_EQ(moving.hierarchy.levels().layouts() != layouts, now);
    moved = moved || now;
    EXPECT_TRUE(same_bits(still.states(), moving.states())) << n;
    // A regrid measures anew.
    EXPECT_EQ(still.hierarchy.regrid(n + 1), moving.hierarchy.regrid(n + 1));
    EXPECT_TRUE(same_bits(still.states(), moving.states())) << n;
  }
  EXPECT_EQ(moved, world().size() > 1);
  EXPECT_EQ(moving.hierarchy.balancing().count() > 0, moved);
  EXPECT_EQ(still.totals(), moving.totals());
}

TEST_F(HierarchyOnRanks, ARejectedStepAfterAMoveIsUndoneOnAllRanks) {
  Wishes w = uneven_labour();
  bool refuse = false;
  w.inadmissible = [&](const Sweeping& s) {
    return refuse && s.level == 2 && s.time > 1 && s.cell.x % 7 == 0;
  };
  LevelRun run(adaptive_scene({4, 4, 1}), w);
  run.advance(2, 0.5);
  ASSERT_TRUE(run.attempt(0.5));
  EXPECT_EQ(run.hierarchy.balance(50), world().size() > 1);
  const States before = run.states();
  refuse = true;
  EXPECT_FALSE(run.attempt(0.5));
  EXPECT_EQ(run.result.first_fault.level, 2);
  EXPECT_EQ(run.result.first_fault.cell.x % 7, 0);
  EXPECT_TRUE(same_bits(run.states(), before));
}

TEST_F(HierarchyOnRanks, MassesAreKept) {
  const Wishes w = passing_spot();
  LevelRun run(adaptive_scene({4, 4, 1}), w);
  const Values before = run.totals();
  run.advance(20, 0.5);
  EXPECT_GT(run.hierarchy.regridding().count(), 3);
  const Values after = run.totals();
  for (std::size_t q = 0; q < quantities; ++q)
    EXPECT_NEAR(after[q], before[q], 1e-14 * before[q]) << q;
}

}  // namespace
}  // namespace sluice::hierarchy_restart_test
