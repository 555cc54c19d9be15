// A material that is a mixture of two gases itself, beside others.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ice/fluid/mixed_gas.hpp"
#include "ice/test_support/mixture.hpp"

namespace sluice::ice::mixed_material_test {
namespace {

constexpr double w = 2 * std::numbers::pi;

struct TwoGases {
  double cv[2], R[2];
  bool alike() const { return cv[0] == cv[1]; }
};
constexpr TwoGases alike = {{1, 1}, {.4, .4}}, unlike = {{1, 3}, {.4, 2}};
constexpr TwoGases of_one_gamma = {{1, 3}, {.4, 1.2}};
constexpr double mu = .002;  // fronts between materials know one number of each
constexpr double conduction[] = {.002, .004, .003};  // of gas A, gas B, and half way

models::MixedGas gas_of(const TwoGases& g) {
  models::MixedGas gas;
  gas.set_nodes({{0, g.cv[0], g.R[0]}, {1, g.cv[1], g.R[1]}});
  return gas;
}

std::string model(const TwoGases& g) {
  return fmt::format(
      "<Model type='BinaryProperties'><BinaryProperties><material>gas</material>"
      "<scalar name='f'><constants><cv_A>{}</cv_A><cv_B>{}</cv_B><R_A>{}</R_A><R_B>{}</R_B>"
      "<dynamic_viscosity_A>{}</dynamic_viscosity_A><dynamic_viscosity_B>{}</dynamic_viscosity_B>"
      "<thermalCond_A>{}</thermalCond_A><thermalCond_B>{}</thermalCond_B></"
      "constants><geom_object><box label='all'><min>[-9,-9,-9]</min><max>[9,9,9]</max></box>"
      "<scalar>0</scalar></geom_object></scalar></BinaryProperties></Model>",
      g.cv[0], g.cv[1], g.R[0], g.R[1], mu, mu, conduction[0], conduction[g.alike() ? 0 : 1]);
}

// Gas, water and a second gas.
std::vector<Fluid> materials(const Fluid& gas) {
  return {gas, stiffened_gas(4.4, 60), ideal_gas(1.2, 2)};
}

// A disc of water and a square of the second gas.
MixtureCell scene(Vec3 x) {
  MixtureCell c;
  const double disc = std::hypot(x.x - .35, x.y - .5) < .15 ? 1 : 0;
  const double square = std::fabs(x.x - .75) < .13 && std::fabs(x.y - .45) < .2 ? 1 : 0;
  const double share = disc > 0 ? .95 : square;  // some gas in the water
  c.volume = {1 - share, disc > 0 ? share : 0, square};
  c.density = {1, 30, .5};
  c.pressure = {1, 1, 1};
  return c;
}
MixtureCell shocked(Vec3 x) {
  MixtureCell c = scene(x);
  if (x.x < .15) {
    c.density = {2, 30, 1};
    c.pressure = {4, 4, 4};
    c.velocity[0] = .8;
  }
  c.velocity[0] += .13;
  c.velocity[1] = .1 * std::sin(w * x.x) + .07;
  return c;
}

class MixedRun : public MixtureBox {
 public:
  MixedRun(const GasBox& box, const TwoGases& gases, const std::function<MixtureCell(Vec3)>& start,
           const Transport& transport = {}, const SolverOptions& options = {}, IntVec3 boxes = {})
      : MixtureBox(with(box, gases),
                   materials(ideal_gas(1 + gases.R[0] / gases.cv[0], gases.cv[0])), start, options,
                   boxes, transport),
        gas_(gas_of(gases)),
        fraction_(ice().state().slots().back().label) {}

  double& fraction(IntVec3 c) const { return view(fraction_, 0, 0, c)(c); }
  // Fractions by place; density where given, and the energy of the pressure.
  void mix(const std::function<double(Vec3)>& f, const std::function<double(double)>& density = {},
           double pressure = -1) {
    for_each_cell(domain(), [&](IntVec3 c) {
      if (mass(0, c) == 0) return;
      const double q = f(level().centre(c)), V = volume(0, c);
      double& M = view(labels().mass, 0, 0, c)(c);
      const int components = domain().size().y > 1 ? 2 : 1;
      double u[2];
      for (int d = 0; d < components; ++d) u[d] = velocity(c, d);
      fraction(c) = q;
      if (density) M = V * density(q);
      double& E = view(labels().energy, 0, 0, c)(c);
      const double p = pressure > 0 ? pressure : (gas_.nodes()[0].R / gas_.nodes()[0].cv) * E / V;
      E = V * p / gas_.at(q).ratio();
      for (int d = 0; d < components; ++d)
        view(labels().momentum, 0, d, c)(c) = this->density(c) * u[d];
    });
    solver().mark_modified();
  }
  double gas_pressure(IntVec3 c) const {
    return gas_.at(fraction(c)).ratio() * energy(0, c) / volume(0, c);
  }
  double gas_temperature(IntVec3 c) const {
    return energy(0, c) / (mass(0, c) * gas_.specific_heat(fraction(c)));
  }

 private:
  static GasBox with(GasBox box, const TwoGases& gases) {
    box.models = model(gases);
    return box;
  }

  models::MixedGas gas_;
  Label fraction_;
};

GasBox box_of(const char* order, bool closed) {
  GasBox box;
  box.cells = {40, 32, 1};
  box.scheme = "conservative";
  box.advection = order;
  if (closed) {
    box.periodic = false;
    box.walls = true;
  }
  return box;
}
constexpr const char* first = "type='FirstOrder'";
constexpr const char* second = "type='SecondOrder'";

double wavy(Vec3 x) {
  return .5 + .5 * std::sin(w * x.x) * std::cos(w * x.y);
}

// Largest difference of two runs, as a share of the largest value of each kind.
double distance(const MixtureBox& a, const MixtureBox& b) {
  const std::vector<double> x = bits_of(a, false), y = bits_of(b, false);
  const std::size_t each = x.size() / a.domain().volume();
  std::vector<double> most(each, 0.0), apart(each, 0.0);
  for (std::size_t n = 0; n < x.size(); ++n) {
    most[n % each] = std::fmax(most[n % each], std::fabs(x[n]));
    apart[n % each] = std::fmax(apart[n % each], std::fabs(x[n] - y[n]));
  }
  double worst = 0;
  for (std::size_t k = 0; k < each; ++k) worst = std::fmax(worst, apart[k] / most[k]);
  return worst;
}

// Two gases of the same law: whatever the fraction, the run is that of the gas without a model; and
// of two that differ, where the fraction is one half everywhere, that of the gas half way between
// (faces take the largest gamma: these have the same). With heat exchange, friction and conduction,
// of first order: slopes of a mixed gas have bounds of their own.
TEST(MixedMaterial, IsTheGasOfItsFraction) {
  Transport exchange;
  exchange.heat_exchange = 5;
  const GasBox box = box_of(first, true);
  for (const bool halves : {false, true}) {
    const TwoGases& gases = halves ? of_one_gamma : alike;
    const double cv = .5 * (gases.cv[0] + gases.cv[1]), R = .5 * (gases.R[0] + gases.R[1]);
    exchange.viscosity = {mu, .01, 0};
    exchange.conductivity = {conduction[halves ? 2 : 0], .01, .002};
    MixtureBox plain(box, materials(ideal_gas(1 + R / cv, cv)), shocked, {}, {}, exchange);
    exchange.conductivity[0] = conduction[halves ? 1 : 0];  // the largest
    MixedRun mixed(box, gases, shocked, exchange);
    mixed.mix([&](Vec3 x) { return halves ? .5 : wavy(x); });
    for (int step = 0; step < 60; ++step) {
      for (MixtureBox* run : {&plain, static_cast<MixtureBox*>(&mixed)}) run->step(1.5e-3);
    }
    const double apart = distance(plain, mixed);
    RecordProperty(halves ? "half way" : "alike", fmt::format("{}", apart));
    std::printf("%d: %.2e\n", halves, apart);
    EXPECT_LE(apart, 1e-12);
  }
}

// Any fractions at one pressure, temperature and velocity keep all three, beside others and in
// cells with them.
TEST(MixedMaterial, KeepsOnePressureTemperatureAndVelocity) {
  constexpr double T = 2.5, u = .3;
  for (const bool flat : {true, false}) {
    GasBox box = box_of(second, false);
    if (flat) box.cells.y = 1;
    const auto moving = [&](Vec3 x) {
      if (flat) x.y = .5;
      MixtureCell c = scene(x);
      c.velocity[0] = u;
      c.velocity[1] = flat ? 0 : -.2;
      return c;
    };
    MixedRun run(box, unlike, moving);
    const models::MixedGas gas = gas_of(unlike);
    run.mix([&](Vec3 x) { return flat ? .5 + .5 * std::sin(w * x.x) : wavy(x); },
            [&](double f) { return 1 / (gas.at(f)(&models::MixedGas::Node::R) * T); }, 1);
    run.steps(200);
    double pressure = 0, temperature = 0, velocity = 0, range[2] = {1, 0};
    for_each_cell(run.domain(), [&](IntVec3 c) {
      velocity = std::fmax(velocity, std::fabs(run.velocity(c) - u));
      if (run.mass(0, c) == 0) return;
      pressure = std::fmax(pressure, std::fabs(run.gas_pressure(c) - 1));
      if (run.volume(0, c) > 1e-6)
        temperature = std::fmax(temperature, std::fabs(run.gas_temperature(c) / T - 1));
      range[0] = std::fmin(range[0], run.fraction(c));
      range[1] = std::fmax(range[1], run.fraction(c));
    });
    std::printf("flat %d: p %.1e T %.1e u %.1e, f %g to %g\n", flat, pressure, temperature,
                velocity, range[0], range[1]);
    EXPECT_LE(pressure, flat ? 1e-12 : 1e-5);
    EXPECT_LE(temperature, flat ? 1e-11 : 1e-5);
    EXPECT_LE(velocity, flat ? 1e-12 : 1e-5);
    EXPECT_GE(range[0], 0);
    EXPECT_LE(range[1], 1);
    EXPECT_GT(range[1] - range[0], .5);
  }
}

// Masses, the amount of the second gas, and energy, in a closed box with a shock and exchange.
TEST(MixedMaterial, KeepsWhatItHolds) {
  Transport exchange;
  exchange.heat_exchange = 5;
  MixedRun run(box_of(second, true), unlike, shocked, exchange);
  run.mix(wavy);
  const Totals before = run.totals();
  run.steps(200);
  const Totals after = run.totals();
  const auto sum = [](const auto& total) { return total.sum.value(); };
  const auto energy = [&](const Totals& t) {
    return sum(t.internal_energy) + sum(t.kinetic_energy);
  };
  EXPECT_NEAR(energy(after) / energy(before), 1, 1e-13);
  ASSERT_EQ(after.amounts.size(), 1u);
  EXPECT_NEAR(sum(after.amounts[0]) / sum(before.amounts[0]), 1, 1e-13);
  double low = 1, high = 0;
  for_each_cell(run.domain(), [&](IntVec3 c) {
    const double f = run.fraction(c);
    EXPECT_EQ(run.mass(0, c) == 0 && f != 0, false);
    low = std::fmin(low, f);
    high = std::fmax(high, f);
  });
  EXPECT_GE(low, 0);
  EXPECT_LE(high, 1);
}

TEST(MixedMaterial, IsTheSameHoweverCut) {
  GasBox box = box_of(second, true);
  box.cells = {48, 40, 1};
  Transport exchange;
  exchange.heat_exchange = 5;
  exchange.viscosity = {mu, .01, 0};
  exchange.conductivity = {conduction[1], .01, .002};
  expect_same_bits_however_cut([&](const SolverOptions& options, IntVec3 boxes) {
    MixedRun run(box, unlike, shocked, exchange, options, boxes);
    run.mix(wavy);
    run.steps(25);
    std::vector<double> bits = bits_of(run, false);
    for_each_cell(run.domain(), [&](IntVec3 c) { bits.push_back(run.fraction(c)); });
    return bits;
  });
}

}  // namespace
}  // namespace sluice::ice::mixed_material_test
