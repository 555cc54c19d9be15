// Diffusion rates of rows of cells.
#include "ice/mixture/diffusion_rates.hpp"

#include "ice/closure/contacts.hpp"
#include "ice/step/end_of_step.hpp"

namespace sluice::ice::mixture {
namespace {

// The vapour of a torn liquid fills much and weighs nothing: it takes what it can bear, too.
bool limits_the_step(double mass, double volume, double total_mass) {
  return volume >= 1.0 || (volume >= min_limiting_share && mass >= min_limiting_mass * total_mass);
}

}  // namespace

DiffusionRates::DiffusionRates(const SchemeOptions& o)
    : fluids_(o.materials.fluids),
      viscosities_(o.transport.viscosities),
      conductivities_(o.transport.conductivities),
      axes_(o.grid.axes),
      multi_velocity_(o.materials.multi_velocity),
      viscous_(o.transport.viscous),
      conducting_(o.transport.conducting),
      viscosity_varies_(o.transport.viscous &&
                        (o.own_viscosity_varies() || o.transport.models.turbulence)),
      conductivity_varies_(o.transport.conductivity_varies) {}

double DiffusionRates::largest(const MaterialRows& s, int n, const Vec3& spacing) const {
  double inverse_dx2 = 0;
  for (int a = 0; a < axes_.count; ++a) {
    const double inverse = 1.0 / spacing[axes_.direction[a]];
    inverse_dx2 += inverse * inverse;
  }
  const double twice = 2.0 * inverse_dx2;
  double most = 0;
  for (int i = 0; viscous_ && i < n; ++i) {
    double rho = 0, mu = 0;
    for (std::size_t m = 0; m < fluids_.size(); ++m) {
      rho += s.mass[m][i];
      mu += s.volume[m][i] * viscosities_[m];
    }
    if (viscosity_varies_) mu = s.viscosity[i];
    most = larger(most, twice * mu / rho);
    for (std::size_t m = 0; multi_velocity_ && m < fluids_.size(); ++m) {
      const double V = s.volume[m][i], M = s.mass[m][i];
      if (limits_the_step(M, V, rho)) most = larger(most, twice * viscosities_[m] * V / M);
    }
  }
  const auto total_mass = [&](int i) {
    double sum = 0;
    for (std::size_t m = 0; m < fluids_.size(); ++m) sum += s.mass[m][i];
    return sum;
  };
  for (std::size_t m = 0; m < fluids_.size(); ++m) {
    if (!(conducting_ && (conductivity_varies_ || conductivities_[m] > 0.0))) continue;
    for (int i = 0; i < n; ++i) {
      const double k = conductivity_varies_ ? s.conductivity[m][i] : conductivities_[m];
      const double V = s.volume[m][i];
      if (!limits_the_step(s.mass[m][i], V, total_mass(i))) continue;
      const double rho = s.mass[m][i] / V;
      const double cv = constant_heat_capacity(fluids_[m])
                            ? fluids_[m].specific_heat
                            : fluids_[m].heat_capacity(rho, s.energy[m][i] / V);
      most = larger(most, twice * k / cv / rho);
    }
  }
  return most;
}

}  // namespace sluice::ice::mixture
