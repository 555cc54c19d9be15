// Star states: Toro, 3rd ed., table 4.3 (five tests, five or six digits); wave speeds and two-gamma
// cases from independent solutions of the same equations.
#include "exact/riemann/riemann.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/error.hpp"

namespace sluice::exact::riemann_test {
namespace {

struct Star {
  const char* name;
  GasState left, right;
  double p, u, rho_left, rho_right;
};

class StarStates : public testing::TestWithParam<Star> {};

TEST_P(StarStates, MatchPublishedValues) {
  const Star& want = GetParam();
  const RiemannSolution got(want.left, want.right);
  EXPECT_NEAR(got.star_pressure(), want.p, 3e-7 * want.p + 1e-12);
  EXPECT_NEAR(got.star_velocity(), want.u, 3e-7 * std::abs(want.u) + 6e-9);
  EXPECT_NEAR(got.star_density_left(), want.rho_left, 3e-7 * want.rho_left);
  EXPECT_NEAR(got.star_density_right(), want.rho_right, 3e-7 * want.rho_right);
}

INSTANTIATE_TEST_SUITE_P(
    Published, StarStates,
    testing::Values(
        Star{"sod", {1, 0, 1}, {.125, 0, .1}, .30313018, .92745262, .42631943, .26557371},
        Star{"123", {1, -2, .4}, {1, 2, .4}, .0018938734, 0, .021852118, .021852118},
        Star{"left_blast", {1, 0, 1000}, {1, 0, .01}, 460.89379, 19.597451, .5750623, 5.9992407},
        Star{"two_shocks",
             {5.99924, 19.5975, 460.894},
             {5.99242, -6.19633, 46.0950},
             1691.647,
             8.6897744,
             14.28235,
             31.042602},
        Star{"si_units",
             {1.17682926829268, 0, 101325},
             {.117682926829268, 0, 10132.5},
             28858.983,
             285.11455,
             .47986228,
             .24058808},
        Star{"two_gamma",
             {1, 0, 2, 2},
             {.125, 0, .1, 1.4},
             .43033194,
             1.2757097,
             .46385986,
             .32537956},
        Star{"leblanc",
             {1, 0, .0666666666666667, 5. / 3},
             {1e-3, 0, 6.66666666666667e-11, 5. / 3},
             5.1557793e-4,
             .62183867,
             .054079335,
             .0039999981}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Riemann, WaveSpeedsOfSod) {
  const RiemannSolution sod({1, 0, 1}, {.125, 0, .1});
  EXPECT_NEAR(sod.left_wave().head, -1.18321596, 1e-8);
  EXPECT_NEAR(sod.left_wave().tail, -0.0702728, 1e-7);
  EXPECT_NEAR(sod.right_wave().head, 1.75215573, 1e-8);
  EXPECT_EQ(sod.right_wave().head, sod.right_wave().tail);
}

// Mass, momentum and energy pass every jump and the fan is isentropic with constant invariant.
TEST(Riemann, SampledStatesObeyTheEquations) {
  const RiemannSolution flow({1, 0.3, 1, 1.4}, {.3, -.2, .1, 1.67});
  const double shock = flow.right_wave().head;
  const GasState ahead = flow.sample(shock * (1 + 1e-12)), behind = flow.sample(shock * (1 - 1e-9));
  const auto flux = [&](const GasState& s, double out[3]) {
    const double w = s.velocity - shock, e = s.pressure / (s.gamma - 1) / s.density;
    out[0] = s.density * w;
    out[1] = s.density * w * w + s.pressure;
    out[2] = s.density * w * (e + 0.5 * w * w) + s.pressure * w;
  };
  double a[3], b[3];
  flux(ahead, a);
  flux(behind, b);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-13 * std::abs(a[k]));

  const auto fan = flow.left_wave();
  const GasState left = flow.sample(fan.head - 1);
  for (double part : {0.1, 0.5, 0.9}) {
    const double speed = fan.head + part * (fan.tail - fan.head);
    const GasState s = flow.sample(speed);
    EXPECT_NEAR(s.velocity - s.sound_speed(), speed, 1e-14);
    EXPECT_NEAR(s.pressure / std::pow(s.density, 1.4), left.pressure / std::pow(left.density, 1.4),
                1e-14);
    EXPECT_NEAR(s.velocity + 5 * s.sound_speed(), left.velocity + 5 * left.sound_speed(), 1e-13);
  }
}

TEST(Riemann, MirroredStatesGiveMirroredBits) {
  const GasState l{1, .75, 1}, r{.125, -.1, .1};
  const RiemannSolution forward(l, r);
  const RiemannSolution backward({r.density, -r.velocity, r.pressure},
                                 {l.density, -l.velocity, l.pressure});
  for (int i = -300; i <= 300; ++i) {
    const double speed = 0.0101 * i;
    const GasState a = forward.sample(speed), b = backward.sample(-speed);
    EXPECT_EQ(a.density, b.density) << speed;
    EXPECT_EQ(a.velocity, -b.velocity) << speed;
    EXPECT_EQ(a.pressure, b.pressure) << speed;
  }
}

TEST(Riemann, VacuumOpensBetweenGasesThatPartFastEnough) {
  const double c = std::sqrt(1.4 * .4), limit = 5 * c;  // 2c/(g-1) each side
  EXPECT_FALSE(RiemannSolution({1, -limit * .999, .4}, {1, limit * .999, .4}).vacuum());
  const RiemannSolution torn({1, -5, .4}, {1, 5, .4});
  ASSERT_TRUE(torn.vacuum());
  EXPECT_EQ(torn.sample(0).density, 0);
  EXPECT_NEAR(torn.right_wave().tail, 5 - limit, 1e-14);
  EXPECT_GT(torn.sample(5 - .5 * limit).density, 0);
  EXPECT_EQ(torn.sample(5 + c).density, 1);
  EXPECT_EQ(torn.sample(-5 - c).density, 1);
}

// Toro section 4.6.1: gas runs into a void at 2c/(g-1).
TEST(Riemann, GasRunsIntoTheVoid) {
  const RiemannSolution right_void({1, 0, 1}, {0, 0, 0});
  const double c = std::sqrt(1.4);
  EXPECT_NEAR(right_void.left_wave().tail, 5 * c, 1e-14);
  EXPECT_GT(right_void.sample(4.9 * c).density, 0);
  EXPECT_EQ(right_void.sample(5.1 * c).density, 0);
  const RiemannSolution left_void({0, 0, 0}, {1, 0, 1});
  for (double s : {-5.1, -3., -.5, .2, 1.3}) {
    EXPECT_EQ(left_void.sample(s * c).density, right_void.sample(-s * c).density);
  }
}

TEST(Riemann, ColdGasIsShockedAndSignalsAreSmallWhenJumpsAre) {
  const RiemannSolution cold({1, 1, 0}, {1, -1, 0});  // two infinitely strong shocks
  EXPECT_NEAR(cold.star_density_left(), 6, 1e-13);
  EXPECT_NEAR(cold.star_pressure(), 1.2, 1e-13);  // (g+1)/2 rho u^2
  const RiemannSolution weak({1, 0, 1 + 1e-10}, {1, 0, 1});
  EXPECT_NEAR(weak.star_velocity(), .5e-10 / std::sqrt(1.4), 1e-16);
}

TEST(Riemann, RefusesStatesThatAreNoGas) {
  EXPECT_THROW(RiemannSolution({-1, 0, 1}, {1, 0, 1}), InputError);
  EXPECT_THROW(RiemannSolution({1, 0, 1}, {1, 0, -1}), InputError);
  EXPECT_THROW(RiemannSolution({1, 0, 1, 1.0}, {1, 0, 1}), InputError);
}

}  // namespace
}  // namespace sluice::exact::riemann_test
