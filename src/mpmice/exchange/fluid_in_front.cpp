#include "mpmice/exchange/fluid_in_front.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpmice {

template <int D>
FluidInFront<D>::FluidInFront(const Frame<D>& frame, const ice::FluidPart& fluid)
    : fluid_(fluid), fluids_(fluid.options().materials.fluids.size()) {
  component_.fill(-1);
  const ice::SchemeOptions& o = fluid.options();
  for (int k = 0; k < o.grid.components; ++k)
    for (std::size_t d = 0; d < D; ++d)
      if (o.grid.direction[static_cast<std::size_t>(k)] == frame.direction[d]) component_[d] = k;
}

template <int D>
void FluidInFront<D>::look(const KeptArray<SurfaceContact<D>>& contacts,
                           const CellAmounts<D>& amounts, ExchangeScales& most) {
  share_.assign(contacts.size() * fluids_, 0);
  temperature_ = capacity_ = share_;
  mass_.assign(contacts.size(), 0);
  velocity_.assign(contacts.size(), {});
  for (std::size_t n = 0; n < contacts.size(); ++n) look_at(n, contacts[n].fluid, amounts, most);
}

template <int D>
void FluidInFront<D>::look_at(std::size_t contact, std::size_t i, const CellAmounts<D>& amounts,
                              ExchangeScales& most) {
  const std::vector<ice::Fluid>& fluids = fluid_.options().materials.fluids;
  const double all = amounts.mass_of_all(i), rest = amounts.kinetic[i] - amounts.moving(i);
  double filled = 0;
  for (std::size_t m = 0; m < fluids_; ++m) filled += std::max(amounts.filled[m][i], 0.0);
  for (std::size_t m = 0; m < fluids_; ++m) {
    const double M = amounts.mass[m][i], V = amounts.filled[m][i];
    if (!(M > 0) || !(V > 0)) continue;
    const double rho = M / V, rho_e = (amounts.energy[m][i] + rest * (M / all)) / V;
    if (!fluids[m].admissible(rho, rho_e)) continue;
    const std::size_t at = contact * fluids_ + m;
    share_[at] = V / filled;
    temperature_[at] = fluids[m].temperature(rho, rho_e);
    capacity_[at] = M * fluids[m].heat_capacity(rho, rho_e);
    most.temperature = std::max(most.temperature, std::fabs(temperature_[at]));
    most.fluid_capacity = std::max(most.fluid_capacity, capacity_[at]);
  }
  mass_[contact] = all;
  most.fluid_mass = std::max(most.fluid_mass, all);
  for (std::size_t d = 0; d < D; ++d) {
    if (component_[d] < 0) continue;
    const double u = amounts.momentum[static_cast<std::size_t>(component_[d])][i] / all;
    velocity_[contact][d] = u;
    most.speed = std::max(most.speed, std::fabs(u));
  }
}

template <int D>
double FluidInFront<D>::resistance(const SurfaceContact<D>& c, std::size_t contact, std::size_t m,
                                   double volume, double time) const {
  const double k = fluid_.options().transport.conductivities[m];
  if (!(k > 0)) return 0;
  const double f = share(contact, m), C = capacity(contact, m);
  const double reach = reach_of_heat(k, C / (f * volume), time);
  return std::min(c.to_fluid, reach) / (f * k);
}

template class FluidInFront<1>;
template class FluidInFront<2>;
template class FluidInFront<3>;

}  // namespace sluice::mpmice
