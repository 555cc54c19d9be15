// What particles that leave the domain take along.
#pragma once
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/run/particle_cloud.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

// Adds it to the sums of a step (StepSums::left_x on): mass (kg) by material, momentum (kg m/s),
// energy (J). Between a step and the relocation of its particles. Collective.
void book_leaving(const MpmScene& solids, const std::vector<Carried>& carried,
                  const ParticleCloud& cloud, Communicator& ranks, std::vector<double>& sums);

}  // namespace sluice::mpm
