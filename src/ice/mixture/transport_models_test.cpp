// Laws of viscosity, sponges, turbulence, laws of the wall and surfaces with several materials:
// like gases are one gas, a closed box keeps its energy, the same bits for any cut, mirror images.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ice/mixture/mixture_test_support.hpp"

namespace sluice::ice {
namespace {

const Fluid air = ideal_gas(1.4, 717), heavy = ideal_gas(1.667, 300);
const Fluid water = stiffened_gas(4.4, 6e8, 588.33);

ViscosityModels sutherland(double a, double b) {
  ViscosityModels m;
  m.sutherland = Sutherland{a, b};
  return m;
}
ViscosityModels with_sponge(ViscosityModels m, double viscosity) {
  m.sponges.push_back({{{{.3, .2, -1}, {.7, .6, 2}}}, viscosity});
  return m;
}
Turbulence eddies(bool dynamic, double constant) {
  Turbulence t;
  t.dynamic = dynamic;
  t.constant = constant;
  return t;
}
WallShear rough_wall(Side side, double roughness) {
  WallShear w;
  w.side = side;
  w.roughness = roughness;
  return w;
}

GasBox box_of(IntVec3 cells, bool periodic) {
  GasBox box;
  box.cells = cells;
  box.scheme = "conservative";
  box.periodic = periodic;
  box.plates = !periodic;
  return box;
}

MixtureCell waves(Vec3 x, const std::vector<double>& volume) {
  constexpr double k = 2 * std::numbers::pi;
  MixtureCell c;
  const double rho = 1 / (1 + .2 * std::sin(k * x.x) * std::cos(k * x.y));
  c.volume = volume;
  c.density.assign(volume.size(), rho);
  c.pressure.assign(volume.size(), 1.0);
  c.velocity[0] = .2 * std::sin(k * x.y) + .1;
  c.velocity[1] = .2 * std::sin(k * x.x);
  return c;
}

struct Case {
  const char* name;
  bool periodic;
  Transport transport;  // of one gas
};
std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({"Sutherland", true, {{0}, {.02}, 0, {sutherland(.02, 2)}, {}, {}, {}}});
  all.push_back({"sponge", true, {{1e-3}, {}, 0, {with_sponge({}, .05)}, {}, {}, {}}});
  all.push_back({"Smagorinsky", true, {{1e-3}, {1e-3}, 0, {}, eddies(false, .4), {}, {}}});
  all.push_back(
      {"all but the dynamic model",
       true,
       {{0}, {1e-3}, 0, {with_sponge(sutherland(.005, 2), .02)}, eddies(false, .4), {}, {}}});
  all.push_back({"Germano", true, {{1e-3}, {}, 0, {}, eddies(true, 0), {}, {}}});
  all.push_back({"walls",
                 false,
                 {{1e-3},
                  {1e-3},
                  0,
                  {sutherland(.001, 2)},
                  eddies(false, .2),
                  {rough_wall(Side::y_minus, 1e-3), rough_wall(Side::x_plus, 1e-3)},
                  {}}});
  return all;
}

TEST(MixtureTransportModels, LikeGasesAreOneGas) {
  constexpr double round_off = 1e-12;
  const Fluid gas = ideal_gas(1.4, 1);
  for (const Case& c : cases()) {
    const GasBox box = box_of({24, 20, 1}, c.periodic);
    Transport both = c.transport, nothing;
    for (auto* list : {&both.viscosity, &both.conductivity})
      if (!list->empty()) list->push_back(list->front());
    if (!both.models.empty()) both.models.push_back(both.models.front());
    MixtureBox one(
        box, {gas}, [](Vec3 x) { return waves(x, {1}); }, {}, {}, c.transport);
    MixtureBox two(
        box, {gas, gas},
        [](Vec3 x) {
          return waves(x, {.3, .7});
        },
        {}, {}, both);
    MixtureBox plain(
        box, {gas}, [](Vec3 x) { return waves(x, {1}); }, {}, {}, nothing);
    for (int n = 0; n < 40; ++n)
      for (MixtureBox* run : {&one, &two, &plain}) run->step(.3 / 24 / 1.6);
    double velocity = 0, energy = 0, change = 0;
    for_each_cell(one.domain(), [&](IntVec3 i) {
      const double e = two.energy(0, i) + two.energy(1, i);
      velocity = std::fmax(velocity, std::fabs(two.velocity(i) - one.velocity(i)));
      energy = std::fmax(energy, std::fabs(e - one.energy(0, i)) / one.energy(0, i));
      change = std::fmax(change, std::fabs(plain.velocity(i) - one.velocity(i)));
    });
    std::printf("%s: u %.2e E %.2e, effect %.2e\n", c.name, velocity, energy, change);
    EXPECT_GT(change, 1e-4) << c.name;
    EXPECT_LE(velocity, round_off) << c.name;
    EXPECT_LE(energy, round_off) << c.name;
  }
}

MixtureCell three(Vec3 x) {
  MixtureCell c;
  const bool left = x.x + .2 * std::sin(6 * x.y) < .5, low = x.y < .45;
  c.volume = {left ? 1.0 : 0.0, !left && low ? 1.0 : 0.0, !left && !low ? 1.0 : 0.0};
  c.density = {1000, 1.2, 4};
  c.pressure = {x.x < .25 ? 3e8 : 1e5, 1e5, 2e5};
  return c;
}
// Kinds of models: 0 and 1 with Smagorinsky's and Germano's eddies, 2 with slip of the air along
// the water and convective exchange of the heavy gas with it.
Transport all_models(int kind) {
  const auto surfaces = [kind](ExchangeSettings& x) {
    if (kind < 2) return;
    x.slip = SlipExchange{1, 0, .3, .4, true, {}};
    x.convective = ConvectiveExchange{2, 0, {}};
    x.heat.set(0, 1, 1e15);
  };
  return {{1e3, 0, 0},
          {6e5, 2e3, 1e4},
          1e8,
          {{}, sutherland(2, 100), with_sponge({}, 50)},
          eddies(kind == 1, .3),
          {rough_wall(Side::y_minus, 1e-3)},
          surfaces};
}

TEST(MixtureTransportModels, AClosedBoxKeepsMassAndEnergy) {
  constexpr double limit = 1e-13;
  for (const int kind : {0, 1, 2}) {
    MixtureBox run(box_of({32, 24, 1}, false), {water, air, heavy}, three, {}, {},
                   all_models(kind));
    const Totals before = run.totals();
    run.steps(300);
    const Totals after = run.totals();
    for (std::size_t m = 0; m < 3; ++m)
      EXPECT_LE(std::fabs(after.mass[m].sum.value() - before.mass[m].sum.value()),
                limit * before.mass[m].sum.value());
    const double e0 = before.internal_energy.sum.value() + before.kinetic_energy.sum.value();
    const double e1 = after.internal_energy.sum.value() + after.kinetic_energy.sum.value();
    std::printf("dE/E %.2e, rejected %d, time %g\n", (e1 - e0) / e0, run.rejected(), run.time());
    EXPECT_LE(std::fabs(e1 - e0), limit * e0);
  }
}

TEST(MixtureTransportModels, BlocksBoxesAndKindsLeaveNoTrace) {
  for (const int kind : {0, 1, 2}) {
    SCOPED_TRACE(kind);
    const auto run_with = [&](const SolverOptions& options, IntVec3 boxes) {
      MixtureBox run(box_of({48, 40, 1}, false), {water, air, heavy}, three, options, boxes,
                     all_models(kind));
      run.steps(20);
      return bits_of(run, false);
    };
    expect_same_bits_however_cut(run_with);
  }
}

TEST(MixtureTransportModels, MirroredStartsGiveMirroredBits) {
  for (const int kind : {0, 1, 2}) {
    GasBox box = box_of({48, 16, 1}, false);
    box.low = {-.5, -.5, -.5};
    box.high = {.5, .5, .5};
    const auto start = [](double x, double y) {
      MixtureCell c = three({x + .5, y + .5, .5});
      c.velocity[1] = 5;
      return c;
    };
    Transport models = all_models(kind);
    models.models[2].sponges = {{{{{-.2, -.3, -1}, {.2, .1, 2}}}, 50}};
    const auto bits = [&](double way, bool mirror) {
      MixtureBox run(
          box, {water, air, heavy}, [&](Vec3 x) { return start(way * x.x, x.y); }, {}, {}, models);
      run.steps(40);
      return bits_of(run, mirror);
    };
    EXPECT_EQ(bits(1, false), bits(-1, true)) << kind;
  }
}

// Each kind of block has what its material needs.
TEST(MixtureTransportModels, WhatIsOffAddsNoTask) {
  const auto tasks = [](const Transport& transport, int kind) {
    const MixtureBox run(
        box_of({8, 8, 1}, true), {water, air},
        [](Vec3) {
          return MixtureCell{{0, 1}, {1000, 1}, {1e5, 1e5}, {}, {}};
        },
        {}, {}, transport);
    TaskList list;
    StepVariant variant;
    variant.kind = kind;
    run.ice().declare_step(list, variant);
    std::string names;
    for (const Task& task : list.tasks()) names += task.name + "; ";
    return names;
  };
  const auto has = [](const std::string& names, const char* part) {
    return names.find(part) != std::string::npos;
  };
  const Transport numbers{{1, 1}, {}, 0, {}, {}, {}, {}};
  for (const char* name : {"viscosity of each", "fronts", "eddy", "total", "molecular"})
    for (const int kind : {0, 1, 2}) EXPECT_FALSE(has(tasks(numbers, kind), name)) << name;
  const Transport law_of_air{{0, 0}, {}, 0, {{}, sutherland(1, 1)}, {}, {}, {}};
  EXPECT_FALSE(has(tasks(law_of_air, 0), "stress"));
  EXPECT_TRUE(has(tasks(law_of_air, 1), "molecular viscosity"));
  EXPECT_TRUE(has(tasks(law_of_air, 2), "viscosity of each material"));
  EXPECT_TRUE(has(tasks(law_of_air, 2), "viscosity of fronts"));
  Transport slipping{{1, 1}, {1, 1}, 1, {}, {}, {}, [](ExchangeSettings& x) {
                       x.slip = SlipExchange{1, 0, 1, 1, true, {}};
                     }};
  EXPECT_TRUE(has(tasks(slipping, 2), "surface along which"));
  EXPECT_TRUE(has(tasks(slipping, 2), "slip on axis 1"));
  slipping.change = [](ExchangeSettings& x) { x.slip = SlipExchange{1, 0, 1, 1, false, {}}; };
  EXPECT_EQ(tasks(slipping, 2).find("slip"), std::string::npos);
  const Transport turbulent{{0, 0}, {}, 0, {}, eddies(false, .1), {}, {}};
  EXPECT_FALSE(has(tasks(turbulent, 2), "viscosity of each material"));
  for (const int kind : {0, 1, 2}) EXPECT_TRUE(has(tasks(turbulent, kind), "eddy viscosity"));
}

}  // namespace
}  // namespace sluice::ice
