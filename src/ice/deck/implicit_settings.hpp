// <ImplicitSolver>: the pressure of a step is solved for, semi-implicitly. Plain data.
#pragma once
#include "framework/deck/schema.hpp"
#include "framework/solve/solver_settings.hpp"

namespace sluice::ice {

struct ImplicitSettings {
  solve::SolverSettings linear;     // of each pass
  int max_passes = 20;              // <max_outer_iterations>
  double tolerance = 1e-8;          // <outer_iteration_tolerance>: largest relative volume error
  int max_passes_before_redo = 20;  // <iters_before_timestep_restart>
  Location where;
};

TagSpec implicit_solver_tag();
// From a block that the schema has checked.
ImplicitSettings read_implicit(const DeckNode& root, const DeckNode& block,
                               std::vector<Fault>& faults);
// What of a deck has no semi-implicit step.
void check_implicit(const DeckNode& root, std::vector<Fault>& faults);

}  // namespace sluice::ice
