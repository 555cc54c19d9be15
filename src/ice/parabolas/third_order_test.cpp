// Steps of the third order: order in smooth flow, positive states behind strong waves,
// conservation, mirror images, small waves, columns at rest.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ice/test_support/mixture.hpp"

namespace sluice::ice::third_order_test {
namespace {

constexpr double pi = std::numbers::pi;

GasBox gas_box(IntVec3 cells, double cfl = 0.8, bool periodic = true) {
  GasBox box;
  box.cells = cells;
  box.cfl = cfl;
  box.periodic = periodic;
  box.scheme = "conservative";
  box.advection = "type='ThirdOrder'";
  return box;
}

MixtureCell gas(double density, double pressure, double u = 0, double v = 0, double w = 0) {
  MixtureCell c;
  c.volume = {1};
  c.density = {density};
  c.pressure = {pressure};
  c.velocity[0] = u;
  c.velocity[1] = v;
  c.velocity[2] = w;
  return c;
}

// Mean of 1 + .2 sin 2 pi x over a cell around x.
double mean_of_wave(double x, double dx) {
  const double k = 2 * pi;
  return 1 + 0.2 * (std::cos(k * (x - 0.5 * dx)) - std::cos(k * (x + 0.5 * dx))) / (k * dx);
}

// Mean error of the density after the wave has gone once through the box.
double error_of_entropy_wave(int n, const Fluid& fluid) {
  const double dx = 1.0 / n;
  MixtureBox run(gas_box({n, 1, 1}), {fluid},
                 [&](Vec3 x) { return gas(mean_of_wave(x.x, dx), 1, 1); });
  run.run(1);
  double sum = 0;
  for_each_cell(run.domain(), [&](IntVec3 c) {
    sum += std::fabs(run.density(c) - mean_of_wave(run.level().centre(c).x, dx)) * dx;
  });
  return sum;
}

TEST(Parabolas, CarryAnEntropyWaveWithThirdOrder) {
  for (const Fluid& fluid : {ideal_gas(1.4, 1), stiffened_gas(4.4, 0.5)}) {
    const double coarse = error_of_entropy_wave(64, fluid),
                 fine = error_of_entropy_wave(128, fluid);
    EXPECT_GE(std::log2(coarse / fine), 2.9) << coarse << " " << fine;
    EXPECT_LT(fine, 1e-5);
  }
}

// Velocity and pressure stay as they are where only the density varies.
TEST(Parabolas, LeaveAUniformPressureUniform) {
  for (const Fluid& fluid : {ideal_gas(1.4, 1), stiffened_gas(4.4, 600)}) {
    MixtureBox run(gas_box({40, 1, 1}), {fluid},
                   [](Vec3 x) { return gas(x.x < 0.4 ? 1000 : 1, 1, 0.3); });
    run.steps(300);
    for_each_cell(run.domain(), [&](IntVec3 c) {
      EXPECT_NEAR(run.velocity(c), 0.3, 1e-11);
      EXPECT_NEAR(run.pressure(c), 1, 1e-9);
    });
  }
}

struct StrongWave {
  const char* name;
  IntVec3 cells;
  MixtureCell left, right;
};

class StrongWaves : public testing::TestWithParam<StrongWave> {};

TEST_P(StrongWaves, StayPositive) {
  const StrongWave& w = GetParam();
  for (const double cfl : {0.4, 0.8}) {
    MixtureBox run(gas_box(w.cells, cfl, false), {ideal_gas(1.4, 1)}, [&](Vec3 x) {
      const bool corner = w.cells.y > 1;
      const bool left = corner ? x.x + x.y + (w.cells.z > 1 ? x.z : 0) < 0.7 : x.x < 0.5;
      return left ? w.left : w.right;
    });
    run.steps(150);
    for_each_cell(run.domain(), [&](IntVec3 c) {
      EXPECT_GT(run.density(c), 0);
      EXPECT_GT(run.energy(0, c), 0);
      EXPECT_TRUE(std::isfinite(run.energy(0, c)));
    });
  }
}

INSTANTIATE_TEST_SUITE_P(
    Parabolas, StrongWaves,
    testing::Values(
        StrongWave{"blast", {100, 1, 1}, gas(1, 1e5), gas(1, 1)},
        StrongWave{"fans_5", {100, 1, 1}, gas(1, 0.4, -5), gas(1, 0.4, 5)},
        StrongWave{"fans_20", {100, 1, 1}, gas(1, 0.4, -20), gas(1, 0.4, 20)},
        StrongWave{"vacuum", {100, 1, 1}, gas(1, 1), gas(1e-12, 1e-12)},
        StrongWave{"leblanc", {100, 1, 1}, gas(1, 1.0 / 15), gas(1e-3, 2e-10 / 3)},
        StrongWave{"collision", {100, 1, 1}, gas(1, 1e-6, 10), gas(1, 1e-6, -10)},
        StrongWave{"heavy_on_light", {100, 1, 1}, gas(1000, 1e-6, 10), gas(1, 1e-6, -10)},
        StrongWave{"light_on_heavy", {100, 1, 1}, gas(1, 1e-6, 10), gas(1e4, 1, -1)},
        StrongWave{"blast_2d", {32, 32, 1}, gas(1, 1e5), gas(1, 1)},
        StrongWave{"blast_3d", {12, 12, 12}, gas(1, 1e10), gas(1, 1)},
        StrongWave{"contact_2d", {24, 24, 1}, gas(1000, 1, 8, 8), gas(1, 1, 8, 8)},
        StrongWave{"contact_3d", {12, 12, 12}, gas(1000, 1, 8, 8, 8), gas(1, 1, 8, 8, 8)}),
    [](const testing::TestParamInfo<StrongWave>& w) { return w.param.name; });

TEST(Parabolas, KeepMassMomentumAndEnergy) {
  MixtureBox run(gas_box({16, 16, 1}), {ideal_gas(1.4, 1)}, [](Vec3 x) {
    return gas(1 + 0.5 * std::sin(2 * pi * x.x), x.x + x.y < 0.7 ? 100 : 1, 1, -2);
  });
  const Totals before = run.totals();
  run.steps(200);
  const Totals after = run.totals();
  EXPECT_NEAR(after.mass[0].sum.value(), before.mass[0].sum.value(), 1e-13);
  EXPECT_NEAR(total_energy(after) / total_energy(before), 1, 1e-13);
}

// The mirror image of a start gives the mirror image of the flow, and changing places of x and y
// the flow with x and y changed.
TEST(Parabolas, GiveMirrorImagesToTheBit) {
  const auto start = [](double x, double y) {
    return gas(1 + 0.3 * std::sin(5 * x + 2) * std::cos(3 * y), x < 0.3 && y < 0.6 ? 50 : 1,
               std::sin(x + 2 * y), std::cos(3 * x - y));
  };
  constexpr int n = 20;
  GasBox box = gas_box({n, n, 1}, 0.8, false);
  const auto index = [&](double x) { return std::floor(x * n); };
  const auto at = [&](double i) { return (i + 0.5) / n; };
  MixtureBox plain(box, {ideal_gas(1.4, 1)},
                   [&](Vec3 x) { return start(at(index(x.x)), at(index(x.y))); });
  MixtureBox mirrored(box, {ideal_gas(1.4, 1)}, [&](Vec3 x) {
    MixtureCell c = start(at(n - 1 - index(x.x)), at(index(x.y)));
    c.velocity[0] = -c.velocity[0];
    return c;
  });
  MixtureBox turned(box, {ideal_gas(1.4, 1)}, [&](Vec3 x) {
    MixtureCell c = start(at(index(x.y)), at(index(x.x)));
    std::swap(c.velocity[0], c.velocity[1]);
    return c;
  });
  for (MixtureBox* run : {&plain, &mirrored, &turned}) run->steps(60);
  for_each_cell(plain.domain(), [&](IntVec3 c) {
    const IntVec3 m{n - 1 - c.x, c.y, c.z}, t{c.y, c.x, c.z};
    EXPECT_EQ(plain.density(c), mirrored.density(m));
    EXPECT_EQ(plain.energy(0, c), mirrored.energy(0, m));
    EXPECT_EQ(plain.momentum(0, c), -mirrored.momentum(0, m));
    EXPECT_EQ(plain.momentum(1, c), mirrored.momentum(1, m));
    EXPECT_EQ(plain.density(c), turned.density(t));
    EXPECT_EQ(plain.momentum(0, c), turned.momentum(1, t));
  });
}

TEST(Parabolas, DoNotDependOnBoxes) {
  const auto start = [](Vec3 x) {
    return gas(1 + 0.3 * std::sin(5 * x.x + 2) * std::cos(3 * x.y), x.x < 0.3 ? 50 : 1,
               std::sin(x.x + 2 * x.y), std::cos(3 * x.z - x.y));
  };
  const GasBox box = gas_box({12, 13, 11}, 0.8, false);
  SolverOptions threads;
  threads.threads = 2;
  MixtureBox whole(box, {ideal_gas(1.4, 1)}, start);
  MixtureBox parts(box, {ideal_gas(1.4, 1)}, start, threads, {3, 2, 2});
  whole.steps(20);
  parts.steps(20);
  for_each_cell(whole.domain(), [&](IntVec3 c) {
    EXPECT_EQ(whole.density(c), parts.density(c));
    EXPECT_EQ(whole.energy(0, c), parts.energy(0, c));
    for (int d = 0; d < 3; ++d) EXPECT_EQ(whole.momentum(d, c), parts.momentum(d, c));
  });
}

class SmallWavesOfParabolas : public testing::TestWithParam<IntVec3> {};

TEST_P(SmallWavesOfParabolas, DoNotGrow) {
  constexpr double height = 1e-6;
  MixtureBox run(gas_box(GetParam(), 0.9), {ideal_gas(1.4, 1)}, [](Vec3 x) {
    const double noise = 1e4 * std::sin(12.9898 * x.x + 78.233 * x.y + 37.719 * x.z + 1);
    return gas(1, 1 + height * (2 * (noise - std::floor(noise)) - 1));
  });
  run.steps(300);
  double largest = 0;
  for_each_cell(run.domain(),
                [&](IntVec3 c) { largest = std::fmax(largest, std::fabs(run.pressure(c) - 1)); });
  EXPECT_LT(largest, height);
}

INSTANTIATE_TEST_SUITE_P(InDirections, SmallWavesOfParabolas,
                         testing::Values(IntVec3{48, 1, 1}, IntVec3{24, 24, 1},
                                         IntVec3{12, 12, 12}));

// A column in the discrete balance p_{i+1} - p_i = g dx (rho_i + rho_{i+1})/2 stays at rest.
TEST(Parabolas, LeaveAHydrostaticColumnAtRest) {
  constexpr int n = 40;
  constexpr double g = -3, dx = 1.0 / n;
  GasBox box = gas_box({n, 1, 1}, 0.8, false);
  box.walls = true;
  box.gravity = "[-3,0,0]";
  const auto density = [](double i) { return 1 + 0.5 * std::sin(0.2 * i); };
  MixtureBox run(box, {ideal_gas(1.4, 1)}, [&](Vec3 x) {
    const int i = static_cast<int>(std::floor(x.x * n));
    double p = 10;
    for (int k = 0; k < i; ++k) p += 0.5 * g * dx * (density(k) + density(k + 1));
    return gas(density(i), p);
  });
  run.steps(400);
  for_each_cell(run.domain(), [&](IntVec3 c) { EXPECT_NEAR(run.velocity(c), 0, 1e-12); });
}

std::string refusal(const std::string& deck) {
  try {
    DeckScene scene(deck);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}
std::string with(std::string text, const std::string& old, const std::string& now) {
  return text.replace(text.find(old), old.size(), now);
}

TEST(Parabolas, RefuseByNameWhatTheyDoNotBear) {
  const std::string deck = deck_text(gas_box({8, 1, 1}));
  EXPECT_EQ(refusal(deck), "");
  EXPECT_EQ(refusal(with(deck, "ThirdOrder", "PPM")), "");
  const auto refused = [](const std::string& text, const char* what) {
    EXPECT_NE(refusal(text).find("<advection type=\"ThirdOrder\"> with " + std::string(what)),
              std::string::npos)
        << refusal(text);
  };
  refused(with(deck, "conservative", "classic"), "<scheme>classic</scheme>");
  refused(with(deck, "</ICE></CFD>",
               "<ImplicitSolver><max_outer_iterations>1</max_outer_iterations>"
               "<outer_iteration_tolerance>1e-9</outer_iteration_tolerance></ImplicitSolver>"
               "</ICE></CFD>"),
          "<ImplicitSolver>");
  const std::size_t first = deck.find("<material name"), end = deck.find("</material>") + 11;
  const std::string material = deck.substr(first, end - first);
  refused(with(deck, material, material + with(material, "'gas'", "'other'")), "several materials");
}

}  // namespace
}  // namespace sluice::ice::third_order_test
