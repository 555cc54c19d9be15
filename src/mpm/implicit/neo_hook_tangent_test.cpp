// The closed tangent against differences of the energy's derivative.
#include "mpm/implicit/neo_hook_tangent.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice::mpm::neo_hook_tangent_test {
namespace {

double energy(const NeoHookPoint& p) {
  const Matrix F = product(p.phi, p.before);
  const double J = determinant(F);
  double I1 = 0;
  for (const double x : F) I1 += x * x;
  return p.volume_0 * (p.bulk / 2 * ((J * J - 1) / 2 - std::log(J)) +
                       p.shear / 2 * (std::pow(J, -2.0 / 3) * I1 - 3));
}

// A is the second derivative of the energy with respect to Phi.
TEST(NeoHookTangent, IsTheSecondDerivativeOfTheEnergy) {
  NeoHookPoint p{2e6,
                 5e5,
                 3e-3,
                 {1.1, 0.2, -0.1, 0.05, 0.9, 0.3, -0.2, 0.1, 1.2},
                 {0.95, 0.1, 0.05, -0.1, 1.05, 0.2, 0.1, -0.15, 1.1}};
  double A[81];
  neo_hook_tangent(p, A);
  constexpr double nudge = 1e-4;
  const Matrix phi = p.phi;
  const auto moved = [&](std::size_t q, double by_q, std::size_t r, double by_r) {
    NeoHookPoint at = p;
    at.phi = phi;
    at.phi[q] += by_q;
    at.phi[r] += by_r;
    return energy(at);
  };
  double most = 0;
  for (const double a : A) most = std::max(most, std::fabs(a));
  for (std::size_t q = 0; q < 9; ++q)
    for (std::size_t r = 0; r < 9; ++r) {
      const double second = (moved(q, nudge, r, nudge) - moved(q, nudge, r, -nudge) -
                             moved(q, -nudge, r, nudge) + moved(q, -nudge, r, -nudge)) /
                            (4 * nudge * nudge);
      EXPECT_NEAR(A[9 * q + r], second, 1e-6 * most) << q << " " << r;
    }
}

}  // namespace
}  // namespace sluice::mpm::neo_hook_tangent_test
