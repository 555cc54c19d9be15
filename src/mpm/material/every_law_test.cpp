// What must hold for every law of the table.
#include <algorithm>
#include <cmath>
#include <random>

#include "framework/base/error.hpp"
#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/test_support/law_test_support.hpp"

namespace sluice::mpm::every_law {
namespace {

enum class Kind { stored_energy, rate };

struct LawCase {
  const char* type;
  const char* inside;
  Kind kind;
  double K, G;                  // at rest
  double strain = 0.1;          // size of the deformations that it is tried with
  double objectivity = 1e-12;   // change of stress by a rotation during deformation, of K strain
  double work = 2e-4;           // energy against work of the stress, of the path's work
  const char* named = nullptr;  // of the case; the type where null
};

const LawCase cases[] = {
    {"comp_neo_hook", "<bulk_modulus>6e4</bulk_modulus><shear_modulus>3e4</shear_modulus>",
     Kind::stored_energy, 6e4, 3e4},
    {"comp_neo_hook_plastic",
     "<bulk_modulus>6e4</bulk_modulus><shear_modulus>3e4</shear_modulus>"
     "<yield_stress>2e3</yield_stress><hardening_modulus>5e3</hardening_modulus>",
     // sigma_f d alpha is the plastic work but for the square of the elastic strain, 5 % here.
     Kind::rate, 6e4, 3e4, 0.1, 1e-12, 1e-3},
    {"UCNH", "<bulk_modulus>6e4</bulk_modulus><shear_modulus>3e4</shear_modulus>",
     Kind::stored_energy, 6e4, 3e4},
    {"cnh_mms", "<bulk_modulus>6e4</bulk_modulus><shear_modulus>3e4</shear_modulus>",
     Kind::stored_energy, 6e4, 3e4},
    {"comp_mooney_rivlin",
     "<he_constant_1>1e5</he_constant_1><he_constant_2>2e4</he_constant_2><he_PR>.49</he_PR>",
     Kind::stored_energy, 1.192e7, 2.4e5},
    // Hughes-Winget: exact for a rotation, of second order while the body also stretches.
    {"hypo_elastic", "<G>3e4</G><K>6e4</K>", Kind::rate, 6e4, 3e4, 0.1, 2e-4},
    {"elastic_plastic",
     "<bulk_modulus>173.33e9</bulk_modulus><shear_modulus>80e9</shear_modulus>"
     "<flow_model type='johnson_cook'><A>792e6</A><B>510e6</B><C>.014</C><n>.26</n><m>1.03</m>"
     "</flow_model>",
     Kind::rate, 173.33e9, 80e9, 0.1, 1e-9, 1e-3, "johnson_cook"},
    {"rf_elastic_plastic",
     "<bulk_modulus>173.33e9</bulk_modulus><shear_modulus>80e9</shear_modulus>"
     "<flow_model type='johnson_cook'><A>792e6</A><B>510e6</B><C>.014</C><n>.26</n><m>1.03</m>"
     "</flow_model>",
     Kind::rate, 173.33e9, 80e9, 0.1, 1e-9, 1e-3},
    {"elastic_plastic_hp",
     "<bulk_modulus>138e9</bulk_modulus><shear_modulus>46e9</shear_modulus>"
     "<equation_of_state type='mie_gruneisen'><C_0>4200.1</C_0><Gamma_0>1.99</Gamma_0>"
     "<S_alpha>1.5</S_alpha></equation_of_state>"
     "<flow_model type='mts_model'><sigma_a>40e6</sigma_a><mu_0>51.3e9</mu_0><D>3e9</D>"
     "<T_0>165</T_0><koverbcubed>.823e6</koverbcubed><g_0e>1.6</g_0e><edot_0e>1e7</edot_0e>"
     "<p_e>.666667</p_e><q_e>1</q_e><a_0>2390e6</a_0><a_1>12e6</a_1><a_2>1.696e6</a_2>"
     "<alpha>2</alpha><edot_es0>1e7</edot_es0><g_0es>.2625</g_0es><sigma_es0>770e6</sigma_es0>"
     "</flow_model>",
     Kind::rate, 138.1246e9, 46e9, 0.1, 1e-9, 2e-3, "mie_gruneisen_mts"},
    {"ideal_gas",
     "<gamma>1.4</gamma><Pref>445201272</Pref>"
     "<UseArtificialViscosity>false</UseArtificialViscosity>",
     Kind::rate, 1.4 * 445201272, 0},
    {"water", "<bulk_modulus>15000</bulk_modulus><viscosity>0</viscosity><gamma>7</gamma>",
     Kind::stored_energy, 105000, 0},
    {"murnaghanMPM", "<K>15000</K><gamma>4</gamma>", Kind::stored_energy, 60000, 0},
    {"jwlpp_mpm",
     "<ignition_pressure>1e15</ignition_pressure><murnaghan_K>1.9342e-10</murnaghan_K>"
     "<murnaghan_n>5.2</murnaghan_n><jwl_A>7.73e11</jwl_A><jwl_B>2.16e10</jwl_B>"
     "<jwl_C>1.339e9</jwl_C><jwl_R1>4.5</jwl_R1><jwl_R2>1.5</jwl_R2><jwl_om>.33</jwl_om>"
     "<reaction_G>1</reaction_G><reaction_b>1.05</reaction_b>",
     Kind::rate, 1 / 1.9342e-10, 0},
    {"trans_iso_hyper",
     "<bulk_modulus>1e5</bulk_modulus><c1>2e3</c1><c2>1e3</c2><c3>1e3</c3><c4>10</c4><c5>4e4</c5>"
     "<fiber_stretch>1.05</fiber_stretch><direction_of_symm>[0,0,1]</direction_of_symm>",
     Kind::stored_energy, 1e5, 6e3},
    {"visco_trans_iso_hyper",
     "<bulk_modulus>1e5</bulk_modulus><c1>2e3</c1><c2>1e3</c2><c3>1e3</c3><c4>10</c4><c5>4e4</c5>"
     "<fiber_stretch>1.05</fiber_stretch><direction_of_symm>[0,0,1]</direction_of_symm>"
     "<y1>.5</y1><t1>1e4</t1>",
     Kind::rate, 1e5, 9e3, 0.1, 1e-11},
    {"visco_scram",
     "<PR>.3</PR><CrackParameterA>1e-3</CrackParameterA><CrackPowerValue>10</CrackPowerValue>"
     "<CrackMaxGrowthRate>0</CrackMaxGrowthRate><StressIntensityF>5e5</StressIntensityF>"
     "<CrackFriction>.35</CrackFriction><InitialCrackRadius>3e-5</InitialCrackRadius>"
     "<CrackGrowthRate>12</CrackGrowthRate><G1>3.5e8</G1><G2>1.739e8</G2><G3>5.212e8</G3>"
     "<G4>9.085e8</G4><G5>6.875e8</G5><RTau1>0</RTau1><RTau2>1e-6</RTau2><RTau3>1e-6</RTau3>"
     "<RTau4>1e-5</RTau4><RTau5>1e-5</RTau5>",
     Kind::rate, 5.72238e9, 2.6411e9, 0.1, 2e-4},
    {"program_burn",
     "<K>1.9342e-10</K><n>5.2</n><A>7.73e11</A><B>2.16e10</B><C>1.339e9</C><R1>4.5</R1><R2>1.5</R2>"
     "<om>.33</om><D>8e3</D><T0>1e3</T0><starting_location>[0,0,0]</starting_location>",
     Kind::rate, 1 / 1.9342e-10, 0},
    {"mw_visco_elastic",
     "<e_shear_modulus>6e3</e_shear_modulus><e_bulk_modulus>16e3</e_bulk_modulus>"
     "<ve_shear_modulus>1e4</ve_shear_modulus><ve_bulk_modulus>2e4</ve_bulk_modulus>"
     "<ve_deviatoric_viscosity>1e6</ve_deviatoric_viscosity>"
     "<ve_volumetric_viscosity>1e7</ve_volumetric_viscosity>",
     Kind::rate, 36e3, 16e3, 0.1, 2e-4},
    {"p_alpha",
     "<Ps>6e9</Ps><Pe>.46e9</Pe><rhoS>9041</rhoS><K0>35.2e9</K0><T_0>298</T_0><C_0>3800</C_0>"
     "<Gamma_0>1.2</Gamma_0><S_alpha>1.1</S_alpha>",
     Kind::rate, 35.2e9, 0},
    {"p_alpha",
     "<Ps>6e9</Ps><Pe>.46e9</Pe><rhoS>9041</rhoS><K0>35.2e9</K0><T_0>298</T_0><C_0>3800</C_0>"
     "<Gamma_0>1.2</Gamma_0><S_alpha>1.1</S_alpha><shear_modulus>20e9</shear_modulus>"
     "<yield_stress>5e8</yield_stress><hardening_modulus>1e9</hardening_modulus>",
     Kind::rate, 35.2e9, 20e9, 0.1, 1e-9, 1e-3, "p_alpha_with_shear"},
    {"ArrudaBoyce8",
     "<bulk_modulus>6e4</bulk_modulus><shear_modulus>3e4</shear_modulus><beta>1.67</beta>",
     Kind::stored_energy, 6e4, 3e4},
    // Of the density of the other cases; near 0 and 60 C its law ends.
    {"TH_water", "<vo>1.272704913571334e-4</vo>", Kind::rate, 2.324485e9, 0, 0.02},
    {"elastic_plastic",
     "<bulk_modulus>173.33e9</bulk_modulus><shear_modulus>80e9</shear_modulus>"
     "<deviatoric_stress_model type='hypoViscoElastic'><mu>[50e9,30e9]</mu><tau>[1e3,20]</tau>"
     "</deviatoric_stress_model>"
     "<flow_model type='johnson_cook'><A>792e6</A><B>510e6</B><C>.014</C><n>.26</n><m>1.03</m>"
     "</flow_model>",
     Kind::rate, 173.33e9, 80e9, 0.1, 1e-9, 1e-3, "hypo_visco_elastic"},
    {"MohrCoulomb", "<K>1.3e7</K><G>1e7</G><c>2e5</c><Phi>30</Phi><Psi>10</Psi>", Kind::rate, 1.3e7,
     1e7, 0.1, 1e-9, 2e-3},
    {"Arenisca",
     "<B0>6e9</B0><G0>3e9</G0><PEAKI1>2e7</PEAKI1><FSLOPE>.4</FSLOPE><FSLOPE_p>.3</FSLOPE_p>"
     "<CR>6</CR><p0_crush_curve>-3e7</p0_crush_curve><p1_crush_curve>5e-9</p1_crush_curve>"
     "<p3_crush_curve>.2</p3_crush_curve><hardening_modulus>1e7</hardening_modulus>"
     "<kinematic_hardening_constant>1e7</kinematic_hardening_constant>",
     Kind::rate, 6e9, 3e9, 0.1, 1e-9, 2e-3},
    {"Arenisca3",
     "<B0>6e9</B0><G0>3e9</G0><PEAKI1>2e7</PEAKI1><FSLOPE>.4</FSLOPE><STREN>8e7</STREN>"
     "<YSLOPE>.1</YSLOPE><CR>.5</CR><p0_crush_curve>-3e7</p0_crush_curve>"
     "<p1_crush_curve>5e-9</p1_crush_curve><p3_crush_curve>.2</p3_crush_curve>"
     "<T1_rate_dependence>1e-3</T1_rate_dependence>",
     Kind::rate, 6e9, 3e9, 0.1, 1e-9, 2e-3},
    {"Arenisca4",
     "<B0>6e9</B0><G0>3e9</G0><PEAKI1>2e7</PEAKI1><FSLOPE>.4</FSLOPE><STREN>8e7</STREN>"
     "<YSLOPE>.1</YSLOPE><CR>.5</CR><p0_crush_curve>-3e7</p0_crush_curve>"
     "<p1_crush_curve>5e-9</p1_crush_curve><p3_crush_curve>.2</p3_crush_curve>"
     "<T1_rate_dependence>1e-3</T1_rate_dependence>",
     Kind::rate, 6e9, 3e9, 0.1, 1e-9, 2e-3},
    {"ArenaSoil",
     "<initial_porosity>.4</initial_porosity><initial_saturation>.3</initial_saturation>"
     "<initial_fluid_pressure>0</initial_fluid_pressure><p0>1e7</p0><p1>482.68e6</p1>"
     "<p1_sat>1</p1_sat><p2>.719</p2><p3>.5108256</p3><elastic_moduli_model type='arena'>"
     "<b0>.0029</b0><b1>.4731</b1><b2>1.5057</b2><b3>2.5728</b3><b4>2.0799</b4><G0>1e8</G0>"
     "<nu1>0</nu1><nu2>0</nu2></elastic_moduli_model><plastic_yield_condition type='arena'>"
     "<PEAKI1>1e6</PEAKI1><FSLOPE>.453</FSLOPE><STREN>1e7</STREN><YSLOPE>.31</YSLOPE>"
     "<BETA>1</BETA><CR>.5</CR><T1>1e-3</T1><T2>.5</T2></plastic_yield_condition>"
     "<do_damage>true</do_damage><fspeed>15</fspeed><time_at_failure>5</time_at_failure>",
     Kind::rate, 116e6, 1e8, 0.1, 1e-9, 2e-3},
};

class EveryLaw : public testing::TestWithParam<LawCase> {
 protected:
  MaterialConstants constants() const { return steel_constants(); }
  std::shared_ptr<const Material> made() const {
    return law(GetParam().type, GetParam().inside, constants());
  }
  MaterialSample sample(int count = 1) const {
    return {made(), constants(), count, constants().room_temperature};
  }
  double modulus() const { return GetParam().K + 4.0 / 3 * GetParam().G; }
};

// Those whose energy is a function of F.
class StoredEnergyLaw : public EveryLaw {};

// Some deformation without any symmetry.
Matrix deformation(double size, unsigned seed = 1) {
  std::mt19937 random(seed);
  Matrix F = identity;
  for (double& x : F) x += size * (static_cast<double>(random()) / 2147483648.0 - 1);
  return F;
}

TEST_P(EveryLaw, BodyAtRestHasNoStressAndTheWaveSpeedOfItsModuli) {
  MaterialSample s = sample();
  ASSERT_EQ(s.step(identity, 1e-6), std::nullopt);
  for (const double x : s.stress()) EXPECT_NEAR(x, 0, 1e-13 * modulus());
  EXPECT_NEAR(s.energy(), 0, 1e-13 * modulus());
  const double c = std::sqrt(modulus() / constants().density);
  EXPECT_NEAR(s.wave_speed() / c, 1, 1e-3);  // K and G of a case are rounded
  EXPECT_NEAR(made()->bulk_modulus() / GetParam().K, 1, 2e-3);
}

// The table's law of infinitesimal strain: K and G, by a small shear and a small change of volume.
TEST_P(EveryLaw, SmallStrainsSeeTheModuli) {
  const double e = 1e-6;
  MaterialSample shear = sample();
  ASSERT_EQ(shear.step({1, e, 0, 0, 1, 0, 0, 0, 1}, 1e-3), std::nullopt);
  EXPECT_NEAR(shear.stress()[5], GetParam().G * e, 1e-3 * modulus() * e);
  MaterialSample volume = sample();
  ASSERT_EQ(volume.step({1 + e, 0, 0, 0, 1 + e, 0, 0, 0, 1 + e}, 1e-3), std::nullopt);
  EXPECT_NEAR(-volume.pressure() / (3 * GetParam().K * e), 1, 2e-3);
}

// Turning the deformed body turns its stress and does nothing else.
TEST_P(EveryLaw, RotationAfterDeformationTurnsTheStress) {
  MaterialSample s = sample();
  const Matrix F = deformation(GetParam().strain);
  follow(
      s,
      [&](double t) {
        Matrix now = identity;
        for (std::size_t k = 0; k < 9; ++k) now[k] += t * (F[k] - identity[k]);
        return now;
      },
      1, 10);
  const std::array<double, 6> before = s.stress();
  const double energy = s.energy();
  const std::array<double, 3> axis = {0.3, -1, 0.6};
  const double quick = 1e-15;  // no time for creep
  for (int n = 1; n <= 8; ++n)
    ASSERT_EQ(s.step(product(rotation(axis, 0.4 * n), F), quick), std::nullopt);
  const std::array<double, 6> turned = pushed(before, rotation(axis, 3.2));
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(s.stress()[k], turned[k], 1e-12 * modulus()) << k;
  EXPECT_NEAR(s.energy(), energy, 1e-12 * modulus());
}

// A body that is turned while it deforms: the stress is the turned one of the body that is not.
TEST_P(EveryLaw, RotationDuringDeformationTurnsTheStress) {
  const Matrix F = deformation(GetParam().strain, 2);
  const auto path = [&](double t) {
    Matrix now = identity;
    for (std::size_t k = 0; k < 9; ++k) now[k] += std::sin(t) * (F[k] - identity[k]);
    return now;
  };
  const std::array<double, 3> axis = {-0.2, 0.5, 1};
  MaterialSample plain = sample(), turned = sample();
  follow(plain, path, 2, 40);
  follow(
      turned, [&](double t) { return product(rotation(axis, 0.8 * t), path(t)); }, 2, 40);
  const std::array<double, 6> expected = pushed(plain.stress(), rotation(axis, 1.6));
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(turned.stress()[k], expected[k],
                GetParam().objectivity * GetParam().strain * modulus())
        << k;
}

// sigma = (1/J) dW/dF F^T, by differences of fourth order of the energy column.
TEST_P(StoredEnergyLaw, StressIsTheDerivativeOfTheStoredEnergy) {
  const Matrix F = deformation(2 * GetParam().strain, 3);
  MaterialSample s = sample();
  ASSERT_EQ(s.step(F, 1), std::nullopt);
  const auto energy = [&](std::size_t k, double h) {
    Matrix moved = F;
    moved[k] += h;
    MaterialSample other = sample();
    EXPECT_EQ(other.step(moved, 1), std::nullopt);
    return other.energy();
  };
  const double h = 1e-3;
  Matrix P{};
  for (std::size_t k = 0; k < 9; ++k)
    P[k] = (8 * (energy(k, h) - energy(k, -h)) - (energy(k, 2 * h) - energy(k, -2 * h))) / (12 * h);
  const Matrix tau = product(P, transposed(F)), sigma = full(s.stress());
  for (std::size_t k = 0; k < 9; ++k)
    EXPECT_NEAR(tau[k] / determinant(F), sigma[k], 1e-7 * modulus()) << k;
}

// The energy is the work of the stress: its sum along a path, by the trapezoidal rule.
TEST_P(EveryLaw, EnergyIsTheWorkOfTheStress) {
  const Matrix F = deformation(GetParam().strain, 4);
  const auto path = [&](double t) {
    Matrix now = identity;
    for (std::size_t k = 0; k < 9; ++k) now[k] += t * (F[k] - identity[k]);
    return now;
  };
  MaterialSample s = sample();
  const int steps = 400;
  double work = 0, size = 0;
  Matrix old_P{};
  follow(s, path, 1, steps, [&](const MaterialSample& now) {
    // P = J sigma F^-T; dW = P : dF
    Matrix P = product(full(now.stress()), transposed(inverse(now.F())));
    for (double& x : P) x *= now.volume_ratio();
    for (std::size_t k = 0; k < 9; ++k) {
      if (now.time() > 0) work += 0.5 * (P[k] + old_P[k]) * (F[k] - identity[k]) / steps;
      size += std::abs(P[k] * (F[k] - identity[k])) / steps;
    }
    old_P = P;
  });
  EXPECT_NEAR(s.energy(), work, GetParam().work * size);
}

// What a batch gives for a particle does not depend on who is beside it.
TEST_P(EveryLaw, ParticlesOfABatchAreAsAlone) {
  const int count = 19;  // eight lanes twice, and a rest
  MaterialSample together = sample(count);
  std::vector<MaterialSample> alone(count, sample());
  for (int n = 1; n <= 3; ++n) {
    std::vector<Matrix> F;
    for (int i = 0; i < count; ++i)
      F.push_back(deformation(GetParam().strain * 0.3 * n, 10u + static_cast<unsigned>(i)));
    ASSERT_EQ(together.step(F, 1e-5), std::nullopt);
    for (int i = 0; i < count; ++i) {
      ASSERT_EQ(alone[i].step(F[i], 1e-5), std::nullopt);
      for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(together.stress(i)[k], alone[i].stress()[k]);
      EXPECT_EQ(together.energy(i), alone[i].energy());
      EXPECT_EQ(together.wave_speed(i), alone[i].wave_speed());
    }
  }
}

TEST_P(EveryLaw, RefusesAnInvertedParticle) {
  MaterialSample s = sample(3);
  std::vector<Matrix> F(3, identity);
  F[1][0] = -0.2;
  const auto fault = s.step(F, 1e-3);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->particle, 1);
  EXPECT_STREQ(fault->reason, "det F <= 0");
  EXPECT_DOUBLE_EQ(fault->value, -0.2);
}

// A law without a case would go untested here. A rigid body has no stress.
TEST(LawTable, HasACaseForEachLaw) {
  for (const MaterialModel& model : material_models()) {
    const bool tested = std::any_of(std::begin(cases), std::end(cases),
                                    [&](const LawCase& c) { return c.type == model.name; });
    EXPECT_TRUE(tested || model.name == "rigid") << model.name;
  }
}

// What is supported is not called unsupported, and no name is there twice.
TEST(LawTable, NamesEachLawOnce) {
  std::vector<std::string> names;
  for (const MaterialModel& model : material_models()) {
    names.push_back(model.name);
    EXPECT_FALSE(model.doc.empty()) << model.name;
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

std::string name_of_case(const testing::TestParamInfo<LawCase>& info) {
  return info.param.named != nullptr ? info.param.named : info.param.type;
}
std::vector<LawCase> of_stored_energy() {
  std::vector<LawCase> some;
  for (const LawCase& c : cases)
    if (c.kind == Kind::stored_energy) some.push_back(c);
  return some;
}
INSTANTIATE_TEST_SUITE_P(Table, StoredEnergyLaw, testing::ValuesIn(of_stored_energy()),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Table, EveryLaw, testing::ValuesIn(cases), name_of_case);

}  // namespace
}  // namespace sluice::mpm::every_law
