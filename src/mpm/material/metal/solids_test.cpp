// Closed forms and paths of MohrCoulomb, visco_scram and the fibre-reinforced rubbers.
#include <cmath>

#include "mpm/material/test_support/law_test_support.hpp"

namespace sluice::mpm::solids {
namespace {

// Triaxial compression under a held lateral strain: on the cone, sigma_1/sigma_3 by friction.
TEST(MohrCoulomb, StandsOnItsCone) {
  const double c = 2e5, phi = 30 * 3.14159265358979323846 / 180;
  MaterialSample s(law("MohrCoulomb", "<K>1.3e7</K><G>1e7</G><c>2e5</c><Phi>30</Phi><Psi>5</Psi>"),
                   steel_constants(), 1, 298);
  follow(
      s,
      [](double t) { return Matrix{std::exp(-0.1 * t), 0, 0, 0, std::exp(0.06 * t), 0, 0, 0, 1}; },
      1, 100);
  const Principal p = principal(s.stress());
  const double f = (p.values[2] - p.values[0]) + (p.values[2] + p.values[0]) * std::sin(phi);
  EXPECT_NEAR(f / (2 * c * std::cos(phi)), 1, 1e-9);
  EXPECT_GT(s.history(0), 0.01);
}

// Uniaxial strain of a body without dilatancy, cohesion only (Tresca): sigma_1 - sigma_3 = 2 c.
TEST(MohrCoulomb, IsTrescaWithoutFriction) {
  MaterialSample s(law("MohrCoulomb", "<K>1.3e7</K><G>1e7</G><c>2e5</c><Phi>0</Phi>"),
                   steel_constants(), 1, 298);
  follow(
      s, [](double t) { return Matrix{std::exp(-0.1 * t), 0, 0, 0, 1, 0, 0, 0, 1}; }, 1, 50);
  EXPECT_NEAR(s.stress()[1] - s.stress()[0], 4e5, 1e-3);
  EXPECT_NEAR(s.stress()[1], s.stress()[2], 1e-3);  // on the edge
  EXPECT_NEAR(s.pressure(), 1.3e7 * 0.1, 10);       // third order of the logarithm
}

// Pulled apart: the apex c cot phi in all directions.
TEST(MohrCoulomb, PullsToItsApex) {
  MaterialSample s(law("MohrCoulomb", "<K>1.3e7</K><G>1e7</G><c>2e5</c><Phi>30</Phi>"),
                   steel_constants(), 1, 298);
  follow(
      s, [](double t) { return Matrix{1 + t, 0, 0, 0, 1 + 0.9 * t, 0, 0, 0, 1 + 0.8 * t}; }, 0.2,
      20);
  const double apex = 2e5 / std::tan(3.14159265358979323846 / 6);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(s.stress()[k], apex, 1e-6 * apex);
}

const std::string scram =
    "<PR>.3</PR><CrackParameterA>1e-3</CrackParameterA><CrackPowerValue>10</CrackPowerValue>"
    "<StressIntensityF>5e5</StressIntensityF><CrackFriction>.35</CrackFriction>"
    "<CrackGrowthRate>12</CrackGrowthRate><G1>0</G1><G2>1e8</G2><G3>0</G3><G4>3e8</G4><G5>0</G5>"
    "<RTau1>0</RTau1><RTau2>7e3</RTau2><RTau3>0</RTau3><RTau4>7e4</RTau4><RTau5>0</RTau5>";

// Held after a step of shear: each element decays with its own time (Maxwell).
TEST(ViscoScram, RelaxesAsMaxwell) {
  MaterialSample s(law("visco_scram", scram + "<CrackMaxGrowthRate>0</CrackMaxGrowthRate>"
                                              "<InitialCrackRadius>0</InitialCrackRadius>"),
                   steel_constants(), 1, 298);
  const double g = 1e-3;
  ASSERT_EQ(s.step({1, g, 0, 0, 1, 0, 0, 0, 1}, 1e-12), std::nullopt);
  EXPECT_NEAR(s.stress()[5] / (4e8 * g), 1, 1e-6);
  const double end = 5e-5;
  follow(
      s, [&](double) { return Matrix{1, g, 0, 0, 1, 0, 0, 0, 1}; }, end, 20);
  const double expected = g * (1e8 * std::exp(-7e3 * end) + 3e8 * std::exp(-7e4 * end));
  EXPECT_NEAR(s.stress()[5] / expected, 1, 1e-3);  // RK4 in half relaxation times
}

// Cracks of radius a halve the stiffness: 1/(1 + (c/a)^3).
TEST(ViscoScram, CracksSoften) {
  MaterialSample s(law("visco_scram", scram + "<CrackMaxGrowthRate>0</CrackMaxGrowthRate>"
                                              "<InitialCrackRadius>1e-3</InitialCrackRadius>"),
                   steel_constants(), 1, 298);
  ASSERT_EQ(s.step({1, 1e-6, 0, 0, 1, 0, 0, 0, 1}, 1e-12), std::nullopt);
  EXPECT_NEAR(s.stress()[5] / (0.5 * 4e8 * 1e-6), 1, 1e-5);
}

TEST(ViscoScram, CracksGrowNoFasterThanTheirGreatestSpeed) {
  MaterialSample s(law("visco_scram", scram + "<CrackMaxGrowthRate>300</CrackMaxGrowthRate>"
                                              "<InitialCrackRadius>3e-5</InitialCrackRadius>"),
                   steel_constants(), 1, 298);
  const double end = 1e-6;
  follow(
      s, [](double t) { return Matrix{1 + 5e4 * t, 0, 0, 0, 1, 0, 0, 0, 1}; }, end, 100);
  EXPECT_GT(s.history(0), 4e-5);
  EXPECT_LE(s.history(0), 3e-5 + 300 * end);
}

const std::string tendon =
    "<bulk_modulus>1e7</bulk_modulus><c1>2e3</c1><c2>0</c2><c3>1e3</c3><c4>10</c4><c5>4e4</c5>"
    "<fiber_stretch>1.2</fiber_stretch><direction_of_symm>[2,0,0]</direction_of_symm>";

// Isochoric stretch l along the fibres: sigma_11 - sigma_22 = 2 c1 (l^2 - 1/l) + l W_f'.
TEST(FibreRubber, StretchAlongTheFibres) {
  for (const double l : {0.9, 1.1, 1.4}) {
    MaterialSample s(law("trans_iso_hyper", tendon), steel_constants(), 1, 298);
    const double w = 1 / std::sqrt(l);
    ASSERT_EQ(s.step({l, 0, 0, 0, w, 0, 0, 0, w}, 1), std::nullopt);
    const double c6 = 1e3 * std::expm1(10 * 0.2) - 4e4 * 1.2;
    const double fibre = l <= 1 ? 0 : l < 1.2 ? 1e3 * std::expm1(10 * (l - 1)) : 4e4 * l + c6;
    EXPECT_NEAR(s.stress()[0] - s.stress()[1], 4e3 * (l * l - 1 / l) + fibre, 1e-8 * 1e7);
    EXPECT_NEAR(s.history(0), l, 1e-14);
  }
}

TEST(FibreRubber, FailedFibresBearNothing) {
  MaterialSample s(law("trans_iso_hyper", tendon + "<failure_option>1</failure_option>"
                                                   "<max_fiber_strain>1.3</max_fiber_strain>"
                                                   "<max_matrix_strain>5</max_matrix_strain>"),
                   steel_constants(), 1, 298);
  const auto stretched = [](double l) {
    return Matrix{l, 0, 0, 0, 1 / std::sqrt(l), 0, 0, 0, 1 / std::sqrt(l)};
  };
  ASSERT_EQ(s.step(stretched(1.35), 1), std::nullopt);
  EXPECT_EQ(s.history(1), 2);
  const double kept = s.energy();
  ASSERT_EQ(s.step(stretched(1.2), 1), std::nullopt);
  EXPECT_NEAR(s.stress()[0] - s.stress()[1], 4e3 * (1.44 - 1 / 1.2), 1e-8 * 1e7);
  EXPECT_LT(s.energy(), kept);
}

// A share y of the deviator relaxes with its time: sigma(t) = (1 + y e^(-t/t_k)) sigma_elastic.
TEST(FibreRubber, RelaxesByItsShares) {
  MaterialSample s(law("visco_trans_iso_hyper", tendon + "<y1>.5</y1><t1>.1</t1>"
                                                         "<y3>.25</y3><t3>2</t3>"),
                   steel_constants(), 1, 298);
  const Matrix sheared = {1, 0.3, 0, 0, 1, 0, 0, 0, 1};
  ASSERT_EQ(s.step(sheared, 1e-9), std::nullopt);
  const double elastic = 4e3 * 0.3;
  EXPECT_NEAR(s.stress()[5] / (1.75 * elastic), 1, 1e-6);
  follow(
      s, [&](double) { return sheared; }, 0.2, 7);
  EXPECT_NEAR(s.stress()[5] / (elastic * (1 + 0.5 * std::exp(-2) + 0.25 * std::exp(-0.1))), 1,
              1e-6);
}

}  // namespace
}  // namespace sluice::mpm::solids
