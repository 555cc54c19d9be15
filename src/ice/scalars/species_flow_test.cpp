// A gas of species in flow: its law, its transport, its reactions.
#include <array>

#include "ice/fluid/labels.hpp"
#include "ice/fluid/species_rows.hpp"
#include "ice/test_support/scalars.hpp"
#include "kinetics/hydrogen_burke.hpp"
#include "kinetics/reactor.hpp"
#include "kinetics/transport.hpp"

namespace sluice::ice::species_flow_test {
namespace {

using kinetics::SpeciesGas;

// In the order of the mechanism: H H2 O OH H2O O2 HO2 H2O2, the rest N2.
using Fractions = std::array<double, 8>;
constexpr Fractions air{0, 0, 0, 0, 0, 0.233, 0, 0};
constexpr Fractions fuel{0, 0.3, 0, 0, 0.1, 0, 0, 0};
constexpr Fractions stoichiometric{0, 0.0285, 0, 0, 0, 0.2264, 0, 0};

const SpeciesGas& hydrogen() {
  static const SpeciesGas gas(kinetics::burke_hydrogen(), 8);
  return gas;
}

eos::Nasa7Heat heat_of(const Fractions& Y) {
  return hydrogen().heat([&](std::size_t k) { return Y[k]; });
}

std::string list(const Fractions& Y) {
  std::string text;
  for (const double y : Y) text += fmt::format("{}{:.17g}", text.empty() ? "[" : ", ", y);
  return text + "]";
}

// The gas of `everywhere`, with that of `inside` in a box.
std::string model(const Fractions& everywhere, const Fractions& inside, const char* low,
                  const char* high, const std::string& tags) {
  return fmt::format(
      "<Model type='hydrogenBurke'><hydrogenBurke><material>gas</material><YH2_init>0</YH2_init>"
      "<YO2_init>0</YO2_init>{}{}{}</hydrogenBurke></Model>",
      box_region("[-99,-99,-99]", "[99,99,99]", "<Y>" + list(everywhere) + "</Y>"),
      box_region(low, high, "<Y>" + list(inside) + "</Y>"), tags);
}

std::string name(std::size_t k) {
  return "Y" + hydrogen().name_of(k);
}

class SpeciesRun : public ScalarRun {
 public:
  using ScalarRun::ScalarRun;

  Fractions fractions(IntVec3 c) {
    Fractions Y;
    for (std::size_t k = 0; k < Y.size(); ++k) Y[k] = scalar(name(k), c);
    return Y;
  }
  double rho(IntVec3 c) { return mass(c); }
  double temperature(IntVec3 c) { return heat_of(fractions(c)).temperature(energy(c) / rho(c)); }
  double pressure(IntVec3 c) {
    return rho(c) * heat_of(fractions(c)).gas_constant * temperature(c);
  }
  // Largest distance from a value over all cells, as a share of it.
  template <class F>
  double departure(double value, F&& of) {
    double most = 0;
    for_each_cell(domain(),
                  [&](IntVec3 c) { most = std::fmax(most, std::fabs(of(c) / value - 1)); });
    return most;
  }
  // Sum over cells.
  template <class F>
  double sum(F&& of) {
    double all = 0;
    for_each_cell(domain(), [&](IntVec3 c) { all += of(c); });
    return all;
  }
  // Internal, kinetic and formation energy per volume.
  double whole_energy(IntVec3 c) {
    double e = energy(c), rest = 1;
    const Fractions Y = fractions(c);
    for (std::size_t k = 0; k < Y.size(); ++k) {
      e += rho(c) * Y[k] * hydrogen().formation_energy(hydrogen().species_of(k));
      rest -= Y[k];
    }
    e += rho(c) * rest * hydrogen().formation_energy(hydrogen().closure());
    for (int d = 0; d < (domain().size().y > 1 ? 2 : 1); ++d) {
      const double m = momentum(c, d);
      e += 0.5 * m * m / rho(c);
    }
    return e;
  }
  // Atoms of an element per volume, mol.
  double atoms(IntVec3 c, std::size_t element) {
    double sum = 0;
    const Fractions Y = fractions(c);
    for (std::size_t k = 0; k < Y.size(); ++k) {
      const kinetics::Species& s = hydrogen().mechanism().species[hydrogen().species_of(k)];
      sum += rho(c) * Y[k] / s.molar_mass * s.atoms[element];
    }
    return sum;
  }
};

constexpr const char* inert = "<doChemistry>false</doChemistry>";

// Fuel between air at one pressure and temperature, carried along: both stay as they are, although
// gas constants and heat capacities of the two differ by factors.
TEST(SpeciesFlow, KeepsOnePressureAndTemperature) {
  const double p = 1e5, T = 700;
  GasBox box;
  box.cells = {40, 1, 1};
  box.density =
      fmt::format("(x-0.5)^2 < 0.04 ? {:.17g} : {:.17g}", p / (heat_of(fuel).gas_constant * T),
                  p / (heat_of(air).gas_constant * T));
  box.pressure = "1e5";
  box.velocity[0] = "200";
  box.models = model(air, fuel, "[0.3,-9,-9]", "[0.7,9,9]", inert);
  SpeciesRun run(box);
  const double before = run.sum([&](IntVec3 c) { return run.rho(c) * run.fractions(c)[1]; });
  run.steps(200);
  EXPECT_LT(run.departure(p, [&](IntVec3 c) { return run.pressure(c); }), 1e-9);
  EXPECT_LT(run.departure(T, [&](IntVec3 c) { return run.temperature(c); }), 1e-9);
  const double after = run.sum([&](IntVec3 c) { return run.rho(c) * run.fractions(c)[1]; });
  EXPECT_NEAR(after, before, 1e-13 * before);
}

// A wave of sound in a uniform mixture comes back after one period of its own frozen speed of
// sound: the error is of second order.
TEST(SpeciesFlow, SoundRunsWithTheFrozenSpeed) {
  const double p = 2e5, T = 1500, R = heat_of(fuel).gas_constant;
  const double gamma = heat_of(fuel).ratio(T), rho = p / (R * T), c = std::sqrt(gamma * R * T);
  const double a = 1e-5;
  const auto error = [&](int cells) {
    GasBox box;
    box.cells = {cells, 1, 1};
    box.density = fmt::format("{:.17g}*(1+{}*sin(6.283185307179586*x))", rho, a);
    box.pressure = fmt::format("{:.17g}*(1+{:.17g}*sin(6.283185307179586*x))", p, a * gamma);
    box.velocity[0] = fmt::format("{:.17g}*sin(6.283185307179586*x)", a * c);
    box.models = model(fuel, fuel, "[0,0,0]", "[1,1,1]", inert);
    SpeciesRun run(box);
    run.run(1.0 / c);
    return run.sum([&](IntVec3 cell) {
      const double x = run.level().centre(cell).x;
      return std::fabs(run.rho(cell) / rho - 1 - a * std::sin(2 * std::numbers::pi * x));
    }) / (a * cells);
  };
  const double coarse = error(40), fine = error(80);
  EXPECT_LT(fine, 5e-3);
  EXPECT_GT(recorded_order(coarse, fine), 1.8);
}

// A mixture at rest reacts in each cell as it does alone, to the bit but for the energy's way.
TEST(SpeciesFlow, ReactsAtRestAsTheCellAlone) {
  const double T = 1400, p = 101325, dt = 2e-6;
  const double rho = p / (heat_of(stoichiometric).gas_constant * T);
  GasBox box;
  box.cells = {4, 1, 1};
  box.density = fmt::format("{:.17g}", rho);
  box.pressure = fmt::format("{:.17g}", p);
  box.models = model(stoichiometric, stoichiometric, "[0,0,0]", "[1,1,1]", "");
  SpeciesRun run(box);
  kinetics::Tolerances tolerances;
  kinetics::Reactor reactor(hydrogen(), tolerances);
  Fractions Y = stoichiometric;
  double e = run.energy({0, 0, 0}) / run.rho({0, 0, 0});
  for (int n = 0; n < 10; ++n) {
    run.step(dt);
    e += reactor.advance(rho, e, Y.data(), dt).heat / rho;
  }
  EXPECT_GT(run.temperature({2, 0, 0}), T + 200);
  for (std::size_t k = 0; k < Y.size(); ++k)
    EXPECT_NEAR(run.scalar(name(k), {2, 0, 0}), Y[k], 1e-9) << k;
  EXPECT_NEAR(run.energy({2, 0, 0}) / rho, e, 1e-9 * e);
}

// A layer of hot gas ignites its surroundings in a closed box: energy with that of formation,
// mass and atoms stay; and boxes leave no trace.
TEST(SpeciesFlow, BurningKeepsEnergyAndAtoms) {
  const auto burn = [](IntVec3 boxes) {
    GasBox box;
    box.cells = {16, 4, 1};
    box.high = {1e-2, 2.5e-3, 1};
    box.periodic = false;
    box.walls = true;
    box.density = "x < 0.004 ? 0.5 : 1.5";
    box.pressure = "4e5";
    box.velocity[1] = "10*sin(2513.27412287183*y)";
    box.models = model(stoichiometric, stoichiometric, "[0,0,0]", "[1,1,1]",
                       "<doDiffusion>true</doDiffusion>");
    return std::make_unique<SpeciesRun>(box, SolverOptions{}, boxes);
  };
  const auto one = burn({}), four = burn({2, 2, 1});
  const auto energy = [](SpeciesRun& run) {
    return run.sum([&](IntVec3 c) { return run.whole_energy(c); });
  };
  const auto scale = one->sum([&](IntVec3 c) { return one->energy(c); });
  const double before = energy(*one);
  std::array<double, 2> atoms;
  for (std::size_t e = 0; e < 2; ++e)
    atoms[e] = one->sum([&](IntVec3 c) { return one->atoms(c, e); });
  const double T_before = one->temperature({2, 0, 0});
  one->steps(25);
  four->steps(25);
  EXPECT_GT(one->temperature({2, 0, 0}), T_before + 500);
  EXPECT_NEAR(energy(*one), before, 2e-13 * scale);
  for (std::size_t e = 0; e < 2; ++e)
    EXPECT_NEAR(one->sum([&](IntVec3 c) { return one->atoms(c, e); }), atoms[e], 1e-13 * atoms[e]);
  for_each_cell(one->domain(), [&](IntVec3 c) {
    EXPECT_EQ(one->energy(c), four->energy(c));
    EXPECT_EQ(one->fractions(c), four->fractions(c));
  });
}

// A trace of a species spreads as heat does in a rod: with D of the mixture, to second order.
TEST(SpeciesFlow, ATraceSpreadsWithItsDiffusivity) {
  const double p = 101325, T = 500, a = 1e-6, L = 1e-3;
  kinetics::Transport transport(hydrogen());
  std::array<double, 9> all{}, D{};
  hydrogen().all_fractions(air.data(), all.data());
  transport.set(T, all.data());
  transport.diffusion(p, D.data());
  const double rate = D[4] * std::pow(2 * std::numbers::pi / L, 2), end = 0.5 / rate;
  const auto error = [&](int cells) {
    GasBox box;
    box.cells = {cells, 1, 1};
    box.high.x = L;
    box.density = fmt::format("{:.17g}", p / (heat_of(air).gas_constant * T));
    box.pressure = fmt::format("{:.17g}", p);
    box.models = model(air, air, "[0,0,0]", "[1,1,1]",
                       "<doChemistry>false</doChemistry><doDiffusion>true</doDiffusion>");
    SpeciesRun run(box);
    const auto wave = [&](Vec3 x) { return a * std::sin(2 * std::numbers::pi * x.x / L); };
    run.set("YH2O", [&](Vec3 x) { return a + wave(x); });
    run.run(end);
    return run.error("YH2O", [&](Vec3 x) { return a + std::exp(-0.5) * wave(x); }) / a;
  };
  const double coarse = error(8), fine = error(16);
  EXPECT_LT(fine, 5e-3);
  EXPECT_GT(recorded_order(coarse, fine), 1.8);
}

// Gas far beyond all fits cannot be integrated: the step fails with the cell and its temperature,
// and the run ends with them rather than with numbers that mean nothing.
TEST(SpeciesFlow, TellsWhereReactionsCannotBeIntegrated) {
  const double T = 1e6, rho = 1;
  GasBox box;
  box.cells = {4, 1, 1};
  box.density = "1";
  box.pressure =
      fmt::format("x > 0.5 ? {:.17g} : 1e5", rho * heat_of(stoichiometric).gas_constant * T);
  box.models = model(stoichiometric, stoichiometric, "[0,0,0]", "[1,1,1]", "");
  SpeciesRun run(box);
  const StepAttempt& attempt = run.attempt(1e-9);
  EXPECT_EQ(attempt.faults, 2);
  EXPECT_EQ(attempt.first_fault.kind, fault_reactions);
  EXPECT_EQ(attempt.first_fault.cell, (IntVec3{2, 0, 0}));
  EXPECT_NEAR(attempt.first_fault.value, T, 1e-4 * T);
}

}  // namespace
}  // namespace sluice::ice::species_flow_test
