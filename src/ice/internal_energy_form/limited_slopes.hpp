// The limiter of the classic form, for one cell.
//
//   phi = min(1, max(0, (q_max - q)/(v_max - q + S)), max(0, (q - q_min)/(q - v_min + S)))
// q_max and q_min: bounds of the face neighbours without the cell itself; v_max and v_min: of the
// reconstructed values at the cell's corners; S = 1e-100 is added on either side alike, so that
// mirrored values give mirrored slopes. All slopes of the cell are scaled by the same phi. With
// compatible fluxes the deviation of a corner is weighted by rho over the corner's own density.
// q is any quantity, in its unit; slopes are per cell; phi has none.
// Limits: bounds are not kept in several dimensions, and an extremum is flattened.
// Reference: W. B. VanderHeyden and B. A. Kashiwa, Compatible fluxes for van Leer advection,
// J. Comput. Phys. 146 (1998) 1-28.
#pragma once
#include "ice/fluid/limiters.hpp"

namespace sluice::ice::internal_energy_form {

// What the fluxes of mass carry with them: the density and its limited slopes.
template <int D>
struct MassSlopes {
  double rho = 1;        // kg/m^3
  double slope[D] = {};  // kg/m^3 per cell
};

inline double limiter(double q, double low, double high, double corner_low, double corner_high) {
  // threshold: added on either side of the quotients of the limiter, so that they are 0 in
  //   uniform flow; unit: that of the variable; test: ClassicForm.KeepsUniformFlowToTheBit
  constexpr double S = 1e-100;
  const double above = larger(0.0, (high - q) / ((corner_high - q) + S));
  const double below = larger(0.0, (q - low) / ((q - corner_low) + S));
  return smaller(1.0, smaller(above, below));
}

// The factor phi of a cell with value q, neighbours low[d] and high[d] and central slopes s[d].
template <int D, bool Weighted>
double limiter_of_cell(double q, const double (&low)[D], const double (&high)[D],
                       const double (&s)[D], const MassSlopes<D>& mass) {
  double least = low[0], most = low[0], corner_least = 0, corner_most = 0;
  for (int d = 0; d < D; ++d) {
    least = smaller(least, smaller(low[d], high[d]));
    most = larger(most, larger(low[d], high[d]));
  }
  for (int corner = 0; corner < (1 << D); ++corner) {
    double deviation = 0, rho = 0;
    for (int d = 0; d < D; ++d) {
      const double sign = (corner >> d & 1) != 0 ? 0.5 : -0.5;
      deviation += sign * s[d];
      if constexpr (Weighted) rho += sign * mass.slope[d];
    }
    if constexpr (Weighted) deviation *= mass.rho / (mass.rho + rho);
    corner_least = smaller(corner_least, deviation);
    corner_most = larger(corner_most, deviation);
  }
  return limiter(q, least, most, q + corner_least, q + corner_most);
}

}  // namespace sluice::ice::internal_energy_form
