// Riemann problems of two materials against published star states, the one-gas solver, the balance
// of mass, momentum and energy over a domain, and independent closed forms.
#include "exact/riemann/material_riemann.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "eos/eos_test_support.hpp"
#include "exact/riemann/riemann.hpp"
#include "exact/test_support/material_test_support.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact::material_riemann_test {
namespace {

MaterialSide products(double density, double velocity, double pressure) {
  return {eos::tnt, state_of_pressure(eos::tnt, density, velocity, pressure)};
}

struct Star {
  const char* name;
  MaterialSide left, right;
  double p, u, rho_left, rho_right, left_head, left_tail, right_speed;
};

class PublishedStars : public testing::TestWithParam<Star> {};

// Eight digits of an independent solver whose one-gas cases agree with published tables.
TEST_P(PublishedStars, AreMet) {
  const Star& want = GetParam();
  for (const auto formulas : {WaveFormulas::closed_if_any, WaveFormulas::general}) {
    const MaterialRiemann got(want.left, want.right, formulas);
    const auto near = [](double value, double wanted, double digits) {
      EXPECT_NEAR(value, wanted, digits * std::abs(wanted)) << wanted;
    };
    near(got.star_pressure(), want.p, 1e-7);
    EXPECT_NEAR(got.star_velocity(), want.u, 1e-7 * std::abs(want.u) + 1e-9);
    near(got.star_left().density, want.rho_left, 1e-7);
    near(got.star_right().density, want.rho_right, 1e-7);
    near(got.left_wave().head, want.left_head, 5e-5);
    near(got.left_wave().tail, want.left_tail, 5e-5);
    near(got.right_wave().head, want.right_speed, 5e-5);
    EXPECT_EQ(got.right_wave().head, got.right_wave().tail);
  }
}

INSTANTIATE_TEST_SUITE_P(
    TwoMaterials, PublishedStars,
    testing::Values(Star{"two_gamma", gas(2, 1, 0, 2), gas(1.4, .125, 0, .1), .43033194, 1.2757097,
                         .46385986, .32537956, -2, -.0864355, 2.07152},
                    Star{"air_helium", gas(1.4, 1.3333, .3535 * std::sqrt(1e5), 1.5e5),
                         gas(1.67, .1379, 0, 1e5), 126614.66, 159.25517, 1.1812757, .15876316,
                         -285.08, -228.12, 1211.89},
                    Star{"water_dense_air", water(1000, 0, 1e9), gas(1.4, 50, 0, 1e5), 1.4190477e7,
                         482.61041, 804.44463, 288.16806, -2653.3, -1350.3, 583.93},
                    Star{"water_air", water(1000, 0, 1e9), gas(1.4, 1, 0, 1e5), 4.7969063e5,
                         491.97388, 800.32762, 2.7583307, -2653.3, -1324.97, 771.77},
                    Star{"gas_water", gas(1.4, 1270, 0, 8e8), water(1000, 0, 1e5), 5.3350009e8,
                         264.05232, 950.87018, 1150.3713, -939.0951, -622.2153, 2020.05},
                    Star{"water_hammer", water(1000, 100, 1e5), water(1000, -100, 1e5), 1.7665413e8,
                         0, 1060.0405, 1060.0405, -1665.54, -1665.54, 1665.54}),
    [](const auto& test) { return std::string(test.param.name); });

// The solver of one-gas problems shares no code with this one.
TEST(MaterialRiemann, MeetsTheIdealGasSolver) {
  struct Case {
    GasState left, right;
  };
  for (const Case& c : {Case{{1, 0, 1}, {.125, 0, .1}}, Case{{1, -2, .4}, {1, 2, .4}},
                        Case{{1, 0, 1000}, {1, 0, .01}}, Case{{1, 0, 500}, {1, 0, .2, 1.667}},
                        Case{{5.99924, 19.5975, 460.894}, {5.99242, -6.19633, 46.095}},
                        Case{{1, 0, 1. / 15, 5. / 3}, {1e-3, 0, 1e-10 / 1.5, 5. / 3}}}) {
    const RiemannSolution want(c.left, c.right);
    const MaterialSide l = gas(c.left.gamma, c.left.density, c.left.velocity, c.left.pressure);
    const MaterialSide r = gas(c.right.gamma, c.right.density, c.right.velocity, c.right.pressure);
    for (const auto formulas : {WaveFormulas::closed_if_any, WaveFormulas::general}) {
      const MaterialRiemann got(l, r, formulas);
      const double low = want.left_wave().head, wide = want.right_wave().head - low;
      EXPECT_NEAR(got.star_pressure(), want.star_pressure(), 1e-11 * want.star_pressure());
      for (int i = -20; i < 130; ++i) {
        const double speed = low + (0.0100123 * i + 1e-4) * wide;
        const GasState a = want.sample(speed);
        const auto [b, side] = got.sample(speed);
        EXPECT_NEAR(a.density, b.density, 1e-11 * a.density) << i;
        EXPECT_NEAR(a.velocity, b.velocity, 1e-12 * wide) << i;
        EXPECT_NEAR(a.pressure, b.pressure, 1e-11 * a.pressure) << i;
        EXPECT_EQ(side, speed < want.star_velocity() ? 0 : 1);
      }
    }
  }
}

TEST(MaterialRiemann, GeneralPathMeetsTheClosedOneToTenDigits) {
  struct Case {
    MaterialSide left, right;
  };
  for (const Case& c : {Case{water(1000, 0, 1e9), gas(1.4, 50, 0, 1e5)},
                        Case{water(1000, 0, 1e9), gas(1.4, 1.2, 0, 1e5)},
                        Case{gas(1.4, 6.26, 1000, 2e6), water(1000, 0, 1e5)},
                        Case{water(1000, -20, 1e5), water(1000, 20, 1e6)}}) {
    const MaterialRiemann closed(c.left, c.right);
    const MaterialRiemann general(c.left, c.right, WaveFormulas::general);
    const double low = closed.left_wave().head, wide = closed.right_wave().head - low;
    for (int i = -5; i < 105; ++i) {
      const double speed = low + 0.0100123 * i * wide;
      const FluidState a = closed.sample(speed).state, b = general.sample(speed).state;
      EXPECT_NEAR(a.density, b.density, 1e-10 * a.density) << i;
      EXPECT_NEAR(a.velocity, b.velocity, 1e-10 * wide) << i;
      EXPECT_NEAR(a.pressure, b.pressure, 1e-10 * std::abs(a.pressure) + 1e-14 * 2.6e9) << i;
      EXPECT_NEAR(a.energy, b.energy, 1e-10 * std::abs(a.energy)) << i;
    }
  }
}

// Mass of each material, momentum and energy in a domain that the waves have not left: what was
// there at the start, and the work and impulse of the pressures at its ends.
void check_balance(const MaterialSide& left, const MaterialSide& right) {
  const MaterialRiemann flow(left, right);
  const double reach =
      1.1 * std::max(std::abs(flow.left_wave().head), std::abs(flow.right_wave().head));
  double mass[2] = {0, 0}, momentum = 0, energy = 0, size = 0;
  // Gauss' rule of three points on pieces between the waves, fans in 200 parts.
  const auto add = [&](double from, double to, int parts) {
    for (int k = 0; k < parts; ++k) {
      const double half = 0.5 * (to - from) / parts, middle = from + (2 * k + 1) * half;
      const double nodes[] = {-std::sqrt(.6), 0, std::sqrt(.6)},
                   weights[] = {5. / 9, 8. / 9, 5. / 9};
      for (int n = 0; n < 3; ++n) {
        const auto [s, side] = flow.sample(middle + half * nodes[n]);
        const double w = half * weights[n] * s.density,
                     e = s.energy + 0.5 * s.velocity * s.velocity;
        mass[side] += w;
        momentum += w * s.velocity;
        energy += w * e;
        size += std::abs(w * e);
      }
    }
  };
  add(-reach, flow.left_wave().head, 1);
  add(flow.left_wave().head, flow.left_wave().tail, 200);
  add(flow.left_wave().tail, flow.star_velocity(), 1);
  add(flow.star_velocity(), flow.right_wave().tail, 1);
  add(flow.right_wave().tail, flow.right_wave().head, 200);
  add(flow.right_wave().head, reach, 1);
  const FluidState &l = left.state, &r = right.state;
  const double in = l.density * (reach + l.velocity), out = r.density * (reach - r.velocity);
  const auto total = [](const FluidState& s) { return s.energy + 0.5 * s.velocity * s.velocity; };
  const double push = l.pressure - r.pressure;
  const double work = l.pressure * l.velocity - r.pressure * r.velocity;
  EXPECT_NEAR(mass[0], in, 1e-10 * in);
  EXPECT_NEAR(mass[1], out, 1e-10 * out);
  const double impulse = in * l.velocity + out * r.velocity + push;
  EXPECT_NEAR(momentum, impulse, 1e-10 * (std::abs(push) + (in + out) * reach));
  EXPECT_NEAR(energy, in * total(l) + out * total(r) + work, 1e-10 * (size + std::abs(work)));
}

TEST(MaterialRiemann, BalancesOfMassMomentumAndEnergyClose) {
  const auto solid = [](const eos::EquationOfState& law, double density, double velocity) {
    return MaterialSide{law, state_of_temperature(law, density, velocity, 300)};
  };
  check_balance(products(1840, 0, 14.5e9), gas(1.4, 1.2, 0, 1e5));
  check_balance(products(1840, 0, 14.5e9), water(1000, 0, 1e5));
  check_balance(products(1630, 0, 1e10), solid(eos::steep_solid, 1160, 0));
  check_balance(gas(1.4, 1.2, 0, 1e5), products(1840, 0, 14.5e9));
  check_balance(solid(eos::copper, 8930, 500), solid(eos::aluminium, 2720, -500));
  check_balance(water(1000, 0, 1e9), solid(eos::copper, 8930, 0));
  check_balance(solid(eos::warm_air(), 5, 0), solid(eos::KnaussSeaWater{{}}, 1030, 0));
  check_balance(solid(eos::hard_spheres, 200, 0), solid(eos::air, 1.2, 0));
}

// Shocks and fans of a Noble-Abel stiffened gas are those of an ideal gas in p + pinf and v - b.
TEST(MaterialRiemann, OfANobleAbelStiffenedGasHasItsClosedForm) {
  const eos::NobleAbelStiffenedGas& law = eos::repulsive_water;
  const double g = law.gamma, v0 = 1e-3, free = v0 - law.b;
  const auto volume = [&](double p, double p0) {  // behind a wave from p0 to p
    const double P = p + law.pinf, P0 = p0 + law.pinf;
    return law.b + free * (p > p0 ? ((g - 1) * P + (g + 1) * P0) / ((g + 1) * P + (g - 1) * P0)
                                  : std::pow(P0 / P, 1 / g));
  };
  const auto speed = [&](double p, double p0) {
    const double P = p + law.pinf, P0 = p0 + law.pinf;
    if (p > p0) return std::sqrt((p - p0) * (v0 - volume(p, p0)));
    return 2 / (g - 1) * std::sqrt(g * P0 * free) * (std::pow(P / P0, (g - 1) / (2 * g)) - 1);
  };
  const auto side = [&](double p) {
    return MaterialSide{law, state_of_pressure(law, 1 / v0, 0, p)};
  };
  const MaterialRiemann flow(side(1e9), side(1e5));
  const double p = flow.star_pressure();
  EXPECT_NEAR(speed(p, 1e9) + speed(p, 1e5), 0, 1e-9 * flow.star_velocity());
  EXPECT_NEAR(flow.star_velocity(), speed(p, 1e5), 1e-9 * flow.star_velocity());
  EXPECT_NEAR(flow.star_left().density * volume(p, 1e9), 1, 1e-9);
  EXPECT_NEAR(flow.star_right().density * volume(p, 1e5), 1, 1e-9);
}

// The shock in the air and the isentrope of the products, each in closed form, meet at p*.
TEST(MaterialRiemann, JwlProductsPushTheAirAsFastAsTheyFollow) {
  const eos::Jwl& law = eos::tnt;
  const MaterialSide left = products(1840, 0, 14.5e9), right = gas(1.4, 1.2, 0, 1e5);
  const MaterialRiemann flow(left, right);
  const double p = flow.star_pressure(), rho0 = left.state.density;
  EXPECT_NEAR(flow.star_velocity(), (p - 1e5) * std::sqrt(2 / (2.4 * 1.2) / (p + .4 / 2.4 * 1e5)),
              1e-9 * flow.star_velocity());
  const double V0 = law.rho0 / rho0;
  const double C = (14.5e9 - law.A * std::exp(-law.R1 * V0) - law.B * std::exp(-law.R2 * V0)) *
                   std::pow(V0, 1 + law.om);
  const auto c_squared = [&](double rho) {  // dp/drho along the isentrope
    const double V = law.rho0 / rho;
    return (law.A * law.R1 * std::exp(-law.R1 * V) + law.B * law.R2 * std::exp(-law.R2 * V) +
            C * (1 + law.om) * std::pow(V, -2 - law.om)) *
           V / rho;
  };
  // Integral of c dlnrho by Simpson's rule in 20,000 parts.
  const double low = std::log(flow.star_left().density), high = std::log(rho0);
  double sum = 0;
  const int n = 20000;
  for (int k = 0; k <= n; ++k) {
    const double c = std::sqrt(c_squared(std::exp(low + (high - low) * k / n)));
    sum += c * (k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2);
  }
  EXPECT_NEAR(flow.star_velocity(), sum * (high - low) / (3 * n), 1e-9 * flow.star_velocity());
}

TEST(MaterialRiemann, MirroredStatesGiveMirroredBits) {
  const auto image = [](MaterialSide side) {
    side.state = mirrored(side.state);
    return side;
  };
  struct Case {
    MaterialSide left, right;
  };
  for (const Case& c : {Case{gas(1.4, 1, .75, 1), gas(1.667, .125, -.1, .1)},
                        Case{water(1000, 3, 1e9), gas(1.4, 1.2, 7, 1e5)},
                        Case{products(1840, 10, 14.5e9), gas(1.4, 1.2, -5, 1e5)}}) {
    const MaterialRiemann forward(c.left, c.right), backward(image(c.right), image(c.left));
    EXPECT_EQ(forward.star_pressure(), backward.star_pressure());
    EXPECT_EQ(forward.star_velocity(), -backward.star_velocity());
    const double low = forward.left_wave().head, wide = forward.right_wave().head - low;
    for (int i = -10; i < 110; ++i) {
      const double speed = low + .01003 * i * wide;
      const auto a = forward.sample(speed), b = backward.sample(-speed);
      EXPECT_EQ(a.state.density, b.state.density) << i;
      EXPECT_EQ(a.state.velocity, -b.state.velocity) << i;
      EXPECT_EQ(a.state.pressure, b.state.pressure) << i;
      EXPECT_EQ(forward.temperature(a), backward.temperature(b)) << i;
      EXPECT_EQ(a.side, 1 - b.side) << i;
    }
  }
}

TEST(MaterialRiemann, LiquidsBearTensionAndGasesPart) {
  // Symmetric pull: p* is where one rarefaction takes all of the velocity.
  const MaterialRiemann pulled(water(1000, -50, 1e5), water(1000, 50, 1e5));
  EXPECT_LT(pulled.star_pressure(), -7e7);
  EXPECT_GT(pulled.star_pressure(), -9e7);
  EXPECT_EQ(pulled.star_velocity(), 0);
  // A metal, whose law ends in tension far above its lower bound of the pressure: about -rho c u.
  const auto metal = [](double velocity) {
    return MaterialSide{eos::copper, state_of_temperature(eos::copper, 8930, velocity, 294)};
  };
  const double pull = MaterialRiemann(metal(-50), metal(50)).star_pressure();
  EXPECT_NEAR(pull, -8930 * 3940 * 50., .03 * 8930 * 3940 * 50);
  // A gas at the water keeps the pressure above zero.
  const MaterialRiemann pair(water(1000, -50, 1e5), gas(1.4, 1.2, 50, 1e5));
  EXPECT_GT(pair.star_pressure(), 0);
  EXPECT_THROW(MaterialRiemann(gas(1.4, 1, -50, .4), gas(1.4, 1, 50, .4)), InputError);
  EXPECT_THROW(MaterialRiemann(water(1000, -1e4, 1e5), water(1000, 1e4, 1e5)), InputError);
}

TEST(MaterialRiemann, NothingHappensInEquilibrium) {
  const MaterialRiemann still(water(1000, 30, 1e5), products(20, 30, 1e5));
  EXPECT_NEAR(still.star_pressure(), 1e5, 1e-6);
  EXPECT_NEAR(still.star_velocity(), 30, 1e-11);
  EXPECT_NEAR(still.star_left().density, 1000, 1e-9);
}

}  // namespace
}  // namespace sluice::exact::material_riemann_test
