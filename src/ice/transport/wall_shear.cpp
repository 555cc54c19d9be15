// Laws of the wall, solved for the friction velocity.
#include "ice/transport/wall_shear.hpp"

#include <cmath>

namespace sluice::ice {
namespace {

// coefficient: intercept of the logarithmic law of smooth walls; unit: 1
constexpr double intercept = 5.2;

double smooth_wall(double kappa, double speed, double y, double nu) {
  if (!(nu > 0)) return 0;  // no friction without viscosity
  // Newton from above, of a function that is convex and rises: it cannot pass the root.
  const double laminar = std::sqrt(nu * speed / y);
  const double scale = y / nu;
  double u_tau = speed;
  constexpr int most = 30;
  for (int n = 0; n < most && u_tau > laminar; ++n) {
    const double law = std::log(scale * u_tau) / kappa + intercept;
    const double next = u_tau - (u_tau * law - speed) / (law + 1.0 / kappa);
    if (!(next < u_tau)) break;
    u_tau = next;
  }
  return u_tau > laminar ? u_tau : laminar;
}

}  // namespace

double friction_velocity(const WallShear& model, double speed, double y, double nu) {
  if (speed == 0) return 0;
  if (model.smooth) return smooth_wall(model.von_karman, speed, y, nu);
  return model.von_karman * speed / std::log(y / model.roughness);
}

}  // namespace sluice::ice
