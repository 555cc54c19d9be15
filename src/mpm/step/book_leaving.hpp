// What particles that leave the domain take along.
#pragma once
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/run/component/event_ledger.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

// Adds it to the sums of a step (StepSums::left_x on): mass (kg) by material, momentum (kg m/s),
// energy (J). Each is an event, with the last cell of the domain that it was in. Between a step and
// the relocation of its particles; `levels` are those of the cloud. Collective.
void book_leaving(const MpmScene& solids, const std::vector<Carried>& carried,
                  const std::vector<Level>& levels, const ParticleCloud& cloud, Communicator& ranks,
                  std::vector<double>& sums, EventLedger& events);

}  // namespace sluice::mpm
