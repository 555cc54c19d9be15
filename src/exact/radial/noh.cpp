#include "exact/radial/noh.hpp"

#include <cmath>

#include "exact/base/symmetry.hpp"

namespace sluice::exact {

double Noh::plateau_density() const {
  const double compression = (inflow_.gamma + 1) / (inflow_.gamma - 1);
  return inflow_.density * std::pow(compression, inflow_.dimension);
}

double Noh::plateau_pressure() const {
  return 0.5 * (inflow_.gamma - 1) * plateau_density() * inflow_.speed * inflow_.speed;
}

State Noh::at(Vec3 x, double t) const {
  const RadialPoint point = radial_point(x - inflow_.origin, inflow_.dimension, inflow_.axis);
  if (point.r < shock_radius(t)) return {plateau_density(), {}, plateau_pressure(), inflow_.gamma};
  const double squeeze = inflow_.dimension == 1 || t == 0
                             ? 1.0
                             : std::pow(1 + inflow_.speed * t / point.r, inflow_.dimension - 1);
  return {inflow_.density * squeeze, point.outward * -inflow_.speed, inflow_.pressure,
          inflow_.gamma};
}

}  // namespace sluice::exact
