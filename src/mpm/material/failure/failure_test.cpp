// Damage and erosion on paths where particles fail at known places.
#include "mpm/material/failure/failure.hpp"

#include <cmath>

#include "mpm/material/failure/damage.hpp"
#include "mpm/material/test_support/law_test_support.hpp"

namespace sluice::mpm::failure {
namespace {

const std::string elastic = "<bulk_modulus>6e4</bulk_modulus><shear_modulus>3e4</shear_modulus>";
std::string threshold(const std::string& criterion, const std::string& mean,
                      const std::string& more = "<failure_distrib>constant</failure_distrib>") {
  return "<damage_model type=\"Threshold\"><failure_mean>" + mean + "</failure_mean>" + more +
         "<failure_criteria>" + criterion + "</failure_criteria></damage_model>";
}
std::string erosion(const std::string& algorithm, const std::string& inside = "") {
  return "<erosion algorithm=\"" + algorithm + "\">" + inside + "</erosion>";
}
Matrix stretched(double l) {
  return {l, 0, 0, 0, 1, 0, 0, 0, 1};
}

// Bounds against the eigenvalues themselves: what is told to be far fails by no criterion, and most
// of what is sound is far.
TEST(Damage, ParticlesFarFromAThresholdDoNotFail) {
  std::uint64_t state = 5;
  const auto random = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) * 0x1p-52 - 1;  // -1 to 1
  };
  DamageConstants c;
  c.form = DamageForm::threshold;
  const double friction = 0.5;
  c.sine = std::sin(friction);
  c.cosine = std::cos(friction);
  c.cutoff = 0.8;
  for (const Criterion criterion :
       {Criterion::principal_stress, Criterion::principal_strain, Criterion::mohr_coulomb}) {
    c.criterion = criterion;
    int sound = 0, far = 0;
    for (int n = 0; n < 50; ++n) {
      const double size = std::exp(2 * random());
      std::array<Eight, 6> stresses{};
      std::array<Eight, 9> deformations{};
      bool all_far = true;
      for (std::size_t l = 0; l < 8; ++l) {
        Symmetric stress;
        Matrix F = identity;
        for (double& x : stress) x = 0.6 * size * random();
        for (double& x : F) x += 0.3 * size * random();
        for (std::size_t m = 0; m < 6; ++m) stresses[m][l] = stress[m];
        for (std::size_t m = 0; m < 9; ++m) deformations[m][l] = F[m];
        const std::array<double, 3> s = principal(stress).values;
        const double b = principal(symmetric(product(F, transposed(F)))).values[2];
        const double limit = criterion == Criterion::principal_strain ? 0.3 : 1.0;
        const bool fails = criterion == Criterion::principal_stress ? s[2] > limit
                           : criterion == Criterion::principal_strain
                               ? 0.5 * (1 - 1 / b) > limit
                               : s[2] > c.cutoff || 0.5 * (s[2] - s[0]) >
                                                        std::cos(friction) - 0.5 * (s[2] + s[0]) *
                                                                                 std::sin(friction);
        const bool is_far = far_from_failing(c, limit, stress, F);
        EXPECT_FALSE(is_far && fails);
        EXPECT_EQ(failed_by_threshold(c, limit, stress, F) != 0, fails);
        sound += fails ? 0 : 1;
        far += is_far ? 1 : 0;
        all_far = all_far && is_far;
      }
      const double limit = criterion == Criterion::principal_strain ? 0.3 : 1.0;
      EXPECT_EQ(far_from_failing(c, Eight{} + limit, stresses, deformations), all_far);
    }
    EXPECT_GT(sound, 100);
    EXPECT_LT(sound, 400);
    EXPECT_GT(far, sound / 2);
  }
}

// OFHC copper, strain at failure 2.6203 at mean/equivalent = 1/3, 1e4/s, T* = 0.
TEST(Damage, JohnsonCookAndHancockMackenzie) {
  DamageConstants c;
  c.form = DamageForm::johnson_cook;
  c.D1 = 0.54;
  c.D2 = 4.89;
  c.D3 = -3.03;
  c.D4 = 0.014;
  c.D5 = 1.12;
  c.room = 294;
  c.melt = 1356;
  const Symmetric pulled = {1e8, 0, 0, 0, 0, 0};  // a bar in tension: 1/3
  EXPECT_NEAR(triaxiality(pulled), 1.0 / 3, 1e-14);
  EXPECT_NEAR(1 / (more_damage(c, pulled, 1e-3, 1e4, 294) / 1e-3), 2.6203, 1e-4);
  EXPECT_NEAR(triaxiality({1e9, 1e9, 1.01e9, 0, 0, 0}), 1.5, 1e-14);  // no more
  c.form = DamageForm::hancock_mackenzie;
  EXPECT_NEAR(more_damage(c, pulled, 1e-3, 1e4, 294), 1e-3 * std::exp(0.5) / 1.65, 1e-15);
}

TEST(Damage, IsShownBesideAMetal) {
  const std::string metal =
      "<bulk_modulus>130e9</bulk_modulus><shear_modulus>46e9</shear_modulus>"
      "<flow_model type=\"isotropic_hardening\"><sigma_Y>9e7</sigma_Y><K>1e8</K></flow_model>";
  MaterialSample s(law("elastic_plastic", metal, steel_constants(),
                       "<damage_model type=\"hancock_mackenzie\">"
                       "<initial_mean_scalar_damage>.0001</initial_mean_scalar_damage>"
                       "</damage_model>"),
                   steel_constants(), 1, 298);
  follow(
      s, [](double t) { return Matrix{1, 0.5 * t, 0, 0, 1, 0, 0, 0, 1}; }, 1, 100);
  // Shear: no mean stress but what hardening in shear makes; D = eps_p/1.65.
  EXPECT_NEAR(s.history(s.history_columns() - 1), 1e-4 + s.history(0) / 1.65, 1e-6);
}

TEST(Failure, GreatestPrincipalStress) {
  MaterialSample s(law("comp_neo_hook", elastic, steel_constants(),
                       threshold("MaximumPrincipalStress", "5000") + erosion("ZeroStress")),
                   steel_constants(), 1, 298);
  const int failed = 1;  // p.epsf, p.localizedMPM
  ASSERT_EQ(s.step(stretched(1.04), 1), std::nullopt);
  EXPECT_EQ(s.history(failed), 0);
  const double sound = s.stress()[0];
  EXPECT_NEAR(sound, 1e5 * 0.04, 200);
  ASSERT_EQ(s.step(stretched(1.06), 1), std::nullopt);
  EXPECT_EQ(s.history(failed), 1);
  for (const double x : s.stress()) EXPECT_EQ(x, 0);
  // The energy stays: what was stored is now heat.
  const double kept = s.energy();
  ASSERT_EQ(s.step(stretched(0.9), 1), std::nullopt);
  EXPECT_EQ(s.energy(), kept);
  for (const double x : s.stress()) EXPECT_EQ(x, 0);
}

TEST(Failure, FailedParticlesKeepPressureWhereTensionIsNotAllowed) {
  const auto made = law("comp_neo_hook", elastic, steel_constants(),
                        threshold("MaximumPrincipalStrain", ".03") + erosion("AllowNoTension"));
  EXPECT_FALSE(made->failed_keep_their_shape());
  MaterialSample s(made, steel_constants(), 1, 298);
  ASSERT_EQ(s.step(stretched(1.05), 1), std::nullopt);
  EXPECT_EQ(s.history(made->failed_column()), 1);
  for (const double x : s.stress()) EXPECT_EQ(x, 0);
  ASSERT_EQ(s.step(stretched(0.9), 1), std::nullopt);
  EXPECT_GT(s.pressure(), 5e3);
  EXPECT_NEAR(s.equivalent(), 0, 1e-9);
}

TEST(Failure, StressFadesInItsTime) {
  const auto made = law("comp_neo_hook", elastic, steel_constants(),
                        threshold("MaximumPrincipalStress", "5000") +
                            erosion("ZeroStress", "<char_time>2</char_time>"));
  MaterialSample s(made, steel_constants(), 1, 298);
  MaterialSample sound(law("comp_neo_hook", elastic), steel_constants(), 1, 298);
  ASSERT_EQ(sound.step(stretched(1.06), 1), std::nullopt);
  for (int n = 0; n < 4; ++n) {
    ASSERT_EQ(s.step(stretched(1.06), 1), std::nullopt);
    EXPECT_NEAR(s.stress()[0] / sound.stress()[0], std::exp(-0.5 * n), 1e-12);
  }
}

// Coulomb's line: in a shear test without mean stress a body of cohesion c fails at c cos phi.
TEST(Failure, MohrCoulombAndItsOtherSpelling) {
  std::vector<Fault> faults;
  const auto made = law_of_text("comp_neo_hook", elastic, steel_constants(), faults,
                                threshold("MohrColoumb", "900",
                                          "<failure_distrib>constant"
                                          "</failure_distrib><friction_angle>30</friction_angle>"));
  ASSERT_NE(made, nullptr) << told(faults);
  EXPECT_NE(told(faults).find("MohrColoumb is read as MohrCoulomb"), std::string::npos);
  const double at_failure = 900 * std::cos(3.14159265358979323846 / 6) / 3e4;
  const auto failed = [&](double g) {
    MaterialSample s(made, steel_constants(), 1, 298);
    EXPECT_EQ(s.step({1, g, 0, 0, 1, 0, 0, 0, 1}, 1), std::nullopt);
    return s.history(made->failed_column());
  };
  EXPECT_EQ(failed(0.98 * at_failure), 0);
  EXPECT_EQ(failed(1.02 * at_failure), 2);
}

// Mean and deviation of what is drawn; the same for the same particle.
TEST(Failure, DrawnThresholds) {
  const int n = 4000;
  const auto moments = [&](const std::string& more) {
    const auto made = law("comp_neo_hook", elastic, steel_constants(),
                          threshold("MaximumPrincipalStress", "1000", more));
    const MaterialSample s(made, steel_constants(), n, 298);
    double mean = 0, square = 0;
    for (int i = 0; i < n; ++i) mean += s.history(0, i) / n;
    for (int i = 0; i < n; ++i) square += std::pow(s.history(0, i) - mean, 2) / n;
    return std::pair{mean, std::sqrt(square)};
  };
  const auto gauss =
      moments("<failure_distrib>gauss</failure_distrib><failure_std>100</failure_std>");
  EXPECT_NEAR(gauss.first, 1000, 5);  // deviation of the mean 1.6
  EXPECT_NEAR(gauss.second, 100, 4);
  // Modulus 5: deviation over mean .2291.
  const auto weibull =
      moments("<failure_distrib>weibull</failure_distrib><failure_std>5</failure_std>");
  EXPECT_NEAR(weibull.first, 1000, 12);
  EXPECT_NEAR(weibull.second, 229.1, 9);
}

// D is 0 at the threshold, .999 far beyond; it rises by no more than its greatest rise.
TEST(Failure, BrittleDamage) {
  const std::string damage =
      "<damage_model type=\"Brittle\"><brittle_damage_initial_threshold>2</"
      "brittle_damage_initial_threshold><brittle_damage_fracture_energy>10</"
      "brittle_damage_fracture_energy><brittle_damage_constant_D>.1</brittle_damage_constant_D>"
      "</damage_model>";
  MaterialSample s(law("comp_neo_hook", elastic, steel_constants(), damage), steel_constants(), 1,
                   298);
  const double young = 9 * 6e4 * 3e4 / (3 * 6e4 + 3e4);
  const double l = 1 / std::sqrt(1 - 2 * 2.5 / std::sqrt(young));  // tau = 2.5
  ASSERT_EQ(s.step(stretched(l), 1), std::nullopt);
  const double C = 2 * std::cbrt(l) * 1.1 * std::log(1.1) / (10 * 0.1);
  const double D = 9.99 * (1.1 / (1 + 0.1 * std::exp(-C * 0.5)) - 1);
  EXPECT_NEAR(s.history(0), std::min(D, 0.1), 1e-12);
  MaterialSample sound(law("comp_neo_hook", elastic), steel_constants(), 1, 298);
  ASSERT_EQ(sound.step(stretched(l), 1), std::nullopt);
  EXPECT_NEAR(s.stress()[0], sound.stress()[0] * (1 - s.history(0)), 1e-9);
  for (int n = 1; n < 60; ++n) ASSERT_EQ(s.step(stretched(l + 0.5 * n), 1), std::nullopt);
  EXPECT_NEAR(s.history(0), 0.999, 1e-3);
  std::vector<Fault> faults;
  EXPECT_EQ(law_of_text("hypo_elastic", "<G>1</G><K>1</K>", steel_constants(), faults, damage),
            nullptr);
  EXPECT_NE(told(faults).find("Brittle damage needs a constitutive model"), std::string::npos);
}

TEST(Failure, MeltedMetalFailsWhereItErodes) {
  const std::string metal =
      "<bulk_modulus>130e9</bulk_modulus><shear_modulus>46e9</shear_modulus>"
      "<flow_model type=\"isotropic_hardening\"><sigma_Y>9e7</sigma_Y><K>1e8</K></flow_model>";
  const auto made = law("elastic_plastic", metal, steel_constants(), erosion("AllowNoTension"));
  MaterialSample s(made, steel_constants(), 1, 1900);
  ASSERT_EQ(s.step(stretched(1.001), 1e-6), std::nullopt);
  EXPECT_EQ(s.history(made->failed_column()), 1);
  EXPECT_EQ(s.stress()[0], 0);
}

TEST(Failure, BadWordsAreTold) {
  std::vector<Fault> faults;
  EXPECT_EQ(law_of_text("comp_neo_hook", elastic, steel_constants(), faults,
                        "<erosion algorithm=\"ZeroStres\"/>"),
            nullptr);
  EXPECT_NE(told(faults).find("valid: none, ZeroStress"), std::string::npos) << told(faults);
  faults.clear();
  EXPECT_EQ(law_of_text("comp_neo_hook", elastic, steel_constants(), faults,
                        "<damage_model type=\"ThresholdVar\"/>"),
            nullptr);
  EXPECT_NE(told(faults).find("known to the format"), std::string::npos) << told(faults);
}

}  // namespace
}  // namespace sluice::mpm::failure
