// Wave curves of every law: Rankine and Hugoniot's relations and the isentrope by independent
// evaluation, closed forms of particular laws, and the general path against the closed one.
#include "exact/riemann/wave_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "eos/eos_test_support.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact::wave_curve_test {
namespace {

struct Sample {
  const char* name;
  eos::EquationOfState law;
  double density, temperature;
  std::vector<double> shocks, fans;  // pressures behind
};

// One of each law, and pressures far above and below.
std::vector<Sample> one_of_each() {
  const double expanded = 1200.0;  // products of detonation after some expansion
  return {
      {"ideal", eos::air, 1.2, 300, {3e5, 1e9}, {1e4, 1e-3}},
      {"stiff", eos::stiff_water, 1000, 300, {2e9, 1e11}, {1e5, -1e7}},
      {"hard", eos::hard_spheres, 100, 3000, {5e8, 1e11}, {1e7, 1e4}},
      {"noble", eos::repulsive_water, 1000, 400, {2e9, 1e11}, {1e7, -1e7}},
      {"tst", eos::attracting_gas, 30, 600, {5e7, 1e9}, {1e6, 1e4}},
      {"jwl", eos::tnt, expanded, 3500, {2e10, 2e11}, {1e9, 1e5, 1e2}},
      {"jwlc", eos::tnt_isentrope, expanded, 3500, {2e10, 2e11}, {1e9, 1e5}},
      {"murnaghan", eos::steep_solid, 1200, 300, {5e8, 2e10}, {2e7, 2e5}},
      {"birch",
       eos::BirchMurnaghan{{.n = 5.0, .K = 7e-11, .rho0 = 2e3, .specific_heat = 900.0}},
       2200,
       300,
       {1e10, 1e11},
       {1e8, 2e5}},
      {"mie", eos::copper, 9200, 300, {5e10, 3e11}, {1e9, -1e9}},
      {"linear", eos::propellant, 1830, 320, {1e8, 5e8}, {1e6, -1e8}},
      {"tillotson", eos::aluminium, 2800, 400, {1e10, 2e11}, {1e9, 1e8}},
      {"thomsen", eos::ThomsenHartkaWater{}, 1005, 300, {5e7, 2e8}, {1e6, 1e5}},
      {"knauss", eos::KnaussSeaWater{{}}, 1030, 290, {5e7, 1e9}, {1e5, -1e7}},
      {"air_of_nasa", eos::warm_air(), 1.2, 300, {3e5, 1e6}, {1e5, 3e4}},
  };
}

class EveryLaw : public testing::TestWithParam<Sample> {
 protected:
  FluidState ahead() const {
    return state_of_temperature(GetParam().law, GetParam().density, 0, GetParam().temperature);
  }
  std::unique_ptr<WaveCurve> curve() const {
    return make_wave_curve(GetParam().law, ahead(), WaveFormulas::general);
  }
  double pressure(double rho, double energy) const {
    return std::visit([&](const auto& l) { return l.pressure(rho, rho * energy); }, GetParam().law);
  }
};

TEST_P(EveryLaw, ShocksConserveMassMomentumAndEnergy) {
  const FluidState a = ahead();
  const auto curve = this->curve();
  for (const double p : GetParam().shocks) {
    ASSERT_GT(p, a.pressure);
    const FluidState b = curve->behind(p).state;
    EXPECT_NEAR(pressure(b.density, b.energy), p, 1e-12 * std::abs(p));
    const double s = curve->speeds(b).head;
    EXPECT_GT(s, sound_speed(GetParam().law, a));               // supersonic ahead,
    EXPECT_LT(s, b.velocity + sound_speed(GetParam().law, b));  // subsonic behind
    const double mass = a.density * s, behind = b.density * (s - b.velocity);
    EXPECT_NEAR(behind, mass, 1e-12 * mass) << p;
    EXPECT_NEAR(mass * b.velocity, p - a.pressure, 1e-12 * p) << p;
    const double work = p * b.velocity;
    EXPECT_NEAR(mass * (b.energy - a.energy + 0.5 * b.velocity * b.velocity), work,
                1e-12 * (work + mass * std::abs(a.energy)))
        << p;
  }
}

// de = p/rho^2 drho and du = dp/(rho c), by differences of the states along the fan.
TEST_P(EveryLaw, FansAreIsentropic) {
  const auto curve = this->curve();
  for (const double p : GetParam().fans) {
    const FluidState b = curve->behind(p).state;
    EXPECT_NEAR(pressure(b.density, b.energy), p,
                1e-11 * b.density * std::pow(sound_speed(GetParam().law, b), 2));
    const double low = curve->lowest_pressure(), d = 1e-3 * std::min(p - low, std::abs(p) + 1.0);
    const auto at = [&](double by) { return curve->behind(p + by * d).state; };
    const auto slope = [&](double FluidState::*q) {
      return (8 * (at(1).*q - at(-1).*q) - (at(2).*q - at(-2).*q)) / (12 * d);
    };
    const double c = sound_speed(GetParam().law, b);
    const double drho = slope(&FluidState::density);
    // Differences lose digits where d is a small part of rho c^2.
    const double lost = 1e-14 * b.density * c * c / d;
    EXPECT_NEAR(drho * c * c, 1, 1e-7 + 30 * lost) << p;
    EXPECT_NEAR(slope(&FluidState::energy), b.pressure / (b.density * b.density) * drho,
                (1e-7 + 30 * lost) * (std::abs(b.pressure) / std::pow(b.density * c, 2) +
                                      (std::abs(b.energy) / (b.density * c * c))))
        << p;
    EXPECT_NEAR(slope(&FluidState::velocity) * b.density * c, 1, 1e-7 + 30 * lost) << p;
    EXPECT_LT(b.velocity, 0);
  }
}

TEST_P(EveryLaw, SlopesAreThoseOfTheCurve) {
  const auto curve = this->curve();
  for (const double p : GetParam().shocks) {
    const double d = 1e-3 * (p - ahead().pressure);
    const auto u = [&](double by) { return curve->behind(p + by * d).state.velocity; };
    const double slope = (8 * (u(1) - u(-1)) - (u(2) - u(-2))) / (12 * d);
    EXPECT_NEAR(curve->behind(p).slope, slope, 1e-8 * slope) << p;
  }
}

TEST_P(EveryLaw, InsideAFanTheWaveSpeedIsTheRay) {
  const auto curve = this->curve();
  const FluidState tail = curve->behind(GetParam().fans.back()).state;
  const WaveCurve::Speeds wave = curve->speeds(tail);
  EXPECT_LT(wave.tail, wave.head);
  double before = tail.pressure;
  for (const double part : {0.1, 0.4, 0.7, 0.999}) {
    const double speed = wave.tail + part * (wave.head - wave.tail);
    const FluidState s = curve->in_fan(speed);
    EXPECT_NEAR(s.velocity + sound_speed(GetParam().law, s), speed, 1e-12 * wave.head) << part;
    EXPECT_GT(s.pressure, before);
    const FluidState same = curve->behind(s.pressure).state;  // two ways to one state
    const double c = sound_speed(GetParam().law, s);
    EXPECT_NEAR(same.velocity, s.velocity, 1e-10 * c);
    EXPECT_NEAR(same.density, s.density, 1e-10 * s.density);
    before = s.pressure;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, EveryLaw, testing::ValuesIn(one_of_each()),
                         [](const auto& test) { return std::string(test.param.name); });

// The two paths share nothing but the equation of state.
TEST(WaveCurve, GeneralPathMeetsTheClosedOne) {
  const eos::IdealGas heavy{.gamma = 1.09, .specific_heat = 400};
  for (const eos::EquationOfState& law :
       {eos::EquationOfState{eos::stiff_water}, eos::EquationOfState{eos::air},
        eos::EquationOfState{heavy}}) {
    const bool liquid = law.index() == 1;
    const FluidState ahead =
        liquid ? state_of_pressure(law, 1000, 0, 1e9) : state_of_pressure(law, 1.2, 0, 1e5);
    const auto closed = make_wave_curve(law, ahead);
    const auto general = make_wave_curve(law, ahead, WaveFormulas::general);
    const double c = sound_speed(law, ahead);
    const double gas[] = {1e-2, 1e2, 9e4, 99999, 100001, 2e5, 1e7, 1e10};
    const double water[] = {-5e8, 0, 1e5, 9e8, 9.9999e8, 1.00001e9, 2e9, 1e12};
    for (int k = 0; k < 8; ++k) {
      const double p = liquid ? water[k] : gas[k];
      const WaveCurve::Point a = closed->behind(p), b = general->behind(p);
      EXPECT_NEAR(a.state.velocity, b.state.velocity, 1e-12 * (c + std::abs(a.state.velocity)));
      EXPECT_NEAR(a.state.density, b.state.density, 1e-12 * a.state.density) << p;
      EXPECT_NEAR(a.state.energy, b.state.energy, 1e-11 * std::abs(a.state.energy)) << p;
      EXPECT_NEAR(a.slope, b.slope, 1e-10 * a.slope) << p;
    }
    const WaveCurve::Speeds wave = closed->speeds(closed->behind(liquid ? -5e8 : 1e-2).state);
    for (double part = 0.03; part < 1; part += 0.07) {
      const double speed = wave.tail + part * (wave.head - wave.tail);
      const FluidState a = closed->in_fan(speed), b = general->in_fan(speed);
      EXPECT_NEAR(a.velocity, b.velocity, 1e-12 * c) << part;
      EXPECT_NEAR(a.density, b.density, 2e-12 * a.density) << part;
    }
  }
}

// The isentropes of JWL are known: p - A exp(-R1 V) - B exp(-R2 V) goes as V^-(1 + om); and its
// Hugoniot curve, since p is linear in e.
TEST(WaveCurve, JwlProductsFollowTheirClosedCurves) {
  const eos::Jwl& law = eos::tnt;
  const FluidState ahead = state_of_pressure(law, 1840, 0, 14.5e9);
  const auto curve = make_wave_curve(law, ahead);
  const auto constant = [&](double rho, double p) {
    const double V = law.rho0 / rho;
    return (p - law.A * std::exp(-law.R1 * V) - law.B * std::exp(-law.R2 * V)) *
           std::pow(V, 1 + law.om);
  };
  const double start = constant(ahead.density, ahead.pressure);
  for (const double p : {1.4e10, 5e9, 1e8, 1e6, 1e5, 1e2}) {
    const FluidState s = curve->behind(p).state;
    EXPECT_NEAR(constant(s.density, p), start, 1e-11 * start) << p;
  }
  for (const double p : {1.5e10, 5e10, 1e12}) {
    const FluidState s = curve->behind(p).state;
    const double lost = 1 / ahead.density - 1 / s.density;
    const double hugoniot = (law.offset(s.density) +
                             law.om * s.density * (ahead.energy + 0.5 * ahead.pressure * lost)) /
                            (1 - 0.5 * law.om * s.density * lost);
    EXPECT_NEAR(hugoniot, p, 1e-11 * p);
  }
}

// Above its reference density the Murnaghan isentrope is that of a stiffened gas with gamma = n:
// u = 2 (c - c0)/(n - 1).
TEST(WaveCurve, MurnaghanSolidKeepsItsRiemannInvariant) {
  const eos::Murnaghan& law = eos::steep_solid;
  const FluidState ahead = state_of_temperature(law, 1300, 0, 300);
  const auto curve = make_wave_curve(law, ahead);
  const double c0 = sound_speed(law, ahead);
  for (const double p : {0.9 * ahead.pressure, 1e8, 2e6}) {
    const FluidState s = curve->behind(p).state;
    EXPECT_NEAR(s.velocity, 2 / (law.n - 1) * (sound_speed(law, s) - c0), 1e-12 * c0) << p;
    EXPECT_NEAR(s.density, law.density(p, 300), 1e-12 * s.density) << p;
  }
}

// The law is built on Us = C0 + S up from its reference state.
TEST(WaveCurve, MieGruneisenShocksRunAtTheirFittedSpeed) {
  const eos::MieGruneisen& law = eos::copper;
  const FluidState ahead = state_of_temperature(law, law.rho0, 0, law.T0);
  ASSERT_NEAR(ahead.pressure, 0, 1.0);
  const auto curve = make_wave_curve(law, ahead);
  for (const double p : {1e9, 3e10, 2e11}) {
    const FluidState s = curve->behind(p).state;
    EXPECT_NEAR(curve->speeds(s).head, law.C0 + law.S * s.velocity, 1e-8 * law.C0) << p;
  }
}

TEST(WaveCurve, SaysWhereItEnds) {
  const FluidState gas = state_of_pressure(eos::air, 1.2, 0, 1e5);
  EXPECT_THROW(make_wave_curve(eos::air, {-1, 0, 1, 1}), InputError);
  EXPECT_THROW(make_wave_curve(eos::air, gas)->behind(-1), InputError);
  const FluidState vapour = state_of_temperature(eos::attracting_gas, 30, 0, 600);
  EXPECT_THROW(make_wave_curve(eos::attracting_gas, vapour)->behind(-1e6), InputError);
  EXPECT_THROW(state_of_pressure(eos::air, 1.2, 0, -1), InputError);
  EXPECT_THROW(state_of_pressure(eos::steep_solid, 1200, 0, 1e8), InputError);
  EXPECT_THROW(state_of_temperature(eos::hard_spheres, 2000, 0, 300), InputError);
}

}  // namespace
}  // namespace sluice::exact::wave_curve_test
