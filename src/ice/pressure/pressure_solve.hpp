// The passes of a semi-implicit step: solve, sweep, judge what is left. Kept from step to step:
// memory and what the solver has set up.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/run/component/step_shape.hpp"
#include "ice/deck/implicit_settings.hpp"
#include "ice/pressure/pressure_system.hpp"
#include "ice/pressure/solve_history.hpp"

namespace sluice::ice::pressure {

class PressureSolve {
 public:
  // first_maximum: where the maxima of the fluid begin among those of a step.
  // `history` is told of every step.
  PressureSolve(const ImplicitSettings& settings, int first_maximum,
                std::shared_ptr<SolveHistory> history);

  // d = 0 on all levels.
  Verdict start(const StageScope& scope);
  // Where levels meet: after X- was stored.
  Verdict join(const StageScope& scope);
  // d += the solution: of the right-hand side of the step in the first pass, later of what the
  // sweep before left.
  Verdict solve(const StageScope& scope);
  // Whether the largest volume error of the sweep meets the tolerance. Rejects a step that will
  // not, with the history of the passes as the reason.
  StepShape::Iterate::Answer judge(const StageScope& scope);

 private:
  struct Pass {
    double error = 0;  // max |R| after it
    int iterations = 0;
    double residual = 0;  // of the linear solve, of its right-hand side
    std::string reason;   // why that did not converge
  };
  void pass(const StageScope& scope);
  PressureSystem& system_on(const StageScope& scope);
  std::string history() const;
  void tell_history() const;
  bool stalls() const;

  ImplicitSettings settings_;
  std::size_t volume_error_;  // which of the maxima
  std::unique_ptr<PressureSystem> system_;
  std::vector<std::vector<GridBox>> boxes_;  // of its levels
  std::vector<Pass> passes_;                 // of the attempt under way
  std::shared_ptr<SolveHistory> told_;
};

}  // namespace sluice::ice::pressure
