// Roots and logarithms of batches against the library, objective steps against rotations.
#include "mpm/material/base/batch_math.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mpm/material/base/objective_step.hpp"
#include "mpm/material/single_particle.hpp"

namespace sluice::mpm::batch_math {
namespace {

TEST(BatchMath, InverseCubeRootIsTheLibrarys) {
  double worst = 0;
  for (double x = 1e-6; x < 1e6; x *= 1.0007)
    worst = std::max(worst, std::abs(inverse_cube_root(x) * std::cbrt(x) - 1));
  EXPECT_LE(worst, 6e-16);  // measured 4.4e-16
  EXPECT_EQ(inverse_cube_root(1.0), 1.0);
}

TEST(BatchMath, LogarithmsOfTheVolume) {
  double worst_ln = 0, worst_energy = 0;
  for (double J = 1e-4; J < 1e4; J *= 1.0007) {
    const long double exact = std::log(static_cast<long double>(J));
    const long double d = static_cast<long double>(J) - 1;
    const long double energy = d + 0.5L * d * d - std::log1p(d);
    const VolumeLogs logs = volume_logs(J);
    worst_ln = std::max(worst_ln, std::abs(static_cast<double>((logs.ln - exact) / exact)));
    worst_energy =
        std::max(worst_energy, std::abs(static_cast<double>((logs.energy - energy) / energy)));
  }
  EXPECT_LE(worst_ln, 1e-15);      // measured 4e-16
  EXPECT_LE(worst_energy, 1e-14);  // measured 2e-15
  EXPECT_EQ(volume_logs(1).energy, 0);
  // (J^2 - 1)/2 - ln J = d^2 - d^3/3 + ..., J = 1 + d
  EXPECT_NEAR(volume_logs(1 + 0x1p-30).energy / 0x1p-60, 1, 1e-8);
}

TEST(BatchMath, ReachIsTheLargestEigenvalueOfTwoEqualOnes) {
  // Uniaxial: eigenvalues 5, 1, 1 in turned axes.
  const Matrix R = rotation({1, 2, 3}, 0.7);
  const std::array<double, 6> S = pushed(std::array<double, 6>{5, 1, 1, 0, 0, 0}, R);
  const double mean = (S[0] + S[1] + S[2]) / 3;
  EXPECT_NEAR(mean + eigenvalue_reach(S, mean), 5, 1e-14);
}

// A step of pure rotation has no strain and turns by just that rotation, however far.
TEST(ObjectiveStep, RotationsAreExact) {
  for (const double angle : {1e-3, 0.4, 1.5, 3.0}) {
    const Matrix Q = rotation({2, -1, 0.5}, angle);
    const double dt = 0.25;
    Matrix L = Q;
    for (std::size_t k = 0; k < 9; ++k) L[k] = (L[k] - identity[k]) / dt;
    const ObjectiveStep move = objective_step(L, dt);
    const double round_off = 1e-15 / (std::cos(angle / 2) * std::cos(angle / 2));  // of M^-1
    const Matrix turned = product(move.half_turn, move.half_turn);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(move.strain[k], 0, round_off);
    for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(turned[k], Q[k], round_off);
  }
}

// Without rotation: the strain 2 (lambda - 1)/(lambda + 1), of third order from ln lambda.
TEST(ObjectiveStep, StretchGivesItsLogarithm) {
  const ObjectiveStep move = objective_step(Matrix{0.2, 0, 0, 0, 0, 0, 0, 0, -0.1}, 1);
  EXPECT_NEAR(move.strain[0], 2 * 0.2 / 2.2, 1e-15);
  EXPECT_NEAR(move.strain[2], -2 * 0.1 / 1.9, 1e-15);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(move.half_turn[k], identity[k]);
}

// F = R U with R a rotation and U symmetric, eight together as each alone.
TEST(Polar, OfEightHasTheBitsOfEachAndTurnsAsItShould) {
  std::array<Eight, 9> all{};
  std::array<Matrix, 8> F, Q;
  for (std::size_t l = 0; l < 8; ++l) {
    const double s = 0.3 * static_cast<double>(l);
    Q[l] = rotation({1, s, -0.5}, 0.7 * s);
    const Matrix U = full(Symmetric{1.2 + s, 0.9, 1.1, 0.1, -0.05 * s, 0.2});
    F[l] = product(Q[l], U);
    for (std::size_t m = 0; m < 9; ++m) all[m][l] = F[l][m];
  }
  const PolarOf<Eight> together = polar(all);
  for (std::size_t l = 0; l < 8; ++l) {
    const Polar alone = polar(F[l]);
    for (std::size_t m = 0; m < 9; ++m) {
      EXPECT_EQ(together.R[m][l], alone.R[m]);
      EXPECT_NEAR(alone.R[m], Q[l][m], 1e-14);
    }
    for (std::size_t m = 0; m < 6; ++m) EXPECT_EQ(together.U[m][l], alone.U[m]);
  }
}

}  // namespace
}  // namespace sluice::mpm::batch_math
