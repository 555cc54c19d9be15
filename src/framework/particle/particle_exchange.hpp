// Particles that go to other ranks: one packed message to each rank that gets any.
#pragma once
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/particle/particle_set.hpp"

namespace sluice {

// Collective. `leaving`: by rank; what is meant for this rank itself is returned as well.
ParticleSet exchange_particles(const std::vector<ParticleSet>& leaving, Communicator& communicator);

}  // namespace sluice
