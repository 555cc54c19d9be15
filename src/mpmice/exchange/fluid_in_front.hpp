// The fluids in front of the contacts of a surface, with the energy of their mixture as a state
// will have it.
#pragma once
#include "ice/fluid_part.hpp"
#include "mpmice/exchange/exchange_terms.hpp"
#include "mpmice/exchange/surface_contacts.hpp"

namespace sluice::mpmice {

template <int D>
class FluidInFront {
 public:
  FluidInFront(const Frame<D>& frame, const ice::FluidPart& fluid);

  // Includes what they have in the scales.
  void look(const KeptArray<SurfaceContact<D>>& contacts, const CellAmounts<D>& amounts,
            ExchangeScales& most);
  std::size_t fluids() const { return fluids_; }
  // Of fluid m in front of a contact: its share of the cell (0: it has none there), temperature
  // (K), M c_v (J/(m^3 K)); of all together: M (kg/m^3), velocity (m/s).
  double share(std::size_t contact, std::size_t m) const { return share_[contact * fluids_ + m]; }
  double temperature(std::size_t contact, std::size_t m) const {
    return temperature_[contact * fluids_ + m];
  }
  double capacity(std::size_t contact, std::size_t m) const {
    return capacity_[contact * fluids_ + m];
  }
  double mass(std::size_t contact) const { return mass_[contact]; }
  double velocity(std::size_t contact, std::size_t d) const { return velocity_[contact][d]; }
  // Component of the momentum along a direction; -1: none is carried.
  int component(std::size_t d) const { return component_[d]; }
  // d_g/k_g of one fluid, over its share f of the surface, m^2 K/W; `volume`: left to the fluids of
  // its cell, `time` since the run began, s.
  double resistance(const SurfaceContact<D>& c, std::size_t contact, std::size_t m, double volume,
                    double time) const;

 private:
  void look_at(std::size_t contact, std::size_t i, const CellAmounts<D>& amounts,
               ExchangeScales& most);

  const ice::FluidPart& fluid_;
  std::size_t fluids_;
  std::array<int, D> component_{};
  KeptArray<double> share_, temperature_, capacity_, mass_;
  KeptArray<std::array<double, D>> velocity_;
};

}  // namespace sluice::mpmice
