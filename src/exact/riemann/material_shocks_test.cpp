// Shocks by Mach number, reflections and transmissions against closed forms and measurements.
#include "exact/riemann/material_shocks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "eos/eos_test_support.hpp"
#include "exact/test_support/material_test_support.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact::material_shocks_test {
namespace {

double impedance(const MaterialSide& side) {
  return side.state.density * sound_speed(side.law, side.state);
}

TEST(MaterialShocks, MachNumberGivesTheJumpsOfAnIdealGas) {
  const MaterialSide air = gas(1.4, 1.2, 30, 1e5);
  const double c = sound_speed(air.law, air.state);
  for (const double mach : {1.001, 1.22, 3.0, 50.0}) {
    for (const int direction : {1, -1}) {
      const Wave wave = shock_of_mach(air, mach, direction);
      const double m2 = mach * mach;
      EXPECT_NEAR(wave.head, 30 + direction * mach * c, 1e-10 * c);
      EXPECT_EQ(wave.head, wave.tail);
      EXPECT_NEAR(wave.behind.pressure, 1e5 * (1 + 2.8 / 2.4 * (m2 - 1)), 1e-7 * m2);
      EXPECT_NEAR(wave.behind.density, 1.2 * 2.4 * m2 / (.4 * m2 + 2), 1e-10);
      EXPECT_NEAR(wave.behind.velocity, 30 + direction * 2 / 2.4 * c * (mach - 1 / mach), 1e-9 * c);
      const Wave same = wave_to_pressure(air, wave.behind.pressure, direction);
      EXPECT_EQ(same.behind.velocity, wave.behind.velocity);
    }
  }
}

// The same for a law without formula: the Mach number comes back from the balance of momentum.
TEST(MaterialShocks, MachNumberOfAnyLaw) {
  const MaterialSide metal{eos::copper, state_of_temperature(eos::copper, 8930, 0, 294)};
  const Wave wave = shock_of_mach(metal, 1.5, 1);
  const double c = sound_speed(metal.law, metal.state);
  EXPECT_NEAR(wave.head, 1.5 * c, 1e-9 * c);
  EXPECT_NEAR(wave.behind.pressure - metal.state.pressure, 8930 * wave.head * wave.behind.velocity,
              1e-11 * wave.behind.pressure);
}

// p5/p2 = ((3g - 1) p2/p1 - (g - 1)) / ((g - 1) p2/p1 + g + 1) (Landau and Lifshitz, section 100).
TEST(MaterialShocks, ReflectionFromARigidWall) {
  const MaterialSide air = gas(1.4, 1.2, 0, 1e5);
  for (const double ratio : {1.01, 2.0, 20.0, 1e6}) {
    const Wave incident = wave_to_pressure(air, ratio * 1e5, 1);
    const Wave reflected = wave_from_wall({air.law, incident.behind}, 0, -1);
    const double want = (3.2 * ratio - .4) / (.4 * ratio + 2.4);
    EXPECT_NEAR(reflected.behind.pressure / incident.behind.pressure, want, 1e-11 * want);
    EXPECT_NEAR(reflected.behind.velocity, 0, 1e-10 * incident.head);
    EXPECT_LT(reflected.head, 0);
    const ShockMeetsInterface wall(air, std::nullopt, ratio * 1e5, .2, .7);
    EXPECT_NEAR(wall.after().star_pressure(), reflected.behind.pressure,
                1e-11 * reflected.behind.pressure);
    EXPECT_EQ(wall.after().star_velocity(), 0);
    EXPECT_NEAR(wall.arrival_time(), .5 / incident.head, 1e-15);
    EXPECT_NEAR(wall.after().left_wave().head, reflected.head, 1e-10 * incident.head);
  }
}

// Joukowsky's surge rho c u, and the published collision of two streams of water at 100 m/s.
TEST(MaterialShocks, WaterHammer) {
  const MaterialSide slow = water(1000, .01, 1e5);
  const Wave surge = wave_from_wall(slow, 0, -1);
  EXPECT_NEAR(surge.behind.pressure - 1e5, impedance(slow) * .01, 1e-4 * impedance(slow) * .01);
  const Wave hard = wave_from_wall(water(1000, 100, 1e5), 0, -1);
  EXPECT_NEAR(hard.behind.pressure, 1.7665413e8, 10);
  EXPECT_NEAR(hard.behind.density, 1060.0405, 5e-5);
  EXPECT_NEAR(hard.head, -1665.54, 5e-3);
  // A wall that draws back: the fan of a piston in a gas, u = 2 (c0 - c)/(g - 1).
  const MaterialSide air = gas(1.4, 1.2, 0, 1e5);
  const double c0 = sound_speed(air.law, air.state);
  const Wave fan = wave_from_wall(air, -200, 1);
  EXPECT_NEAR(sound_speed(air.law, fan.behind), c0 - .2 * 200, 1e-10);
  EXPECT_NEAR(fan.head, c0, 1e-12);
  EXPECT_NEAR(fan.tail, -200 + c0 - 40, 1e-9);
  EXPECT_THROW(wave_from_wall(air, -5.1 * c0, 1), InputError);
}

// Weak shocks: transmitted 2 Z2/(Z1 + Z2), reflected (Z2 - Z1)/(Z1 + Z2) of the incident pressure.
TEST(MaterialShocks, WeakShocksFollowTheImpedances) {
  const MaterialSide air = gas(1.4, 1.2, 0, 1e5), helium = gas(1.67, .166, 0, 1e5);
  const MaterialSide sea = water(1000, 0, 1e5);
  for (const auto& [first, second] :
       {std::pair{air, helium}, std::pair{air, sea}, std::pair{sea, air}, std::pair{helium, air}}) {
    const double dp = first.state.pressure * 1e-5;
    const ShockMeetsInterface hit(first, second, first.state.pressure + dp, 0, 1);
    const double z1 = impedance(first), z2 = impedance(second);
    EXPECT_NEAR((hit.after().star_pressure() - 1e5) / dp, 2 * z2 / (z1 + z2), 3e-5);
  }
}

// Haas and Sturtevant, J. Fluid Mech. 181 (1987) 41-76: a shock of Mach 1.22 in air meets a bubble
// of helium with 28 % of air, or of R22. Measured speeds of the shock, of what runs ahead in the
// gas: 410, 900 m/s (helium); 415, 240 m/s (R22), to 10 %. Quirk and Karni, J. Fluid Mech. 318
// (1996) 129-163, computed 422, 943; 420, 254 m/s. A plane front is faster in helium, where that of
// a bubble spreads (here 983 m/s), and slower in R22, where it gathers.
TEST(MaterialShocks, RefractionIntoBubblesOfHeliumAndR22) {
  const double pressure = 101325, c_air = 343.3, rho_air = 1.4 * pressure / (c_air * c_air);
  const MaterialSide air = gas(1.4, rho_air, 0, pressure);
  const MaterialSide helium = gas(1.648, rho_air * .287 / 1.578, 0, pressure);
  const MaterialSide r22 = gas(1.249, rho_air * .287 / .091, 0, pressure);
  const Wave shock = shock_of_mach(air, 1.22, 1);
  EXPECT_NEAR(shock.head, 420, .01 * 420);
  EXPECT_NEAR(shock.behind.pressure / pressure, 1.5698, 1e-4);
  const ShockMeetsInterface light(air, helium, shock.behind.pressure, 0, 1);
  const double in_helium = light.after().right_wave().head;
  EXPECT_NEAR(in_helium, 900, .1 * 900);
  EXPECT_NEAR(in_helium, 943, .05 * 943);
  EXPECT_GT(in_helium, 943);
  EXPECT_LT(light.after().star_pressure(), shock.behind.pressure);  // a fan comes back
  const ShockMeetsInterface heavy(air, r22, shock.behind.pressure, 0, 1);
  const double in_r22 = heavy.after().right_wave().head;
  EXPECT_NEAR(in_r22, 240, .1 * 240);
  EXPECT_NEAR(in_r22, 254, .1 * 254);
  EXPECT_GT(heavy.after().star_pressure(), shock.behind.pressure);  // a shock comes back
}

TEST(ShockMeetsInterface, IsOneShockBeforeAndTwoWavesAfter) {
  const MaterialSide air = gas(1.4, 1.2, 5, 1e5), sea = water(1000, 5, 1e5);
  const ShockMeetsInterface flow(air, sea, 20e5, .2, .6);
  const double t = flow.arrival_time();
  EXPECT_NEAR(flow.arrival_position(), .2 + flow.incident().head * t, 1e-14);
  EXPECT_NEAR(flow.arrival_position(), .6 + 5 * t, 1e-14);
  EXPECT_EQ(flow.at(.19, 0).state.pressure, flow.incident().behind.pressure);
  EXPECT_EQ(flow.at(.21, 0).state.pressure, 1e5);
  EXPECT_EQ(flow.at(.59, 0).side, 0);
  EXPECT_EQ(flow.at(.61, 0).side, 1);
  const double shock = .2 + flow.incident().head * .5 * t;
  EXPECT_EQ(flow.at(shock - 1e-9, .5 * t).state.pressure, flow.incident().behind.pressure);
  EXPECT_EQ(flow.at(shock + 1e-9, .5 * t).state.density, 1.2);
  const auto late = flow.at(flow.arrival_position() + 1e-4, 2 * t);
  EXPECT_EQ(late.state.pressure, flow.after().star_pressure());
  // Water hardly moves: nearly the wall's pressure.
  const Wave wall = wave_from_wall({air.law, flow.incident().behind}, 5, -1);
  EXPECT_NEAR(flow.after().star_pressure(), wall.behind.pressure, .02 * wall.behind.pressure);
  EXPECT_LT(flow.after().star_pressure(), wall.behind.pressure);
}

TEST(ShockMeetsInterface, RefusesWhatIsNoShockAtAnInterface) {
  const MaterialSide air = gas(1.4, 1.2, 0, 1e5);
  EXPECT_THROW(ShockMeetsInterface(air, water(1000, 1, 1e5), 2e5, 0, 1), InputError);
  EXPECT_THROW(ShockMeetsInterface(air, water(1000, 0, 2e5), 2e5, 0, 1), InputError);
  EXPECT_THROW(ShockMeetsInterface(air, water(1000, 0, 1e5), .5e5, 0, 1), InputError);
  EXPECT_THROW(ShockMeetsInterface(air, water(1000, 0, 1e5), 2e5, 1.1, 1), InputError);
  EXPECT_THROW(shock_of_mach(air, 1, 1), InputError);
  EXPECT_THROW(wave_to_pressure(air, 2e5, 0), InputError);
}

}  // namespace
}  // namespace sluice::exact::material_shocks_test
