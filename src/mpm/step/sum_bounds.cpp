#include "mpm/step/sum_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/shape/second_moment.hpp"

namespace sluice::mpm {

SumUnits sum_units(const MpmScene& solids, const NodeBoundary& boundary,
                   const LevelSpacings& spacings, const Body& body, int kind, const KindRates& r,
                   double tension) {
  SumUnits u;
  if (!r.any()) return u;
  double slopes = 0, reach = 0;  // sum of 1/h; farthest node of a stencil
  for (int a = 0; a < body.grid.count; ++a) {
    const int d = body.grid.active[static_cast<std::size_t>(a)];
    slopes += 1 / spacings.finest[d];
    reach += 2 * spacings.coarsest[d];
  }
  if (by_corners(solids.basis)) reach *= 1 + r.extent;
  if (by_corners(solids.basis) || solids.total_lagrangian) slopes = r.slope;
  u.reference = r.middle();
  // The images of a mirror have the opposite velocity; rigid bodies keep their own to the bit.
  for (int d = 0; d < 3; ++d)
    if (boundary.mirrored(d, kind) || body.material->rigid) u.reference[d] = 0;
  double spread = r.spread();
  for (int d = 0; d < 3; ++d)
    if (u.reference[d] == 0) spread = std::max({spread, std::fabs(r.up[d]), std::fabs(r.down[d])});
  u.mass = scale_for(r.mass);
  u.momentum = scale_for(r.mass * (spread + r.affine * reach));
  u.force = scale_for((r.tension + tension) * slopes + body.most_force);
  return u;
}

EnergyUnits energy_units(const MpmScene& solids, const Level& level, const Body& body, bool heats) {
  const double energy = std::max(body.rates.most_kinetic(), body.rates.energy);
  const double capacity = heats ? body.material->constants.specific_heat : 0;
  constexpr double usual_change = 1;  // of a temperature in a step, K
  EnergyUnits units = {energy_unit(body.rates.mass),
                       energy_unit(energy),
                       energy_unit(body.rates.mass * capacity * usual_change),
                       capacity,
                       {}};
  for (int d = 0; d < 3; ++d)
    if (level.active[static_cast<std::size_t>(d)])
      units.moment[d] = level.spacing[d] * level.spacing[d] *
                        second_moment(solids.basis, body.grid.half[static_cast<std::size_t>(d)]);
  return units;
}

}  // namespace sluice::mpm
