// Conduction of heat by one linear system a step, of one temperature at a node.
//
//   (C/dt + K) T_1 = C/dt T_0 + q,   C = sum m c S, T_0 = sum m c T S/C, K = sum k V G.G
//
// Particles take the change T_1 - T_0 of their nodes. Without storage (steady heat): K T_1 = q.
#pragma once
#include "mpm/implicit/nodes_of_step.hpp"
#include "mpm/implicit/sparse_solver.hpp"
#include "mpm/step/outside_forces.hpp"

namespace sluice::mpm {

// By node; false: there is no solution.
bool conduct_heat(const NodesOfStep::Parts& parts, const OutsideForces& outside, double time,
                  double dt, std::vector<double>& warmed);

}  // namespace sluice::mpm
