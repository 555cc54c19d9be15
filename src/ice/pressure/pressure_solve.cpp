#include "ice/pressure/pressure_solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/pressure/finer_faces.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice::pressure {
namespace {

// threshold: growth of the error over its least at which the step is refused as too long; unit:
//   1; test: none
constexpr double max_growth = 100.0;
// threshold: ratio of the errors of two passes below which the step converges, and goes on beyond
//   the passes after which the deck would redo it; unit: 1; test: none
constexpr double falling = 0.3;
constexpr int max_without_gain = 3;  // passes
// Where levels meet the matrix is not that of the flow: so many passes correct it, to this share.
constexpr int max_corrections = 6;
// threshold: share of the first error to which these passes correct it; unit: 1; test: none
constexpr double corrected = 1e-3;
// threshold: relative volume error at which passes may end that gain nothing any more: round-off;
//   unit: 1; test: ImplicitLimits.ToleranceZeroEndsAtRoundOff
constexpr double round_off = 1e-9;

using BoxesOfLevels = std::vector<std::vector<GridBox>>;

BoxesOfLevels boxes_of(const StageScope& scope) {
  BoxesOfLevels boxes;
  for (const LevelSolver* level : scope.levels) boxes.push_back(level->level().boxes);
  return boxes;
}

bool same(const BoxesOfLevels& a, const BoxesOfLevels& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const GridBox& p, const GridBox& q) {
                        return p.cells == q.cells && p.owner == q.owner;
                      });
  });
}

void fill_slot(LevelSolver& level, Label label, double value) {
  const int slot = slot_of(level.state(), label);
  for_each_box(level, [&](int b, const IndexBox&) {
    const RealView v = level.state().view(slot, 0, b);
    fill(v, v.box, value);
  });
}

}  // namespace

PressureSolve::PressureSolve(const ImplicitSettings& settings, int first_maximum,
                             std::shared_ptr<SolveHistory> history)
    : settings_(settings),
      volume_error_(first_maximum + StepSlots::volume_error),
      told_(std::move(history)) {}

PressureSystem& PressureSolve::system_on(const StageScope& scope) {
  BoxesOfLevels boxes = boxes_of(scope);
  if (system_ == nullptr || !same(boxes, boxes_)) {
    system_ = make_pressure_system(scope.levels, scope.ranks->rank(), settings_.linear);
    boxes_ = std::move(boxes);
  }
  return *system_;
}

Verdict PressureSolve::start(const StageScope& scope) {
  passes_.clear();
  const Labels& l = labels();
  for (LevelSolver* level : scope.levels) {
    fill_slot(*level, l.pressure_increment, 0.0);
    if (slot_of(level->state(), l.interface_pressure) >= 0)
      fill_slot(*level, l.interface_pressure, not_given);
    for (int d = 0; d < 3; ++d)
      if (slot_of(level->state(), l.finer_face_velocity[d]) >= 0) {
        fill_slot(*level, l.finer_face_velocity[d], not_given);
        fill_slot(*level, l.finer_face_pressure[d], not_given);
      }
  }
  return Verdict::good;
}

Verdict PressureSolve::join(const StageScope& scope) {
  system_on(scope).join_work_pressure(scope.levels);
  return Verdict::good;
}

// What a solver refuses (numbers that are not finite, empty rows) rejects the step with its words;
// every rank is told the same.
Verdict PressureSolve::solve(const StageScope& scope) {
  try {
    pass(scope);
  } catch (const PhysicsError& error) {
    *scope.reason = fmt::format("the pressure cannot be solved for: {}{}{}", error.what(),
                                passes_.empty() ? "" : ". Passes before: ", history());
    return Verdict::reject;
  }
  return Verdict::good;
}

void PressureSolve::pass(const StageScope& scope) {
  PressureSystem& system = system_on(scope);
  if (scope.pass == 1) system.set_up(scope.levels);
  const Labels& l = labels();
  const solve::SolveReport report =
      system.correct(scope.levels, scope.pass == 1 ? l.right_side : l.volume_error);
  passes_.push_back({0.0, report.iterations,
                     report.right_side > 0 ? report.residuals.back() / report.right_side : 0.0,
                     report.reason});
}

std::string PressureSolve::history() const {
  std::string text;
  for (std::size_t n = 0; n < passes_.size(); ++n)
    text += fmt::format("{}{}: {:.2e} ({} iterations to {:.1e}{}{})", n == 0 ? "" : ", ", n + 1,
                        passes_[n].error, passes_[n].iterations, passes_[n].residual,
                        passes_[n].reason.empty() ? "" : ", ", passes_[n].reason);
  return text;
}

void PressureSolve::tell_history() const {
  *told_ = {static_cast<int>(passes_.size()), 0, passes_.back().residual, passes_.back().error};
  for (const Pass& pass : passes_) told_->iterations += pass.iterations;
}

// No pass of the last few brought the error well below the least before them.
bool PressureSolve::stalls() const {
  if (passes_.size() <= max_without_gain) return false;
  double before = passes_.front().error, last = passes_.back().error;
  for (std::size_t n = 0; n < passes_.size(); ++n)
    (n + max_without_gain < passes_.size() ? before : last) =
        std::min(n + max_without_gain < passes_.size() ? before : last, passes_[n].error);
  return last > 0.5 * before;
}

StepShape::Iterate::Answer PressureSolve::judge(const StageScope& scope) {
  using Answer = StepShape::Iterate::Answer;
  double error = 0;
  for (const LevelSolver* level : scope.levels)
    error = std::max(error, level->attempt_result().maxima[volume_error_]);
  passes_.back().error = error;
  tell_history();
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
  if (error > max_growth * least) return reject("it grows");
  if (stalls()) return least <= round_off ? Answer::done : reject("it does not fall any more");
  const bool levels = scope.levels.size() > 1;
  if (settings_.max_passes == 1 &&
      (!levels || error <= corrected * passes_.front().error || scope.pass >= max_corrections))
    return Answer::done;
  // A step that converges may go on after as many passes as the deck would redo it.
  const std::size_t done = passes_.size();
  const bool falls = done > 1 && error < falling * passes_[done - 2].error;
  const int most = falls ? settings_.max_passes
                         : std::min(settings_.max_passes, settings_.max_passes_before_redo);
  if (scope.pass >= (levels ? std::max(most, max_corrections) : most))
    return reject("no more passes are allowed");
  return Answer::again;
}

}  // namespace sluice::ice::pressure
