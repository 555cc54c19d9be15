// A linear solve as a stage of a step.
#include "examples/linear_solve.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/base/communicator.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/faults.hpp"
#include "framework/grid/grid_boxes.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "framework/scene/deck_values.hpp"
#include "framework/solve/linear_solver.hpp"
#include "framework/solve/solver_tags.hpp"

namespace sluice::examples {
namespace {

using Directions = std::array<bool, 3>;

double diagonal(const Directions& directions) {
  return 2.0 * (directions[0] + directions[1] + directions[2]);
}

double right_side_in(IntVec3 cell) {
  return cell == IntVec3{} ? 1.0 : 0.0;
}

solve::CellMatrix matrix_on(const Level& level, const Directions& directions) {
  solve::CellMatrix matrix(level);
  for (const RealView& v : matrix.diagonal()) fill(v, v.box, diagonal(directions));
  for (int d = 0; d < 3; ++d) {
    if (!directions[d] || !level.active[d]) continue;
    for (const RealView& v : matrix.low(d)) {
      IndexBox coupled = v.box;  // with a cell below them
      if (!level.periodic[d])
        coupled.lower[d] = std::max(coupled.lower[d], level.domain.lower[d] + 1);
      fill(v, coupled, -1.0);
    }
  }
  return matrix;
}

// The system on the boxes of a level, and its solver; kept from step to step.
class PressureSystem {
 public:
  PressureSystem(const Level& level, int rank, const SolverTestScene& s)
      : boxes_(level.boxes),
        matrix_(matrix_on(level, s.directions)),
        right_side_(solve::boxes_of(level, rank)),
        solver_(solve::make_linear_solver(s.solver)) {
    for (const RealView& v : right_side_.views())
      for_each_cell(v.box, [&](IntVec3 c) { v(c) = right_side_in(c); });
    solver_->set_up(matrix_);
  }
  // Of all ranks: they answer alike.
  bool fits(const Level& level) const { return same_boxes(boxes_, level.boxes); }
  solve::SolveReport run(const solve::BoxViews& x) {
    return solver_->solve(right_side_.values(), x);
  }

 private:
  std::vector<GridBox> boxes_;
  solve::CellMatrix matrix_;
  solve::BoxArrays right_side_;
  std::unique_ptr<solve::LinearSolver> solver_;
};

// The stage: the work field of the level becomes the solution.
struct PressureSolve {
  SolverTestScene settings;
  Label pressure, solution;
  std::unique_ptr<PressureSystem> system = nullptr;
  int steps = 0;  // accepted so far

  Verdict operator()(const StageScope& scope) {
    LevelSolver& level = *scope.levels.front();
    Warehouse& state = level.state();
    const int from = state.find(pressure, 0), to = state.find(solution, 0);
    solve::BoxViews x;
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
      const IndexBox& cells = state.local_boxes()[b].cells;
      x.push_back(part_of(state.view(to, 0, b), cells));
      const RealView old = state.view(from, 0, b);
      for_each_cell(cells, [&](IntVec3 c) { x.back()(c) = old(c); });
    }
    // A rejected attempt does not count.
    scope.journal->at_acceptance([this] { ++steps; });
    if (steps % settings.solver.solve_every != 0) return Verdict::good;
    if (system == nullptr || steps % std::max(1, settings.solver.set_up_every) == 0 ||
        !system->fits(level.level()))
      system = std::make_unique<PressureSystem>(level.level(), scope.ranks->rank(), settings);
    const solve::SolveReport report = system->run(x);
    // The system knows no time: a smaller step would end the same way.
    if (!report.converged) throw PhysicsError("solve for pressure: " + report.reason);
    return Verdict::good;
  }
};

}  // namespace

SolverTestLabels claim_solver_test_labels() {
  const auto cell = [](const char* name, const char* definition) {
    return claim_label({name, ValueType::real, Centring::cell, "1", definition});
  };
  return {cell("pressure", "solution of the linear system (solvertest)"),
          cell("pressure_rhs", "right-hand side of the linear system (solvertest)"),
          cell("pressure_matrix", "diagonal of the matrix of the linear system (solvertest)")};
}

SolverTest::SolverTest(const Scene& scene, const SolverTestScene& settings)
    : PlainComponent(scene, "solvertest", "linear system"),
      settings_(settings),
      solution_(declare_label({"work.solution", ValueType::real, Centring::cell, "1",
                               "solution before it is the state"})) {}

std::vector<SlotInfo> SolverTest::slots() const {
  return {{labels_.pressure, 0, 1, 0}};
}

std::vector<SlotInfo> SolverTest::work_slots() const {
  return {{solution_, 0, 1, 0}};
}

void SolverTest::declare_stages(StepShape& shape) const {
  const auto stage =
      std::make_shared<PressureSolve>(PressureSolve{settings_, labels_.pressure, solution_});
  shape.solve("pressure", [stage](const StageScope& scope) { return (*stage)(scope); });
  shape.sweep("pressure");
  shape.commit();
}

void SolverTest::declare(TaskList& list, const StepVariant& /*variant*/) const {
  TaskBuilder task = list.task("pressure", equation);
  const In solution = task.read(list.old_state(solution_, 0, 1));
  const Out pressure = task.write(list.new_state(labels_.pressure, 0, 1));
  task.kernel([=](const Row& row) { std::copy_n(row(solution), row.count(), row(pressure)); });
}

void SolverTest::declare_diagnostics(TaskList& list, int l) const {
  PlainComponent::declare_diagnostics(list, l);
  const Level& grid = level(l);
  const int along = grid.active[0] ? 0 : grid.active[1] ? 1 : 2;
  TaskBuilder source = list.task("right-hand side", saved);
  const Out right_side = source.write(list.output(labels_.right_side, 0));
  source.kernel([=](const Row& row) {
    IntVec3 cell = row.cell();
    for (int i = 0; i < row.count(); ++i, ++cell[along]) row(right_side)[i] = right_side_in(cell);
  });
  TaskBuilder system = list.task("matrix", saved);
  const Out matrix = system.write(list.output(labels_.matrix, 0));
  const double on_diagonal = diagonal(settings_.directions);
  system.kernel([=](const Row& row) { std::fill_n(row(matrix), row.count(), on_diagonal); });
}

StepLimit SolverTest::limit(const std::vector<double>& /*maxima*/) const {
  return {settings_.dt, "deck: delt"};
}

void add_solver_test_tags(Schema& schema) {
  schema.add(
      tag("SolverTest", "one linear solve per step, of a Laplacian with one source")
          .with_children({tag("delt", "length of a step").once().real().above(0).unit("time"),
                          tag("X_Laplacian", "present: derivatives along x"),
                          tag("Y_Laplacian", "present: derivatives along y"),
                          tag("Z_Laplacian", "present: derivatives along z"),
                          solve::solver_parameters_tag()}));
}

std::unique_ptr<Component> make_solver_test(const Deck& deck, const Scene& scene,
                                            std::vector<Fault>& faults) {
  const DeckNode* block = need_block(deck, scene, "SolverTest", faults);
  need_one_level(scene, faults);
  if (block == nullptr) return nullptr;
  SolverTestScene settings;
  settings.dt = block->real("delt");
  for (int d = 0; d < 3; ++d)
    settings.directions[d] = block->child(fmt::format("{}_Laplacian", "XYZ"[d])) != nullptr;
  if (diagonal(settings.directions) == 0)
    add_error(faults, block->where,
              "<SolverTest> needs one of <X_Laplacian>, <Y_Laplacian> and <Z_Laplacian>");
  settings.solver = solve::read_solver_settings(*deck.root, *block, "implicitPressure", faults);
  if (any_error(faults)) return nullptr;
  return std::make_unique<SolverTest>(scene, settings);
}

}  // namespace sluice::examples
