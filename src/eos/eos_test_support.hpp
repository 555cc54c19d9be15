// Checks that every equation of state must pass, at random states of a given range, and materials
// that several tests ask.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

#include "eos/component_heat.hpp"
#include "eos/eos.hpp"
#include "eos/polynomial_heat.hpp"

namespace sluice::eos {

struct StateRange {
  double rho_low, rho_high;  // kg/m^3
  double T_low, T_high;      // K
  double kink = 0.0;         // density (kg/m^3) where a branch changes: no difference across it
  double step = 1e-3;        // relative step of the differences
  double share = 0.9;        // of the random states, at least this much must be admissible
};

// Relative ones.
struct Tolerances {
  double slopes = 2e-9;   // derivatives against differences of fourth order
  double energy = 1e-12;  // e(rho, p(rho, e)), as a share of the energy that moves p by rho c^2
  double density = 1e-11;
  double temperature = 1e-10;
  double mixed = 2e-9;  // (de/dv)_T = T (dp/dT)_v - p
};

inline constexpr IdealGas air{.gamma = 1.4, .specific_heat = 717.5};
// Products of TNT (Dobratz and Crawford, LLNL Explosives Handbook, UCRL-52997, 1985): the law and
// its isentrope.
inline const Jwl tnt{{.A = 371.2e9,
                      .B = 3.231e9,
                      .R1 = 4.15,
                      .R2 = 0.95,
                      .om = 0.30,
                      .rho0 = 1630.0,
                      .specific_heat = 1000.0}};
inline const Jwlc tnt_isentrope{{.A = 371.2e9,
                                 .B = 3.231e9,
                                 .C = 1.045e9,
                                 .R1 = 4.15,
                                 .R2 = 0.95,
                                 .om = 0.30,
                                 .rho0 = 1630.0,
                                 .specific_heat = 1000.0}};
inline const StiffenedGas stiff_water{
    {.gamma = 4.4, .pinf = 6e8, .q = -1.2e6, .specific_heat = 1816.0}};
inline const HardSphereGas hard_spheres{{.gamma = 1.3, .b = 1e-3, .specific_heat = 1100.0}};
inline const TstGas attracting_gas{{.a = 300.0, .b = 1e-3, .Gamma = 1.4, .specific_heat = 1500.0}};
inline const Murnaghan steep_solid{
    {.n = 7.4, .K = 39e-11, .rho0 = 1160.0, .specific_heat = 1400.0}};
inline const LinearGruneisen propellant{
    {.A = 1.3338e9, .B = 7.027e5, .rho0 = 1823.3, .T0 = 317.4, .specific_heat = 1000.0}};
inline const MieGruneisen copper{{.C0 = 3940.0,
                                  .S = 1.489,
                                  .Gamma0 = 2.02,
                                  .rho0 = 8930.0,
                                  .T0 = 294.0,
                                  .specific_heat = 385.0}};
// Melosh, Impact Cratering (1989), table AII.3.
inline constexpr Tillotson aluminium{.a = 0.5,
                                     .b = 1.63,
                                     .A = 75.2e9,
                                     .B = 65e9,
                                     .E0 = 5e6,
                                     .Es = 3e6,
                                     .Esp = 13.9e6,
                                     .alpha = 5.0,
                                     .beta = 5.0,
                                     .rho0 = 2700.0,
                                     .specific_heat = 900.0};
// Le Metayer and Saurel, Phys. Fluids 28 (2016) 046102: liquid water, 300 to 500 K.
inline const NobleAbelStiffenedGas repulsive_water{
    {.gamma = 1.19, .pinf = 7028e5, .b = 6.61e-4, .q = -1177788.0, .specific_heat = 3610.0}};
// Air and a fitted gas with the specific heat that grows with temperature.
inline PerfectGas<Nasa7Heat> warm_air() {
  return {.gas_constant = 287.0, .heat = air_heat(287.0)};
}
inline PerfectGas<PolynomialHeat> fitted_gas() {
  const double fit[] = {1e5, -4e5, 1400.0};
  return {.gas_constant = 300.0, .heat = polynomial_heat(fit, 2, 350.0, 5e3)};
}

// Of each law one material.
inline const auto& examples() {
  static const std::tuple all{
      air,
      stiff_water,
      hard_spheres,
      attracting_gas,
      tnt,
      tnt_isentrope,
      steep_solid,
      BirchMurnaghan{{.n = 5.0, .K = 7e-11, .rho0 = 2e3, .specific_heat = 900.0}},
      copper,
      propellant,
      aluminium,
      ThomsenHartkaWater{},
      KnaussSeaWater{{}},
      repulsive_water,
      warm_air(),
      fitted_gas(),
  };
  return all;
}
// Tests that go through all laws do not compile where one is missing.
template <Law T>
const T& example() {
  return std::get<T>(examples());
}

// One of each, with parameters of real materials.
inline std::vector<EquationOfState> one_of_each() {
  std::vector<EquationOfState> all;
  AllLaws::for_each([&]<class T>() { all.emplace_back(example<T>()); });
  return all;
}

// df/dx by differences of fourth order.
template <class Function>
double slope_of(const Function& f, double x, double h) {
  return (8.0 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12.0 * h);
}

template <Law T>
void check_state(const T& law, double rho, double temp, const StateRange& range,
                 const Tolerances& to) {
  const double E = law.energy_from_temperature(rho, temp), e = E / rho;
  const double p = law.pressure(rho, E), c2 = law.sound_speed_squared(rho, E), K = rho * c2;
  const double h = range.step * rho;
  // Scales: pressure moves by K over the density, by more where parts of p cancel.
  const double scale = c2 + std::abs(p) / rho + std::abs(law.dp_drho(rho, E));
  const auto at = [&](double r, double energy) { return law.pressure(r, r * energy); };
  // 1. Derivatives and sound speed, which is the slope along de = p/rho^2 drho.
  EXPECT_NEAR(law.dp_drho(rho, E), slope_of([&](double r) { return at(r, e); }, rho, h),
              to.slopes * scale);
  const double c2_of_slopes = law.dp_drho(rho, E) + law.dp_de(rho, E) * p / (rho * rho);
  EXPECT_NEAR(c2, c2_of_slopes, 1e-11 * scale);
  const auto along = [&](double r) { return at(r, e + p / rho * (r / rho - 1.0)); };
  EXPECT_NEAR(c2, slope_of(along, rho, h), to.slopes * scale);
  if (T::depends_on_energy) {
    const double part = c2 / std::abs(law.dp_de(rho, E)) * rho;  // dp/de * part = K
    const double de = range.step * std::min(part, 0.1 * std::abs(e) + 0.01 * part);
    EXPECT_NEAR(law.dp_de(rho, E), slope_of([&](double x) { return at(rho, x); }, e, de),
                to.slopes * std::abs(law.dp_de(rho, E)) + 1e-15 * std::abs(p) / de);
  }
  // 2. What the cells of a mixture ask for: rho c^2 and c from density and pressure.
  EXPECT_NEAR(law.bulk_modulus(rho, p), K, 1e-8 * rho * scale);
  EXPECT_NEAR(law.sound_speed(rho, p), std::sqrt(c2), 1e-8 * scale / std::sqrt(c2));
  // 3. Round trips.
  EXPECT_NEAR(law.temperature(rho, E), temp, to.temperature * (temp + 300.0));
  if constexpr (T::depends_on_energy) {
    EXPECT_NEAR(law.energy_from_pressure(rho, p), E,
                to.energy * (std::abs(E) + K / std::abs(law.dp_de(rho, E)) * rho));
  }
  EXPECT_NEAR(law.density(p, temp), rho, to.density * rho * (1.0 + rho * scale / K));
  EXPECT_GT(p, law.lowest_pressure());
  EXPECT_LT(rho, law.highest_density());
}

// Equality of mixed derivatives of the free energy: one entropy exists.
template <Law T>
void check_mixed_derivatives(const T& law, double rho, double temp, const StateRange& range,
                             const Tolerances& to) {
  const auto e = [&](double r) { return law.energy_from_temperature(r, temp) / r; };
  const auto p = [&](double t) { return law.pressure(rho, law.energy_from_temperature(rho, t)); };
  const double here = p(temp), p_T = slope_of(p, temp, range.step * temp);
  const double e_v = -rho * rho * slope_of(e, rho, range.step * rho);
  const double K = law.bulk_modulus(rho, here);
  // c^2 over that at constant temperature.
  const double cv = slope_of([&](double t) { return law.energy_from_temperature(rho, t) / rho; },
                             temp, range.step * temp);
  const double c2_T =
      slope_of([&](double r) { return law.pressure(r, law.energy_from_temperature(r, temp)); }, rho,
               range.step * rho);
  const double ratio =
      law.heat_capacity_ratio(rho, law.energy_from_temperature(rho, temp), temp, cv);
  EXPECT_NEAR(ratio * c2_T, K / rho,
              1e3 * to.mixed * ratio * (K / rho + std::abs(here) / rho + std::abs(c2_T)));
  const double cancel = std::abs(e(rho)) * rho * 1e-16 / range.step;
  EXPECT_NEAR(e_v, temp * p_T - here,
              to.mixed * (K + std::abs(here) + std::abs(temp * p_T)) + 8 * cancel);
}

// Random states; the isotherm rises; states of the range are admissible, broken ones are not.
template <Law T>
void check_law(const T& law, const StateRange& range, const Tolerances& to = {},
               bool one_entropy = true) {
  std::mt19937_64 random(20260701);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const int states = 2000;
  int good = 0;
  for (int i = 0; i < states && !testing::Test::HasFailure(); ++i) {
    const double rho = range.rho_low * std::pow(range.rho_high / range.rho_low, unit(random));
    const double temp = range.T_low * std::pow(range.T_high / range.T_low, unit(random));
    SCOPED_TRACE(testing::Message() << "rho " << rho << " T " << temp);
    const double E = law.energy_from_temperature(rho, temp);
    if (!law.admissible(rho, E)) continue;
    if (range.kink > 0.0 && std::abs(rho / range.kink - 1.0) < 3.0 * range.step) continue;
    ++good;
    check_state(law, rho, temp, range, to);
    if (one_entropy) check_mixed_derivatives(law, rho, temp, range, to);
    const double denser = 1.0001 * rho, p = law.pressure(rho, E);
    const double E_denser = law.energy_from_temperature(denser, temp);
    if (law.admissible(denser, E_denser)) {
      EXPECT_GT(law.pressure(denser, E_denser), p);
    }
    EXPECT_FALSE(law.admissible(-rho, E));
    EXPECT_FALSE(law.admissible(rho, std::numeric_limits<double>::quiet_NaN()));
    EXPECT_FALSE(law.admissible(std::numeric_limits<double>::quiet_NaN(), E));
  }
  EXPECT_GE(good, range.share * states);
}

// Near vacuum and at strong compression: finite numbers, or an honest "not admissible".
template <Law T>
void check_extremes(const T& law, double rho0, double energy) {
  const double top = law.highest_density();
  int good = 0;
  const double densest = std::isfinite(top) ? top * (1.0 - 1e-9) : 1e3 * rho0;
  for (const double rho : {1e-100, 1e-30, 1e-10 * rho0, 1e-3 * rho0, rho0, densest})
    for (const double e : {1e-6 * energy, energy, 1e3 * energy}) {
      SCOPED_TRACE(testing::Message() << "rho " << rho << " e " << e);
      const double E = rho * e;
      if (!law.admissible(rho, E)) continue;
      ++good;
      EXPECT_TRUE(std::isfinite(law.pressure(rho, E)));
      EXPECT_TRUE(std::isfinite(law.dp_drho(rho, E)));
      EXPECT_TRUE(std::isfinite(law.dp_de(rho, E)));
      EXPECT_TRUE(std::isfinite(law.temperature(rho, E)));
      EXPECT_GT(law.sound_speed_squared(rho, E), 0.0);
      EXPECT_TRUE(std::isfinite(law.sound_speed_squared(rho, E)));
    }
  EXPECT_GE(good, 2);
  EXPECT_FALSE(law.admissible(0.0, energy));
  EXPECT_FALSE(law.admissible(rho0, std::numeric_limits<double>::infinity()));
}

}  // namespace sluice::eos
