// The solvers that `sluice tune` tries.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/solve/captured_system.hpp"

namespace sluice {

using CapturedSystems = std::vector<std::unique_ptr<solve::CapturedSystem>>;

// Is a method of hypre at work, alone or as preconditioner.
bool works_with(const solve::SolverSettings& settings, const std::string& method);

// As the table of results names it: "hypre cg+pfmg, relax 2, skip 1".
std::string short_name(const solve::SolverSettings& settings);

// In the order of expectation: the deck's own first, which the others take goal and bounds from.
// Solvers of hypre measure residuals as a share of the right-hand side in the norm L2; where the
// deck asks for something else they get the tolerance that meets it on all these systems.
std::vector<solve::SolverSettings> solver_candidates(const solve::SolverSettings& deck,
                                                     const CapturedSystems& systems);

// That tolerance, a share of the right-hand side, rounded down to one digit; the deck's own where
// it is of this kind already.
double relative_tolerance(const solve::SolverSettings& deck, const CapturedSystems& systems);

}  // namespace sluice
