#include "mpm/implicit/neo_hook_tangent.hpp"

#include <cmath>

namespace sluice::mpm {

void neo_hook_tangent(const NeoHookPoint& p, double* A) {
  const Matrix F = product(p.phi, p.before), F0_T = transposed(p.before),
               h = transposed(inverse(p.phi)), f = product(F, F0_T), b = product(p.before, F0_T);
  const double J = determinant(F), root = std::cbrt(J), g = p.shear / (root * root);
  double I1 = 0;
  for (const double x : F) I1 += x * x;
  const double V0 = p.volume_0, of_hh = V0 * (p.bulk * J * J + 2.0 / 9 * g * I1),
               of_crossed = V0 * (g * I1 / 3 - 0.5 * p.bulk * (J * J - 1)),
               of_fh = -2.0 / 3 * V0 * g, of_b = V0 * g;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double hij = h[3 * i + j], from_h = of_hh * hij + of_fh * f[3 * i + j],
                   from_f = of_fh * hij;
      double* row = A + 9 * (3 * i + j);
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t m = 0; m < 3; ++m)
          row[3 * k + m] = from_h * h[3 * k + m] + from_f * f[3 * k + m] +
                           of_crossed * h[3 * i + m] * h[3 * k + j] +
                           (i == k ? of_b * b[3 * j + m] : 0);
    }
}

}  // namespace sluice::mpm
