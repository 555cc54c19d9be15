// Materials before their activation_time and after their deactivation_time: what they are at the
// end of a step is what they were.
#pragma once
#include "framework/run/component/step_shape.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/step/body.hpp"

namespace sluice::mpm {

void keep_particles(ParticleStore& store, const ParticleKind& kind, int level);

// Bounds of what rests stay; c/h + |v|/h of what awakes counts for the next step, 1/s.
double keep_resting(const Level& level, std::span<const Body> bodies, const StepScope& step,
                    std::vector<KindRates>& rates);

}  // namespace sluice::mpm
