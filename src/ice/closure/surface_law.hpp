// What passes at the surface along which a rarefied gas slips, in one cell (mixture/surface.hpp).
#pragma once

namespace sluice::ice::mixture {

// What passes where `all` (the deck's coefficient) and the surface resist one after the other, in
// the share of the cell where there is a surface. `all`, `surface` and the result are coefficients
// of one unit: of momentum kg/(m^3 s), of heat W/(m^3 K).
inline double through_surface(double all, double share, double surface) {
  if (!(share > 0.0)) return all;
  const double both = surface > 0.0 && all > 0.0 ? 1.0 / (1.0 / all + 1.0 / surface) : 0.0;
  return share * both + (1.0 - share) * all;
}

// The share of a cell's surface in the cell itself, from the volume fractions of gas and solid.
inline double shared_part(double gas, double solid) {
  return 4.0 * gas * solid;
}

}  // namespace sluice::ice::mixture
