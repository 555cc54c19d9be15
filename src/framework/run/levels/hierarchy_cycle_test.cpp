// The W-cycle: who is called when, ghosts in time, sums, step limits, labels of the last substep.
#include <cmath>

#include "framework/run/test_support/hierarchy_test_run.hpp"

namespace sluice::hierarchy_cycle_test {
namespace {

using namespace hierarchy_test;

class Cycle : public OnLevels {};

// Three levels over the middle of the domain.
Scene nested(std::vector<int> ratios, bool periodic = true) {
  Shape shape;
  shape.ratios = std::move(ratios);
  shape.periodic = periodic;
  Scene scene = scene_of(shape);
  add_boxes(scene, 1, {{4, 4, 0}, {12, 12, 1}}, {2, 1, 1});
  if (shape.ratios.size() > 1) {
    const int r = shape.ratios[0];
    add_boxes(scene, 2, {{6 * r, 6 * r, 0}, {9 * r, 10 * r, 1}}, {1, 2, 1});
  }
  return scene;
}

// Every level at the corner of the domain and up to its low faces.
Scene in_the_corner(std::vector<int> ratios) {
  Shape shape;
  shape.ratios = std::move(ratios);
  shape.periodic = false;
  Scene scene = scene_of(shape);
  add_boxes(scene, 1, {{0, 0, 0}, {8, 8, 1}}, {2, 2, 1});
  if (shape.ratios.size() > 1) {
    const int r = shape.ratios[0];
    add_boxes(scene, 2, {{0, 0, 0}, {4 * r, 5 * r, 1}});
  }
  return scene;
}

TEST_F(Cycle, SubcyclesEveryLevelInsideTheNextCoarser) {
  Wishes w;
  LevelRun run(nested({2, 4}), w);
  run.time = 8;
  ASSERT_TRUE(run.attempt(1));
  std::vector<Call> expected{{0, 8, 1, false}};
  for (int m = 0; m < 2; ++m) {
    expected.push_back({1, 8 + m * 0.5, 0.5, false});
    for (int n = 0; n < 4; ++n) expected.push_back({2, 8 + m * 0.5 + n * 0.125, 0.125, false});
  }
  EXPECT_EQ(run.mock.sweeps, expected);
  EXPECT_EQ(run.hierarchy.costs()[2].updates, 8 * run.hierarchy.level(2).level().cell_count());
}

TEST_F(Cycle, InLockstepAllLevelsTakeTheSameStep) {
  Wishes w;
  Scene scene = nested({2, 4});
  scene.refinement.lock_step = true;
  LevelRun run(scene, w);
  ASSERT_TRUE(run.attempt(0.25));
  EXPECT_EQ(run.mock.sweeps,
            (std::vector<Call>{{0, 0, 0.25, false}, {1, 0, 0.25, false}, {2, 0, 0.25, false}}));
}

TEST_F(Cycle, TellsItsShape) {
  Wishes w;
  EXPECT_EQ(LevelRun(nested({2}), w).hierarchy.coarse_step().describe(),
            "ghost exchange of old state, width 2\n"
            "sweep step\n"
            "level 1 finer level, 2 substeps\n"
            "  ghost exchange of old state, width 2\n"
            "  sweep step\n"
            "sweep matching of fluxes and restriction\n");
}

// Data linear in space and time are exact in every cell at any time only if all ghost cells of all
// levels are: at interfaces between the two times of the coarser level, outside at their own.
void expect_linear_data_exact(const Scene& scene, double dt, int direction) {
  const Vec3 slope{0.5, 2, 0};
  Wishes w;
  w.velocity_a[direction] = 0.5;
  w.source = 0.5 * slope[direction] - 2;
  w.outside = [=](Vec3 x, double t) {
    return Values{64 + slope.x * x.x + slope.y * x.y - 2 * t, 3 + x.x + x.y, 0};
  };
  w.start = [&](Vec3 x) { return w.outside(x, 0); };
  LevelRun run(scene, w);
  for (int n = 0; n < 6; ++n) {
    const double before = run.totals()[0];
    ASSERT_TRUE(run.attempt(dt));
    EXPECT_LT(run.result.sums[0], 0);
    // Outflow and inflow differ by the slope along the flow.
    const double across = 0.5 * slope[direction] * 16 * 16 * dt;
    EXPECT_EQ(run.totals()[0] - before, run.result.sums[0] - across);
  }
  for (const CellState& s : run.states()) {
    const Vec3 x = run.scene.grid.levels[s.level].centre(s.cell);
    EXPECT_EQ(s.values, w.outside(x, run.time))
        << "level " << s.level << " cell " << s.cell.x << ' ' << s.cell.y;
  }
}

void expect_linear_data_exact(const Scene& scene, double dt) {
  for (const int direction : {0, 1}) expect_linear_data_exact(scene, dt, direction);
}

TEST_F(Cycle, LinearDataStayExactThroughInterfacesInsideTheDomain) {
  expect_linear_data_exact(nested({2}, false), 0.25);
  expect_linear_data_exact(nested({4}, false), 0.25);
  expect_linear_data_exact(nested({2, 4}, false), 0.25);
  expect_linear_data_exact(nested({4, 2}, false), 0.25);
}

TEST_F(Cycle, LinearDataStayExactWhereInterfacesMeetTheBoundary) {
  expect_linear_data_exact(in_the_corner({2}), 0.25);
  expect_linear_data_exact(in_the_corner({2, 4}), 0.25);
  Scene lockstep = in_the_corner({2, 4});
  lockstep.refinement.lock_step = true;
  expect_linear_data_exact(lockstep, 0.0625);
}

TEST_F(Cycle, BoundariesAreAskedForAtTheTimeOfTheState) {
  Wishes w;
  LevelRun run(in_the_corner({2, 2}), w);
  ASSERT_TRUE(run.attempt(1));
  for (const Call& c : run.mock.boundary_fills) {
    const double substep = c.level == 0 ? 1 : c.level == 1 ? 0.5 : 0.25;
    EXPECT_EQ(c.time, substep * std::round(c.time / substep)) << c.level;
  }
}

TEST_F(Cycle, TheSourceOfSubstepsIsCountedOnceEverywhere) {
  Wishes w;
  w.source = 1;
  w.velocity_a = {0.25, 0.125, 0};
  LevelRun run(nested({2, 4}), w);
  ASSERT_TRUE(run.attempt(0.5));
  EXPECT_EQ(run.result.sums[0], 0.5 * 16 * 16);
  for (const CellState& s : run.states()) EXPECT_EQ(s.values[0], 1.5);
}

TEST_F(Cycle, TheStepIsTheLeastOverLevelsTimesTheirSubsteps) {
  Wishes w;
  std::array<double, 3> rates{1, 1, 1};
  w.cfl = 1;
  w.rate = [&](int l) { return rates[l]; };
  for (const bool lock_step : {false, true}) {
    Scene scene = nested({2, 4});
    scene.refinement.lock_step = lock_step;
    const double substeps[] = {1, lock_step ? 1.0 : 2.0, lock_step ? 1.0 : 8.0};
    for (std::size_t tightest = 0; tightest < 3; ++tightest) {
      rates = {1, 1, 1};
      LevelRun run(scene, w);
      rates[tightest] = 64;
      ASSERT_TRUE(run.attempt(0.125));
      const StepLimit limit = run.hierarchy.rates().limit();
      EXPECT_EQ(limit.dt, substeps[tightest] / 64);
      EXPECT_EQ(limit.reason, "mock rate on level " + std::to_string(tightest));
    }
  }
}

// The others would be measured in vain.
TEST_F(Cycle, RatesAreMeasuredInTheLastSubstepOnly) {
  Wishes w;
  std::array<int, 3> asked{};
  w.rate = [&](int l) {
    ++asked[l];
    return 1.0;
  };
  LevelRun run(nested({2, 4}), w);
  asked = {};
  ASSERT_TRUE(run.attempt(0.125));
  const std::array<int, 3> once = asked;
  for (int l = 0; l < 3; ++l) {  // once a row
    int rows = 0;
    for (const GridBox& b : run.hierarchy.level(l).level().boxes) rows += b.cells.size().y;
    EXPECT_EQ(once[l], rows) << l;
  }
}

TEST_F(Cycle, LabelsOfAStepAreThoseOfTheLastSubstep) {
  Wishes w;
  const Label stamp = mock_labels().stamp;
  LevelRun run(nested({2, 4}), w);
  ASSERT_TRUE(run.attempt(1, {stamp}));
  const double starts[] = {0, 0.5, 0.875};
  for (int l = 0; l < 3; ++l) {
    const Warehouse& outputs = run.hierarchy.level(l).outputs();
    const int slot = outputs.find(stamp, 0);
    ASSERT_GE(slot, 0);
    for (int b = 0; b < static_cast<int>(outputs.local_boxes().size()); ++b)
      for_each_cell(outputs.local_boxes()[b].cells,
                    [&](IntVec3 c) { EXPECT_EQ(outputs.view(slot, 0, b)(c), starts[l]); });
  }
}

TEST_F(Cycle, WantedLabelsAndBoxesChangeNoBit) {
  Wishes w;
  w.velocity_a = {0.25, 0.125, 0};
  w.velocity_b = {0.125, 0.25, 0};
  w.diffusion = 0.0625;
  w.start = [](Vec3 x) {
    return Values{2 + std::sin(x.x), 1 + std::cos(x.y), 1 + std::sin(x.x + x.y)};
  };
  Shape shape;
  shape.boxes = {3, 2, 1};
  Scene cut = scene_of(shape), whole = nested({2});
  add_boxes(cut, 1, {{4, 4, 0}, {12, 12, 1}}, {3, 4, 1});
  LevelRun plain(whole, w), wanting(whole, w), many(cut, w, {1, true, 0, {3, 2, 1}});
  for (int n = 0; n < 5; ++n) {
    ASSERT_TRUE(plain.attempt(0.5));
    ASSERT_TRUE(wanting.attempt(0.5, {mock_labels().stamp}));
    ASSERT_TRUE(many.attempt(0.5));
  }
  EXPECT_TRUE(same_bits(wanting.states(), plain.states()));
  EXPECT_TRUE(same_bits(many.states(), plain.states()));
}

TEST_F(Cycle, GhostLayersOfAllSlotsAreAsWideAsTheWidest) {
  Wishes w;
  LevelRun run(nested({2}), w);
  for (int l = 0; l < 2; ++l)
    for (const int slot : run.hierarchy.level(l).state_slots())
      EXPECT_EQ(run.hierarchy.level(l).state().info(slot).ghosts, 2);
}

}  // namespace
}  // namespace sluice::hierarchy_cycle_test
