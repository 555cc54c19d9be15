#include "mpmice/mpmice_state.hpp"

#include "mpm/solids_beside_fluid.hpp"
#include "mpmice/mpmice.hpp"
#include "mpmice/step/coupling.hpp"

namespace sluice::mpmice {

MpmIceState::MpmIceState(const MpmIce& both) : FluidState(both.fluid().part()), both_(&both) {}

void MpmIceState::initialise(Warehouse& state) const {
  FluidState::initialise(state);
  start_fractions(state, both_->fluid().part(), *both_->solids().particles(),
                  mpm::kinds_beside_fluid(both_->solids()));
  both_->burning_cells().clear(state);
}

std::vector<SlotInfo> MpmIceState::work_slots() const {
  std::vector<SlotInfo> slots = FluidState::work_slots();
  const std::vector<SlotInfo>& burning = both_->burning_cells().slots();
  slots.insert(slots.end(), burning.begin(), burning.end());
  return slots;
}

}  // namespace sluice::mpmice
