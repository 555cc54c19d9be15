// Second moments of shape functions, by the width of the basis.
#pragma once
#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

// h^2 over the second moment of the shape functions of a spline, wherever a particle is: a ratio.
constexpr double second_moment_factor(Basis basis) {
  return basis == Basis::cubic ? 3.0 : 4.0;
}

// In units of h^2. Of a hat averaged over a particle of half width l cells, in the mean over its
// places, h^2; with l = 1/2 that of the quadratic spline wherever it is. Corners stand l away.
constexpr double second_moment(Basis basis, double l) {
  if (basis == Basis::quadratic || basis == Basis::cubic) return 1 / second_moment_factor(basis);
  const bool corners = basis == Basis::cpdi || basis == Basis::fast_cpdi || basis == Basis::cpti ||
                       basis == Basis::carried;
  return 1.0 / 6 + (corners ? l * l : l * l / 3);
}

}  // namespace sluice::mpm
