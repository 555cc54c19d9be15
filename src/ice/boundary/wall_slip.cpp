// Velocity and temperature of slip.
#include "ice/boundary/wall_slip.hpp"

#include <cmath>
#include <numbers>

namespace sluice::ice {
namespace {

// C of lambda^2 u''; reflection: (2 - a)/a.
double second_coefficient(SlipSettings::Model model, double reflection) {
  switch (model) {
    case SlipSettings::Model::first_order:
      return 0.0;
    case SlipSettings::Model::deissler:
      return 9.0 / 8.0;
    case SlipSettings::Model::karniadakis_beskok:
      return -0.5 * reflection;
  }
  return 0.0;
}

}  // namespace

double mean_free_path(double viscosity, double rho, double p) {
  return viscosity * std::sqrt(0.5 * std::numbers::pi / (rho * p));
}

double slip_velocity(const SlipSettings& settings, const SlipCell& cell, bool creep) {
  const double a = settings.momentum_accommodation, reflection = (2.0 - a) / a;
  const double lambda = mean_free_path(cell.viscosity, cell.rho, cell.p);
  const double weight = 2.0 * lambda * reflection / cell.spacing;  // of u - u_s in L u'
  double known = cell.wall_velocity - second_coefficient(settings.model, reflection) * lambda *
                                          lambda * cell.pull / cell.viscosity;
  if (creep) known += 0.75 * cell.viscosity / (cell.rho * cell.temperature) * cell.warming;
  return (known + weight * cell.velocity) / (1.0 + weight);
}

double slip_temperature(const SlipSettings& settings, const SlipHeat& cell) {
  if (!(cell.viscosity > 0)) return cell.wall_temperature;
  const double a = settings.thermal_accommodation;
  const double gamma = 1.0 + cell.p / (cell.rho * cell.temperature * cell.specific_heat);
  const double in_cell = mean_free_path(cell.viscosity, cell.rho, cell.p);
  const double per_path = (2.0 - a) / a * 2.0 * cell.conductivity /
                          ((gamma + 1.0) * cell.specific_heat * cell.viscosity);
  double second = 0;
  if (settings.model == SlipSettings::Model::deissler)
    second = 9.0 / 128.0 * (177.0 * gamma - 145.0) / (gamma + 1.0);
  if (settings.model == SlipSettings::Model::karniadakis_beskok) second = -0.5 * per_path;
  const double curvature = -cell.viscosity / cell.conductivity * cell.shear;
  double T = cell.temperature;
  // The mean free path is that of T itself; each pass gains two digits.
  for (int pass = 0; pass < 4; ++pass) {
    const double lambda = in_cell * std::sqrt(T / cell.temperature);
    const double weight = 2.0 * lambda * per_path / cell.spacing;
    T = (cell.wall_temperature - second * lambda * lambda * curvature + weight * cell.temperature) /
        (1.0 + weight);
  }
  return T;
}

}  // namespace sluice::ice
