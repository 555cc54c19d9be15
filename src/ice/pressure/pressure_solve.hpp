// One pass of the semi-implicit step on a level: the system from the fields that a sweep has
// stored, its solution into the work slot d. Kept from step to step: memory and what the solver
// has set up.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/run/step_shape.hpp"
#include "framework/solve/linear_solver.hpp"
#include "ice/deck/implicit_settings.hpp"

namespace sluice::ice::pressure {

class PressureSolve {
 public:
  explicit PressureSolve(const ImplicitSettings& settings);

  // d = 0 on all levels.
  Verdict start(const StageScope& scope);
  // d += the solution: of the right-hand side of the step in the first pass, later of what the
  // sweep before left.
  Verdict solve(const StageScope& scope);
  // Whether the largest volume error of the sweep meets the tolerance. Rejects a step that will
  // not, with the history of the passes as the reason.
  StepShape::Iterate::Answer judge(const StageScope& scope);

 private:
  struct System;
  struct Pass {
    double error = 0;  // max |R| after it
    int iterations = 0;
    double residual = 0;  // of the linear solve, of its right-hand side
    std::string reason;   // why that did not converge
  };
  System& system_on(LevelSolver& level, int rank);
  std::string history() const;
  bool stalls() const;

  ImplicitSettings settings_;
  std::shared_ptr<System> system_;
  std::vector<Pass> passes_;  // of the attempt under way
};

}  // namespace sluice::ice::pressure
