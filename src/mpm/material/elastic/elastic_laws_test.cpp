// Closed forms of cnh_mms, comp_mooney_rivlin, ArrudaBoyce8, hypo_elastic and rigid.
#include <cmath>

#include "mpm/material/test_support/law_test_support.hpp"

namespace sluice::mpm::elastic_laws {
namespace {

constexpr double K = 6e4, G = 3e4;

TEST(LogNeoHook, UniaxialStrainAndShear) {
  const auto made =
      law("cnh_mms", "<bulk_modulus>6e4</bulk_modulus><shear_modulus>3e4</shear_modulus>");
  MaterialSample s(made, steel_constants(), 1, 298);
  const double l = 1.3, lambda = K - 2 * G / 3;
  ASSERT_EQ(s.step({l, 0, 0, 0, 1, 0, 0, 0, 1}, 1), std::nullopt);
  EXPECT_NEAR(s.stress()[0], (lambda * std::log(l) + G * (l * l - 1)) / l, 1e-11 * K);
  EXPECT_NEAR(s.stress()[1], lambda * std::log(l) / l, 1e-11 * K);
  // rho_0 c^2 = lambda (1 - ln J) + G (1 + b_max), exact for two equal stretches.
  EXPECT_NEAR(s.wave_speed(),
              std::sqrt((lambda * (1 - std::log(l)) + G * (1 + l * l)) / steel_constants().density),
              1e-12 * s.wave_speed());
}

// C1 = 1e5, C2 = 2e4, nu = .49: G = 2.4e5, K = 1.192e7 (the disks of the public decks).
TEST(MooneyRivlin, UniaxialStrainByItsEnergy) {
  const auto made =
      law("comp_mooney_rivlin",
          "<he_constant_1>1e5</he_constant_1><he_constant_2>2e4</he_constant_2><he_PR>.49</he_PR>");
  EXPECT_NEAR(made->bulk_modulus(), 1.192e7, 1);
  const double C1 = 1e5, C2 = 2e4, C3 = 7e4, nu = 0.49;
  const double C4 = 0.5 * (C1 * (5 * nu - 2) + C2 * (11 * nu - 5)) / (1 - 2 * nu);
  for (const double l : {0.7, 1.4}) {
    MaterialSample s(made, steel_constants(), 1, 298);
    ASSERT_EQ(s.step({l, 0, 0, 0, 1, 0, 0, 0, 1}, 1), std::nullopt);
    const double q = l * l;  // I1 = q + 2, I2 = 2 q + 1, I3 = q
    EXPECT_NEAR(s.energy(),
                (C1 + 2 * C2) * (q - 1) + C3 * (1 / (q * q) - 1) + C4 * (q - 1) * (q - 1),
                1e-12 * 1.2e7);
    // sigma_11 = dW/dl
    const double dW = 2 * l * (C1 + 2 * C2 - 2 * C3 / (q * q * q) + 2 * C4 * (q - 1));
    EXPECT_NEAR(s.stress()[0], dW, 1e-11 * 1.2e7);
  }
}

// Hencky's law comes out for a stretch in many steps: sigma = (K + 4/3 G) ln l.
TEST(HypoElastic, UniaxialStrainIsLogarithmic) {
  const auto made = law("hypo_elastic", "<G>3e4</G><K>6e4</K>");
  MaterialSample s(made, steel_constants(), 1, 298);
  follow(
      s, [](double t) { return Matrix{std::exp(0.3 * t), 0, 0, 0, 1, 0, 0, 0, 1}; }, 1, 100);
  EXPECT_NEAR(s.stress()[0] / ((K + 4 * G / 3) * 0.3), 1, 1e-6);  // measured 7.5e-7
}

// Simple shear under Jaumann's rate: sigma_12 = G sin g, sigma_11 = G (1 - cos g).
TEST(HypoElastic, SimpleShearOscillatesAsJaumannsRateDoes) {
  const auto made = law("hypo_elastic", "<G>3e4</G><K>6e4</K>");
  MaterialSample s(made, steel_constants(), 1, 298);
  const double g = 4;
  follow(
      s, [&](double t) { return Matrix{1, g * t, 0, 0, 1, 0, 0, 0, 1}; }, 1, 1000);
  EXPECT_NEAR(s.stress()[5] / G, std::sin(g), 1e-5);  // measured 5e-6
  EXPECT_NEAR(s.stress()[0] / G, 1 - std::cos(g), 1e-5);
}

// The plain form of the rate: dt (2 G dev D + K tr D I) with D = sym L alone.
TEST(HypoElastic, PlainFormDoesNotTurn) {
  const auto made = law("hypo_elastic", "<G>3e4</G><K>6e4</K><objective>false</objective>");
  MaterialSample s(made, steel_constants(), 1, 298);
  follow(
      s, [](double t) { return Matrix{1, 4 * t, 0, 0, 1, 0, 0, 0, 1}; }, 1, 10);
  EXPECT_NEAR(s.stress()[5], G * 4, 1e-10 * K);
  EXPECT_NEAR(s.stress()[0], 0, 1e-10 * K);
}

// Held in place and warmed: sigma = -3 K alpha dT.
TEST(HypoElastic, HeldBodyIsPressedByHeat) {
  MaterialConstants warm = steel_constants();
  warm.thermal_expansion = 1e-5;
  MaterialSample s(law("hypo_elastic", "<G>3e4</G><K>6e4</K>", warm), warm, 1, 300);
  s.set_temperature(400);
  ASSERT_EQ(s.step(identity, 1), std::nullopt);
  EXPECT_NEAR(s.pressure(), 3 * K * 1e-5 * 100, 1e-9 * K);
  ASSERT_EQ(s.step(identity, 1), std::nullopt);
  EXPECT_NEAR(s.pressure(), 3 * K * 1e-5 * 100, 1e-9 * K);
}

TEST(Rigid, HasNoStress) {
  const auto made = law("rigid", "<shear_modulus>3e4</shear_modulus>");
  EXPECT_TRUE(made->rigid());
  MaterialSample s(made, steel_constants(), 1, 298);
  ASSERT_EQ(s.step({0.5, 0.1, 0, 0, 2, 0, 0, 0, 1}, 1), std::nullopt);
  for (const double x : s.stress()) EXPECT_EQ(x, 0);
}

// x of coth x - 1/x = y
double inverse_langevin(double y) {
  double low = 0, high = 1e3;
  for (int k = 0; k < 200; ++k) {
    const double x = 0.5 * (low + high);
    const double value = x < 1e-3 ? x / 3 : 1 / std::tanh(x) - 1 / x;
    (value < y ? low : high) = x;
  }
  return low;
}

// Eight chains with the inverse Langevin function itself, stretched by l at constant volume:
// sigma_11 - sigma_22 = G [L^-1(c/beta)/c]/[L^-1(1/beta)] (l^2 - 1/l), c = (I/3)^(1/2).
TEST(ArrudaBoyce, FollowsTheInverseLangevinFunction) {
  const auto made = law("ArrudaBoyce8",
                        "<bulk_modulus>1e6</bulk_modulus><shear_modulus>3e4</shear_modulus>"
                        "<beta>3</beta>");
  for (const double l : {0.8, 1.01, 1.5, 2.0}) {
    MaterialSample s(made, steel_constants(), 1, 298);
    const double w = 1 / std::sqrt(l), chain = std::sqrt((l * l + 2 / l) / 3);
    ASSERT_EQ(s.step({l, 0, 0, 0, w, 0, 0, 0, w}, 1), std::nullopt);
    const double stiffer = inverse_langevin(chain / 3) / chain / inverse_langevin(1.0 / 3);
    EXPECT_NEAR((s.stress()[0] - s.stress()[1]) / (3e4 * stiffer * (l * l - 1 / l)), 1, 1e-3) << l;
  }
}

// The wave speed is no less than that of differences of the stress, along the stretch and across,
// and not much more.
TEST(ArrudaBoyce, WaveSpeedBoundsThoseOfItsStress) {
  const auto made = law("ArrudaBoyce8",
                        "<bulk_modulus>6e4</bulk_modulus><shear_modulus>3e4</shear_modulus>"
                        "<beta>1.67</beta>");
  const Matrix F = {1.6, 0, 0, 0, 0.8, 0, 0, 0, 0.8};
  MaterialSample s(made, steel_constants(), 1, 298);
  ASSERT_EQ(s.step(F, 1), std::nullopt);
  double fastest = 0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    // rho_0 c^2 = l_n^2 dP_nn/dF_nn, P = J sigma F^-T
    double P[2];
    const double h = 1e-5;
    for (int side = 0; side < 2; ++side) {
      Matrix moved = F;
      moved[4 * axis] += side == 0 ? -h : h;
      MaterialSample other(made, steel_constants(), 1, 298);
      ASSERT_EQ(other.step(moved, 1), std::nullopt);
      P[side] = other.volume_ratio() * other.stress()[axis] / moved[4 * axis];
    }
    const double modulus = F[4 * axis] * F[4 * axis] * (P[1] - P[0]) / (2 * h);
    fastest = std::max(fastest, std::sqrt(modulus / steel_constants().density));
  }
  EXPECT_GE(s.wave_speed(), fastest);
  EXPECT_LE(s.wave_speed(), 1.2 * fastest);  // measured 1.17
}

}  // namespace
}  // namespace sluice::mpm::elastic_laws
