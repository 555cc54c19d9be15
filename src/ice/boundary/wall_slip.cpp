// The velocity of slip.
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

}  // namespace sluice::ice
