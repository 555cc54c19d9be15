// The cohesive law against its potential, its greatest tractions and its works of separation.
#include "mpm/loads/cohesive_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sluice::mpm::cohesive_law_test {
namespace {

CohesiveZone zone() {
  CohesiveZone z;
  z.sig_max = 240;
  z.tau_max = 170;
  z.delta_n = 4e-5;
  z.delta_t = 9e-5;
  z.delta_n_fail = 1.6e-4;
  z.delta_t_fail = 3.6e-4;
  return z;
}
const CohesiveFrame frame = cohesive_frame({0.6, 0.8, 0}, {-0.8, 0.6, 0});

// phi = phi_n (1 - e^{-n}(1 + n)((1 - q) + q e^{-t^2})), n = D_n/d_n, t = D_t/d_t: what opening to
// n, t takes.
double potential(const CohesiveZone& z, double n, double t) {
  const double phi_n = std::numbers::e * z.sig_max * z.delta_n;
  const double phi_t = std::sqrt(std::numbers::e / 2) * z.tau_max * z.delta_t, q = phi_t / phi_n;
  return phi_n * (1 - std::exp(-n) * (1 + n) * ((1 - q) + q * std::exp(-t * t)));
}

TEST(CohesiveLaw, IsTheGradientOfItsPotential) {
  const CohesiveZone z = zone();
  const double h = 1e-5;
  for (const double n : {-0.3, 0.0, 0.4, 1.0, 3.0})
    for (const double t : {-1.2, 0.0, 0.5, 2.0}) {
      const Vec3 f = cohesive_traction(
          z, frame, (n * z.delta_n) * frame.normal + (t * z.delta_t) * frame.first);
      const double by_n = (potential(z, n + h, t) - potential(z, n - h, t)) / (2 * h * z.delta_n);
      const double by_t = (potential(z, n, t + h) - potential(z, n, t - h)) / (2 * h * z.delta_t);
      EXPECT_NEAR(dot(f, frame.normal), by_n, 1e-7 * z.sig_max) << n << ' ' << t;  // measured 2e-8
      EXPECT_NEAR(dot(f, frame.first), by_t, 1e-7 * z.sig_max) << n << ' ' << t;
      EXPECT_NEAR(dot(f, frame.second), 0, 1e-12 * z.sig_max);
    }
}

TEST(CohesiveLaw, HasTheGreatestTractionsOfTheDeck) {
  const CohesiveZone z = zone();
  double normal = 0, shear = 0;
  for (int k = 0; k <= 4000; ++k) {
    const double x = 1e-3 * k;
    normal = std::max(normal,
                      dot(cohesive_traction(z, frame, x * z.delta_n * frame.normal), frame.normal));
    shear = std::max(shear,
                     dot(cohesive_traction(z, frame, x * z.delta_t * frame.second), frame.second));
  }
  EXPECT_NEAR(normal, z.sig_max, 1e-6 * z.sig_max);
  EXPECT_NEAR(shear, z.tau_max, 1e-6 * z.tau_max);
}

TEST(CohesiveLaw, StiffnessIsThatOfAClosedPoint) {
  const CohesiveZone z = zone();
  const double n = 1e-6 * z.delta_n, t = 1e-6 * z.delta_t;
  const double of_normal = dot(cohesive_traction(z, frame, n * frame.normal), frame.normal) / n;
  const double of_shear = dot(cohesive_traction(z, frame, t * frame.first), frame.first) / t;
  EXPECT_NEAR(cohesive_stiffness(z), std::max(of_normal, of_shear), 1e-5 * of_normal);
}

TEST(CohesiveLaw, FailsAlongEachDirection) {
  const CohesiveZone z = zone();
  EXPECT_FALSE(cohesive_failure(z, frame, 0.99 * z.delta_n_fail * frame.normal));
  EXPECT_FALSE(cohesive_failure(z, frame, -5 * z.delta_n_fail * frame.normal));
  EXPECT_TRUE(cohesive_failure(z, frame, 1.01 * z.delta_n_fail * frame.normal));
  EXPECT_TRUE(cohesive_failure(z, frame, -1.01 * z.delta_t_fail * frame.first));
  EXPECT_TRUE(cohesive_failure(z, frame, 1.01 * z.delta_t_fail * frame.second));
}

TEST(CohesiveLaw, FrameIsOrthonormalHoweverTheTangentLies) {
  const CohesiveFrame f = cohesive_frame({0, 2, 0}, {1, 1, 0});
  EXPECT_EQ(f.normal, (Vec3{0, 1, 0}));
  EXPECT_EQ(f.first, (Vec3{1, 0, 0}));
  EXPECT_EQ(f.second, cross(f.first, f.normal));
}

}  // namespace
}  // namespace sluice::mpm::cohesive_law_test
