#include "ice/pressure/pressure_solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/run/level_solver.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice::pressure {
namespace {

constexpr double most_growth = 100.0;  // of the error over its least: the step is too long
constexpr int most_without_gain = 3;   // passes
constexpr double round_off = 1e-9;     // a volume error that passes without gain may end at

template <class F>
void for_each_box(LevelSolver& level, F&& f) {
  for (int b = 0; b < static_cast<int>(level.state().local_boxes().size()); ++b)
    f(b, level.state().local_boxes()[static_cast<std::size_t>(b)].cells);
}

bool same(const std::vector<GridBox>& a, const std::vector<GridBox>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const GridBox& x, const GridBox& y) {
    return x.cells == y.cells && x.owner == y.owner;
  });
}

// Coefficients of the faces of one direction: half of them between cells, the others on sides of
// the domain, where d of the ghost is 0.
void add_faces(const Level& level, int d, const IndexBox& cells, const ConstRealView& face,
               const RealView& diagonal, const RealView& low) {
  const bool wraps = level.periodic[static_cast<std::size_t>(d)];
  for_each_cell(cells, [&](IntVec3 c) {
    IntVec3 above = c;
    ++above[d];
    diagonal(c) += face(c) + face(above);
    low(c) = wraps || c[d] > level.domain.lower[d] ? -face(c) : 0.0;
  });
}

}  // namespace

// Of the level with its boxes as they are.
struct PressureSolve::System {
  System(const Level& level, int rank, const solve::SolverSettings& settings)
      : boxes(level.boxes),
        matrix(level),
        right_side(solve::boxes_of(level, rank)),
        change(solve::boxes_of(level, rank)),
        solver(solve::make_linear_solver(settings)) {}

  std::vector<GridBox> boxes;
  solve::CellMatrix matrix;
  solve::BoxArrays right_side, change;
  std::unique_ptr<solve::LinearSolver> solver;

  void fill_matrix(LevelSolver& level) {
    const Warehouse& stored = level.outputs();
    const Labels& l = labels();
    const Level& cells_of = level.level();
    for_each_box(level, [&](int b, const IndexBox& cells) {
      const auto n = static_cast<std::size_t>(b);
      const RealView& diagonal = matrix.diagonal()[n];
      const auto own = stored.view(stored.find(l.matrix_cell, 0), 0, b);
      for_each_cell(cells, [&](IntVec3 c) { diagonal(c) = own(c); });
      for (int d = 0; d < 3; ++d)
        if (cells_of.active[static_cast<std::size_t>(d)])
          add_faces(cells_of, d, cells, stored.view(stored.find(l.matrix_face[d], 0), 0, b),
                    diagonal, matrix.low(d)[n]);
    });
  }
};

PressureSolve::PressureSolve(const ImplicitSettings& settings) : settings_(settings) {}

PressureSolve::System& PressureSolve::system_on(LevelSolver& level, int rank) {
  if (system_ == nullptr || !same(system_->boxes, level.level().boxes)) {
    system_ = std::make_shared<System>(level.level(), rank, settings_.linear);
  }
  return *system_;
}

Verdict PressureSolve::start(const StageScope& scope) {
  passes_.clear();
  for (LevelSolver* level : scope.levels) {
    Warehouse& state = level->state();
    const int slot = state.find(labels().pressure_increment, 0);
    for_each_box(*level, [&](int b, const IndexBox&) {
      const RealView d = state.view(slot, 0, b);
      fill(d, d.box, 0.0);
    });
  }
  return Verdict::good;
}

Verdict PressureSolve::solve(const StageScope& scope) {
  LevelSolver& level = *scope.levels.front();
  System& system = system_on(level, scope.ranks->rank());
  if (scope.pass == 1) {
    system.fill_matrix(level);
    system.solver->set_up(system.matrix);
  }
  const Labels& l = labels();
  const Warehouse& stored = level.outputs();
  const int from = stored.find(scope.pass == 1 ? l.right_side : l.volume_error, 0);
  for_each_box(level, [&](int b, const IndexBox& cells) {
    const auto n = static_cast<std::size_t>(b);
    const auto R = stored.view(from, 0, b);
    for_each_cell(cells, [&](IntVec3 c) {
      system.right_side.views()[n](c) = R(c);
      system.change.views()[n](c) = 0.0;
    });
  });
  const solve::SolveReport report =
      system.solver->solve(system.right_side.values(), system.change.views());
  passes_.push_back({0.0, report.iterations,
                     report.right_side > 0 ? report.residuals.back() / report.right_side : 0.0,
                     report.reason});
  Warehouse& state = level.state();
  const int slot = state.find(l.pressure_increment, 0);
  for_each_box(level, [&](int b, const IndexBox& cells) {
    const RealView d = state.view(slot, 0, b);
    const RealView& e = system.change.views()[static_cast<std::size_t>(b)];
    for_each_cell(cells, [&](IntVec3 c) { d(c) += e(c); });
  });
  level.fill_work_ghosts(l.pressure_increment);
  return Verdict::good;
}

std::string PressureSolve::history() const {
  std::string text;
  for (std::size_t n = 0; n < passes_.size(); ++n)
    text += fmt::format("{}{}: {:.2e} ({} iterations to {:.1e}{}{})", n == 0 ? "" : ", ", n + 1,
                        passes_[n].error, passes_[n].iterations, passes_[n].residual,
                        passes_[n].reason.empty() ? "" : ", ", passes_[n].reason);
  return text;
}

// No pass of the last few brought the error well below the least before them.
bool PressureSolve::stalls() const {
  if (passes_.size() <= most_without_gain) return false;
  double before = passes_.front().error, last = passes_.back().error;
  for (std::size_t n = 0; n < passes_.size(); ++n)
    (n + most_without_gain < passes_.size() ? before : last) =
        std::min(n + most_without_gain < passes_.size() ? before : last, passes_[n].error);
  return last > 0.5 * before;
}

StepShape::Iterate::Answer PressureSolve::judge(const StageScope& scope) {
  using Answer = StepShape::Iterate::Answer;
  double error = 0;
  for (const LevelSolver* level : scope.levels)
    error = std::max(error, level->attempt_result().maxima[StepSlots::volume_error]);
  passes_.back().error = error;
  const auto reject = [&](const char* why) {
    *scope.reason = fmt::format(
        "the pressure did not converge: {}. Largest relative volume error after each pass, {:.2e} "
        "wanted: {}. Try a smaller <cfl>, a larger <outer_iteration_tolerance> or more "
        "<max_outer_iterations>",
        why, settings_.tolerance, history());
    return Answer::reject;
  };
  if (!std::isfinite(error)) return reject("it is not finite");
  if (error <= settings_.tolerance) return Answer::done;
  double least = error;
  for (const Pass& p : passes_) least = std::min(least, p.error);
  if (error > most_growth * least) return reject("it grows");
  if (stalls()) return least <= round_off ? Answer::done : reject("it does not fall any more");
  if (settings_.max_passes == 1) return Answer::done;
  if (scope.pass >= std::min(settings_.max_passes, settings_.most_before_redo))
    return reject("no more passes are allowed");
  return Answer::again;
}

}  // namespace sluice::ice::pressure
