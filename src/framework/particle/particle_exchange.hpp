// Particles that go to other ranks: one packed message to each rank that gets any.
#pragma once
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/particle/particle_set.hpp"

namespace sluice {

// Collective. `leaving`: by rank; what is meant for this rank itself is returned first, then what
// comes from the others, in the order of ranks. `neighbours`: ranks to which particles usually go,
// each of which has this rank among its own. Where all do, numbers of particles pass between
// neighbours alone; where one goes farther, all ranks tell all others.
ParticleSet exchange_particles(const std::vector<ParticleSet>& leaving,
                               const std::vector<int>& neighbours, Communicator& communicator);

}  // namespace sluice
