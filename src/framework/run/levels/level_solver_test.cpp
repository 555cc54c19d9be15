// One level: variants of the graph, attempts, masks, acceptance, diagnostics.
#include "framework/run/levels/level_solver.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "framework/run/test_support/mock_component.hpp"

namespace sluice::level_solver_test {
namespace {

using namespace run_test;

// One at a time in a process: shared by all that a test makes.
class LevelSolverTest : public testing::Test {
 protected:
  LevelSolverTest() { control = std::make_unique<RunControl>(); }
  ~LevelSolverTest() override { control.reset(); }

 public:
  static inline std::unique_ptr<RunControl> control;
};

struct Tube {
  Scene scene;
  MockComponent component;
  LevelSolver solver;

  explicit Tube(int boxes = 1, const SolverOptions& o = {}, double most = 1e300)
      : scene(dealt_out(tube(boxes))),
        component(with_most(scene.grid.levels.front(), most)),
        solver(component, scene.grid.levels.front(), world(), o) {
    component.state().initialise(solver.state());
    solver.fill_ghosts(0);
  }
  static Scene dealt_out(Scene scene) {
    assign_owners(scene.grid.levels.front().boxes, world().size());
    return scene;
  }
  static MockComponent with_most(const Level& level, double most) {
    MockComponent c(level);
    c.most = most;
    return c;
  }
  const StepAttempt& attempt(double dt, const std::vector<Label>& wanted = {}) {
    return solver.attempt(0, dt, wanted, LevelSolverTest::control.get());
  }
  std::vector<double> values(const Warehouse& w, Label label) const {
    std::vector<double> all;
    const int slot = w.find(label, 0);
    for (int b = 0; b < static_cast<int>(w.local_boxes().size()); ++b)
      for_each_cell(w.local_boxes()[b].cells,
                    [&](IntVec3 c) { all.push_back(w.view(slot, 0, b)(c)); });
    return all;
  }
  std::vector<double> state() const { return values(solver.state(), mock_labels().q); }
};

constexpr double dt = 0.0625;  // half a cell

TEST_F(LevelSolverTest, AnAttemptIsAStepOnceItIsAccepted) {
  Tube tube;
  const auto before = tube.state();
  EXPECT_EQ(tube.attempt(dt).faults, 0);
  EXPECT_EQ(tube.state(), before);
  tube.solver.advance();
  tube.solver.accept();
  const auto after = tube.state();
  for (int i = 1; i < 40; ++i)
    EXPECT_EQ(after[i], MockComponent::start(i) +
                            0.5 * (MockComponent::start(i - 1) - MockComponent::start(i)));
  EXPECT_EQ(tube.solver.attempt_result().maxima, std::vector<double>{8});
  const double inflow = 0.5 * 0.125 * (MockComponent::start(0) - MockComponent::start(39));
  EXPECT_EQ(tube.solver.attempt_result().sums, std::vector<double>{inflow});
}

// Its one ghost layer left out: what the step reads there would lie beyond the array.
struct NarrowComponent : MockComponent {
  using MockComponent::MockComponent;
  std::vector<SlotInfo> slots() const override { return {{mock_labels().q, 0, 1, 0}}; }
};

TEST_F(LevelSolverTest, RefusesAStepThatReadsMoreGhostsThanThereAre) {
  const Scene scene = Tube::dealt_out(tube(1));
  const NarrowComponent component(scene.grid.levels.front());
  LevelSolver solver(component, scene.grid.levels.front(), world(), {});
  EXPECT_THROW(solver.attempt(0, dt, {}, LevelSolverTest::control.get()), std::logic_error);
}

// Knows on every rank what all cells hold, and how often it was asked.
struct SummingComponent : MockComponent {
  using MockComponent::MockComponent;
  mutable std::vector<double> known;
  int boundary_sums() const override { return 1; }
  void add_boundary_sums(const Warehouse& state, std::span<ExactSum> sums) const override {
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      for_each_cell(state.local_boxes()[b].cells,
                    [&](IntVec3 c) { sums[0].add(state.view(0, 0, b)(c) / 3); });
  }
  void fill_boundary(Warehouse& state, double time, std::span<const double> sums,
                     const ThreadTeam& team) const override {
    known.insert(known.end(), sums.begin(), sums.end());
    MockComponent::fill_boundary(state, time, sums, team);
  }
};

TEST_F(LevelSolverTest, TheBoundaryKnowsExactSumsOverAllCells) {
  ExactSum all;
  for (int i = 0; i < 40; ++i) all.add(MockComponent::start(i) / 3);
  for (const int boxes : {1, 3}) {
    const Scene scene = Tube::dealt_out(tube(boxes));
    const SummingComponent component(scene.grid.levels.front());
    LevelSolver solver(component, scene.grid.levels.front(), world(), {});
    component.state().initialise(solver.state());
    for (int n = 0; n < 2; ++n) solver.fill_ghosts(0);  // once: nothing has changed
    EXPECT_EQ(component.known, std::vector<double>{all.value()});
    const LevelSolver& coarsest = solver;
    LevelSolver finer(component, scene.grid.levels.front(), world(), {});
    finer.fill_ghosts(0, nullptr, &coarsest);  // of zeros itself
    EXPECT_EQ(component.known, (std::vector<double>{all.value(), all.value()}));
  }
}

TEST_F(LevelSolverTest, ARejectedAttemptNamesTheLowestCellAndChangesNothing) {
  Tube tube(3);
  const auto before = tube.state();
  const StepAttempt& a = tube.attempt(3 * 0.125);
  EXPECT_EQ(a.faults, 40);
  EXPECT_EQ(a.first_fault.cell, (IntVec3{0, 0, 0}));
  EXPECT_EQ(a.first_fault.value, 3);
  EXPECT_EQ(tube.state(), before);
}

TEST_F(LevelSolverTest, MasksHoldForTheStepAndAreForgottenAfterIt) {
  Tube tube(2, {}, 1.6);
  const std::int64_t faults = tube.attempt(dt).faults;
  ASSERT_GT(faults, 0);
  EXPECT_EQ(tube.solver.mask_faults(), faults);
  EXPECT_EQ(tube.attempt(dt).faults, 0);
  EXPECT_EQ(tube.solver.mask_faults(), 0);  // nothing left to mask
  Tube other(2, {}, 1.6);
  other.attempt(dt);
  other.solver.mask_faults();
  EXPECT_GT(other.solver.mask_faults(), 0);  // the same cells again: their neighbours
  tube.solver.advance();
  tube.solver.accept();
  tube.solver.fill_ghosts(dt);
  EXPECT_GT(tube.attempt(0.001).faults, 0);
}

TEST_F(LevelSolverTest, WantedLabelsAreStoredAndChangeNoBit) {
  Tube plain, wanting(4), forced(1, {2, true, 0, {7, 1, 1}});  // forced: no saving
  EXPECT_TRUE(plain.solver.graphs().is_step_label(mock_labels().flux));
  EXPECT_FALSE(plain.solver.graphs().is_diagnostic_label(mock_labels().flux));
  EXPECT_TRUE(plain.solver.graphs().is_diagnostic_label(mock_labels().square));
  plain.attempt(dt);
  wanting.attempt(dt, {mock_labels().flux});
  forced.attempt(dt);
  for (Tube* t : {&plain, &wanting, &forced}) t->solver.advance();
  EXPECT_EQ(wanting.state(), plain.state());
  EXPECT_EQ(forced.state(), plain.state());
  for (Tube* t : {&plain, &forced}) EXPECT_EQ(t->solver.outputs().find(mock_labels().flux, 0), -1);
  const int slot = wanting.solver.outputs().find(mock_labels().flux, 0);
  ASSERT_GE(slot, 0);
  // The face that closes the domain is stored by the last box.
  EXPECT_EQ(wanting.solver.outputs().view(slot, 0, 3)(40, 0, 0), MockComponent::start(39));
}

TEST_F(LevelSolverTest, DiagnosticsAreFunctionsOfTheState) {
  Tube tube(2);
  tube.solver.compute_diagnostics(0, {mock_labels().square});
  const auto q = tube.state(), square = tube.values(tube.solver.outputs(), mock_labels().square);
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_EQ(square[i], q[i] * q[i]);
}

// Serially and (see CMakeLists.txt) on three ranks: all know the same.
class LevelSolverOnRanks : public LevelSolverTest {};

TEST_F(LevelSolverOnRanks, AgreeOnFaultsMasksAndSums) {
  Tube tube(5);
  const StepAttempt& a = tube.attempt(3 * 0.125);
  EXPECT_EQ(a.faults, 40);
  EXPECT_EQ(a.first_fault.cell, (IntVec3{0, 0, 0}));
  EXPECT_EQ(a.first_fault.value, 3);
  EXPECT_EQ(tube.solver.mask_faults(), 40);
  EXPECT_EQ(tube.attempt(dt).faults, 0);
  const double inflow = 0.5 * 0.125 * (MockComponent::start(0) - MockComponent::start(39));
  EXPECT_EQ(tube.solver.attempt_result().sums, std::vector<double>{inflow});
  EXPECT_EQ(tube.solver.attempt_result().maxima, std::vector<double>{8});
}

TEST_F(LevelSolverOnRanks, FindTheLowestCellThatIsNoNumber) {
  Tube tube(4);
  EXPECT_FALSE(tube.solver.unsound_start());
  const auto& boxes = tube.solver.state().local_boxes();
  for (int i : {30, 21})
    for (std::size_t b = 0; b < boxes.size(); ++b)
      if (boxes[b].cells.contains(IntVec3{i, 0, 0}))
        tube.solver.state().view(0, 0, static_cast<int>(b))(i, 0, 0) =
            std::numeric_limits<double>::infinity();
  const auto found = tube.solver.unsound_start();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->where.cell, (IntVec3{21, 0, 0}));
  EXPECT_EQ(found->label, mock_labels().q);
}

TEST_F(LevelSolverTest, TellsWhatItCosts) {
  Tube tube(1, {1, false, 1, {}});
  EXPECT_EQ(tube.solver.initial_rates(), std::vector<double>{8});
  tube.attempt(dt);
  EXPECT_EQ(tube.solver.graphs().effect_tasks(),
            (std::vector<int>{2, 0}));  // faces, update; nothing saved
  EXPECT_GT(tube.solver.graphs().effect_seconds()[0], 0);
  EXPECT_EQ(tube.solver.graphs().blocks_run() + tube.solver.graphs().blocks_skipped(), 1);
  EXPECT_GE(tube.solver.memory_bytes(), 2 * 42 * sizeof(double));
  const auto& tasks = tube.solver.graphs().step(false, {}).list(-1).tasks();
  EXPECT_TRUE(
      std::any_of(tasks.begin(), tasks.end(), [](const Task& t) { return t.name == "update"; }));
}

}  // namespace
}  // namespace sluice::level_solver_test
