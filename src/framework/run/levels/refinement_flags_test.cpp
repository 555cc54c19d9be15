// Criteria of refinement: rows of diagnostics, errors against ranges, regions, seeds of a mock that
// stands for particles and for interfaces between materials.
#include "framework/run/levels/refinement_flags.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "framework/geometry/box.hpp"
#include "framework/run/test_support/mock_component.hpp"

namespace sluice::refinement_flags_test {
namespace {

using namespace run_test;

const Label flag_label =
    declare_label({"mock_flag", ValueType::integer, Centring::cell, "1", "q above 1.5"});
const Label estimate =
    declare_label({"estimate.mock_square", ValueType::real, Centring::cell, "1", "q"});

// Flags cells with q above 1.5; says that the error of q^2 is q.
class Critic final : public MockComponent {
 public:
  using MockComponent::MockComponent;
  std::vector<ErrorEstimate> errors;
  std::function<std::vector<FlagSeeds>(const Warehouse&)> seeds;

  Label refine_flag() const override { return flag_label; }
  std::vector<ErrorEstimate> error_estimates() const override { return errors; }
  std::vector<FlagSeeds> flag_seeds(const Warehouse& state) const override {
    return seeds ? seeds(state) : std::vector<FlagSeeds>();
  }
  void declare_diagnostics(TaskList& list, int level) const override {
    MockComponent::declare_diagnostics(list, level);
    const VariableId q = list.old_state(mock_labels().q, 0, 1);
    const auto declare = [&](Label label, auto f) {
      TaskBuilder task = list.task(label.name(), 1);
      const In in = task.read(q);
      const Out out = task.write(list.output(label, 0));
      task.kernel([=](const Row& row) {
        for (int i = 0; i < row.count(); ++i) row(out)[i] = f(row(in)[i]);
      });
    };
    declare(flag_label, [](double value) { return value > 1.5 ? 1.0 : 0.0; });
    declare(estimate, [](double value) { return value; });
  }
};

// Levels of 150 x 3 and 300 x 6 cells, in three boxes each; rows of 150 bits need three words.
class FlagTest : public testing::Test {
 protected:
  FlagTest() {
    for (int l = 0; l < 2; ++l) {
      Level level;
      level.index = l;
      level.spacing = {1.0 / (l + 1), 1.0 / (l + 1), 1};
      level.domain = {{0, 0, 0}, {150 * (l + 1), 3 * (l + 1), 1}};
      level.ratio = l == 0 ? IntVec3{1, 1, 1} : IntVec3{2, 2, 1};
      level.active = {true, true, false};
      for (const IndexBox& b : split(level.domain, {3, 1, 1}))
        level.boxes.push_back({b, 0, static_cast<int>(level.boxes.size())});
      assign_owners(level.boxes, world().size());
      levels_.push_back(level);
    }
    settings_.adaptive = true;
    component_ = std::make_unique<Critic>(levels_[0]);
  }
  void start() {
    for (const Level& level : levels_) {
      solvers_.push_back(
          std::make_unique<LevelSolver>(*component_, level, world(), SolverOptions{}));
      component_->state().initialise(solvers_.back()->state());
    }
  }
  FlagField flags() {
    start();
    RefinementFlags flags(settings_, *component_, levels_);
    std::vector<LevelSolver*> read;
    for (int l = 0; l < flags.levels_read(2, 1); ++l) read.push_back(solvers_[l].get());
    const std::vector<FlagField> all = flags.of(read, 1, 0, world());
    EXPECT_EQ(all.size(), 1u);
    return all.front();
  }
  template <class F>
  void expect_flags(const FlagField& flags, F&& wanted) {
    for_each_cell(levels_[0].domain,
                  [&](IntVec3 c) { EXPECT_EQ(flags.get(c), wanted(c)) << c.x << ' ' << c.y; });
  }
  static double q(int x) { return MockComponent::start(x); }

  std::vector<Level> levels_;
  RefinementSettings settings_;
  std::unique_ptr<Critic> component_;
  std::vector<std::unique_ptr<LevelSolver>> solvers_;
};

TEST_F(FlagTest, RowsOfDiagnosticsBecomeRowsOfBits) {
  expect_flags(flags(), [](IntVec3 c) { return q(c.x) > 1.5; });
}

TEST_F(FlagTest, ErrorsAreMeasuredAgainstTheRangeOverAllLevels) {
  // q^2 lies between 1 and 1.75^2 on the coarse level; one fine cell makes the range 20.
  component_->errors = {{mock_labels().square, estimate, 0, 1.0 / 16}};
  start();
  LevelSolver& fine = *solvers_[1];
  const auto& boxes = fine.state().local_boxes();
  for (std::size_t b = 0; b < boxes.size(); ++b)
    if (boxes[b].cells.contains(IntVec3{299, 5, 0}))
      fine.state().view(0, 0, static_cast<int>(b))(299, 5, 0) = std::sqrt(21.0);
  RefinementFlags flags(settings_, *component_, levels_);
  EXPECT_EQ(flags.levels_read(2, 1), 2);
  const auto all = flags.of({solvers_[0].get(), solvers_[1].get()}, 1, 0, world());
  expect_flags(all.front(), [](IntVec3 c) { return q(c.x) > 20.0 / 16; });
  const auto coarse = flags.of({solvers_[0].get()}, 1, 0, world());
  const double range = 1.75 * 1.75 - 1;
  expect_flags(coarse.front(), [&](IntVec3 c) { return q(c.x) > range / 16; });
}

TEST_F(FlagTest, WithoutErrorCriteriaOnlyFlaggingLevelsAreRead) {
  EXPECT_EQ(RefinementFlags(settings_, *component_, levels_).levels_read(2, 1), 1);
  component_->errors = {{mock_labels().square, estimate, 0, 0.5}};
  settings_.adaptive = false;
  EXPECT_EQ(RefinementFlags(settings_, *component_, levels_).levels_read(2, 1), 1);
}

// Particles: the cells that hold one ask for the finer level, and no others around them.
TEST_F(FlagTest, CellsThatHoldParticlesAreFlagged) {
  const std::vector<Vec3> particles = {{0.5, 0.5, 0}, {64.25, 1.75, 0}, {149.75, 2.5, 0}};
  component_->seeds = [&](const Warehouse& state) {
    FlagSeeds seeds;
    for (const GridBox& box : state.local_boxes())
      for (const Vec3& p : particles) {
        const IntVec3 cell{static_cast<int>(p.x), static_cast<int>(p.y), 0};
        if (box.cells.contains(cell)) seeds.cells.push_back(cell);
      }
    return std::vector<FlagSeeds>{seeds};
  };
  expect_flags(flags(), [&](IntVec3 c) {
    for (const Vec3& p : particles)
      if (static_cast<int>(p.x) == c.x && static_cast<int>(p.y) == c.y) return true;
    return q(c.x) > 1.5;
  });
}

// An interface between materials: cells around it, as far as the criterion's distance, across
// boxes (and ranks, see CMakeLists.txt).
TEST_F(FlagTest, CellsWithinADistanceOfAnInterfaceAreFlagged) {
  constexpr int interface = 50;  // the first cell of the second box
  component_->seeds = [&](const Warehouse& state) {
    FlagSeeds seeds;
    seeds.distance = 2.5;
    for (const GridBox& box : state.local_boxes())
      for_each_cell(box.cells, [&](IntVec3 c) {
        if (c.x == interface) seeds.cells.push_back(c);
      });
    return std::vector<FlagSeeds>{seeds};
  };
  expect_flags(flags(), [&](IntVec3 c) { return std::abs(c.x - interface) <= 3 || q(c.x) > 1.5; });
}

TEST_F(FlagTest, RegionsAreFlaggedUpToTheirLevelAndLookedAtOnce) {
  const PiecePtr piece = std::make_shared<BoxPiece>(Vec3{60, 1, 0}, Vec3{70, 2, 1});
  settings_.regions.push_back({"strip", piece, 1});
  expect_flags(flags(), [&](IntVec3 c) {
    return piece->inside({c.x + .5, c.y + .5, .5}) || q(c.x) > 1.5;
  });

  RegionFlags region(settings_.regions, levels_[0]);
  FlagField first(levels_[0].domain), again = first, apart = first;
  region.add({{0, 0, 0}, {65, 3, 1}}, first);
  EXPECT_EQ(first.count(), 5);
  const auto looked = region.looked_at();
  EXPECT_GE(looked, 5);
  EXPECT_LT(looked, 30);  // cells far from the region are not asked
  region.add({{0, 0, 0}, {65, 3, 1}}, again);
  EXPECT_EQ(region.looked_at(), looked);
  EXPECT_EQ(again, first);
  region.add({{68, 0, 0}, {150, 3, 1}}, apart);  // what other boxes held is not theirs
  EXPECT_EQ(apart.count(), 2);
  FlagField fine(levels_[1].domain);
  RegionFlags(settings_.regions, levels_[1]).add(levels_[1].domain, fine);
  EXPECT_FALSE(fine.any());  // level 1 is fine enough
}

}  // namespace
}  // namespace sluice::refinement_flags_test
