// What fluid and solids keep in cells: the fluid's variables, and fields of burning.
#pragma once
#include "ice/fluid_state.hpp"

namespace sluice::mpmice {

class MpmIce;

class MpmIceState final : public ice::FluidState {
 public:
  explicit MpmIceState(const MpmIce& both);

  void initialise(Warehouse& state) const override;
  std::vector<SlotInfo> work_slots() const override;

 private:
  const MpmIce* both_;
};

}  // namespace sluice::mpmice
