// Which rank does which box: dealt out along a space-filling curve by measured cost.
//
// Owners never change a result, so that what is measured may differ from run to run.
#pragma once
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "framework/run/levels/particle_cloud.hpp"

namespace sluice {

// Seconds spent in each box of a level since it was laid out, by box id; on its particles, too.
// Collective.
std::vector<double> box_seconds(const LevelSolver& solver, const ParticleCloud* particles,
                                Communicator& communicator);

// Owners for the boxes that a level is to get, from what its present boxes cost. Collective.
void deal_out(std::vector<GridBox>& boxes, const LevelSolver& solver,
              const ParticleCloud* particles, Communicator& communicator);

// The boxes of a level with better owners; empty when the busiest rank would not gain a share of
// `least_gain` of its work. Collective.
std::vector<GridBox> rebalanced(const LevelSolver& solver, const ParticleCloud* particles,
                                double least_gain, Communicator& communicator);

}  // namespace sluice
