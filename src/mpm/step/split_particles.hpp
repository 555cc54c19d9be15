// Particles that are stretched or stressed much become several, once (refine_particles).
#pragma once
#include "framework/base/communicator.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

// Between steps: each particle that meets a criterion of its material and is none of such parts
// gives way to parts that share its mass, volume and energy, with all else as it was: stretchRatio
// (the longest edge over the shortest, or its inverse) to four along the longest edge, stressNorm
// (|stress|, Pa) to halves in every direction. Numbers of parts follow from that of the whole, so
// that they depend on no rank. Collective; true: relocate() is next.
bool split_particles(const MpmScene& solids, const std::vector<Carried>& carried,
                     ParticleCloud& cloud, Communicator& ranks);

}  // namespace sluice::mpm
