// What an implicit step brings in and takes out, and what its rule loses: for the books of a run.
//
//   f = sum of stresses and loads on a node at the start and end of the step, u its displacement
//   W = (f_0 + f_1).u/2    where a node is given, all else that its mass gains is the giver's work
//
// A node's gain is half of M a_0.u + M a_1.u: the acceleration a_0 that particles carry is that of
// the step before only as far as nodes see it, and M a_0 - f_0 is what that costs.
#pragma once
#include <vector>

#include "mpm/implicit/equilibrium.hpp"

namespace sluice::mpm {

struct FinishedStep {
  NodesOfStep::Parts parts;
  const NodesOfStep* nodes;
  const Equilibrium* equilibrium;
  const NodesOfStep::Vectors *loads_before, *loads;  // forces on particles, by kind; empty: none
  double dt;
};

// Adds to the sums of a step (StepSums). Particles hold what they are after it.
void book_step(const FinishedStep& step, std::vector<double>& sums);

}  // namespace sluice::mpm
