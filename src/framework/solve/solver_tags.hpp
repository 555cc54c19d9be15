// How decks name a linear solver: <Solver type="..."> at the top, and a block <Parameters> in the
// block of what is solved.
//
//   add_solver_tag(schema);                                          // <Solver>, once
//   tag("ImplicitSolver", ...).child(solver_parameters_tag())        // where a solve is described
//   const SolverSettings s = read_solver_settings(root, block, "implicitPressure", faults);
//
// All tags of the format are read, whatever the solver: decks write the parameters of several.
// Those that the chosen one has no use for change nothing; where a reader could expect more, a
// warning says so.
#pragma once
#include <string>
#include <vector>

#include "framework/deck/schema.hpp"
#include "framework/solve/solver_settings.hpp"

namespace sluice::solve {

// <Parameters variable="...">, any number of times.
TagSpec solver_parameters_tag();

// <Solver> with a block <Parameters> of its own.
void add_solver_tag(Schema& schema);

// The type that a deck names; without <Solver> our own.
std::string solver_type(const DeckNode& root);

// One block <Parameters>; null: the defaults. Faults carry the place of their tag.
SolverSettings read_solver_parameters(const DeckNode* parameters, const std::string& type,
                                      std::vector<Fault>& faults);

// For the solve for `variable` that `block` describes: by the block's <Parameters> for this
// variable or for any, else by those of <Solver>, else by the defaults.
SolverSettings read_solver_settings(const DeckNode& root, const DeckNode& block,
                                    const std::string& variable, std::vector<Fault>& faults);

}  // namespace sluice::solve
