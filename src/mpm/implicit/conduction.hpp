// Conduction of heat by one linear system a step, of one temperature at a node.
//
//   (C/dt + K) T_1 = C/dt T_0 + q,   C = sum m c S, T_0 = sum m c T S/C, K = sum k V G.G
//
// Particles take the change T_1 - T_0 of their nodes. Without storage (steady heat): K T_1 = q.
#pragma once
#include "framework/task/thread_team.hpp"
#include "mpm/implicit/nodes_of_step.hpp"
#include "mpm/step/outside_forces.hpp"

namespace sluice::mpm {

struct HeatStep {
  double time, dt;  // of its start, s
  const ThreadTeam* team;
};

// warmed: T_1 - T_0 by node, K; empty where nothing is warmed. False: there is no solution.
bool conduct_heat(const NodesOfStep::Parts& parts, const OutsideForces& outside,
                  const HeatStep& step, std::vector<double>& warmed);

}  // namespace sluice::mpm
