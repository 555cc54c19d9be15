// Laws of viscosity, sponges, turbulence, laws of the wall and surfaces with several materials:
// like gases are one gas, a closed box keeps its energy, the same bits for any cut, mirror images.
#include <gtest/gtest.h>

#include <cmath>

#include "ice/test_support/transport.hpp"

namespace sluice::ice::transport_models_test {
namespace {

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
  constexpr double round_off = 1e-14;  // measured 9.2e-16
  const Fluid gas = ideal_gas(1.4, 1);
  for (const Case& c : cases()) {
    const GasBox box = box_of({24, 20, 1}, c.periodic, &GasBox::plates);
    Transport both = c.transport, nothing;
    for (auto* list : {&both.viscosity, &both.conductivity})
      if (!list->empty()) list->push_back(list->front());
    if (!both.models.empty()) both.models.push_back(both.models.front());
    MixtureBox one(
        box, {gas}, [](Vec3 x) { return moving_waves(x, {1}); }, {}, {}, c.transport);
    MixtureBox two(
        box, {gas, gas},
        [](Vec3 x) {
          return moving_waves(x, {.3, .7});
        },
        {}, {}, both);
    MixtureBox plain(
        box, {gas}, [](Vec3 x) { return moving_waves(x, {1}); }, {}, {}, nothing);
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

// Kinds of models: 0 and 1 with Smagorinsky's and Germano's eddies, 2 with slip of the air along
// the water and convective exchange of the heavy gas with it.
Transport all_models(int kind) {
  const auto surfaces = [kind](ExchangeSettings& x) {
    if (kind < 2) return;
    x.slip = MultiVelocityExchange{1, 0, .3, .4, true, {}};
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
  for (const int kind : {0, 1, 2}) {
    SCOPED_TRACE(kind);
    expect_closed_box_keeps_mass_and_energy(&GasBox::plates, all_models(kind), 300);
  }
}

TEST(MixtureTransportModels, BlocksBoxesAndKindsLeaveNoTrace) {
  for (const int kind : {0, 1, 2}) {
    SCOPED_TRACE(kind);
    expect_same_bits_of_three(&GasBox::plates, all_models(kind), 20);
  }
}

TEST(MixtureTransportModels, MirroredStartsGiveMirroredBits) {
  for (const int kind : {0, 1, 2}) {
    SCOPED_TRACE(kind);
    Transport models = all_models(kind);
    models.models[2].sponges = {{{{{-.2, -.3, -1}, {.2, .1, 2}}}, 50}};
    expect_mirrored_bits_of_three(&GasBox::plates, 16, models, 40);
  }
}

// Each kind of block has what its material needs.
TEST(MixtureTransportModels, WhatIsOffAddsNoTask) {
  const auto has = [](const std::string& names, const char* part) {
    return names.find(part) != std::string::npos;
  };
  const Transport numbers{{1, 1}, {}, 0, {}, {}, {}, {}};
  for (const char* name : {"viscosity of each", "fronts", "eddy", "total", "molecular"})
    for (const int kind : {0, 1, 2}) EXPECT_FALSE(has(tasks_of(numbers, kind), name)) << name;
  const Transport law_of_air{{0, 0}, {}, 0, {{}, sutherland(1, 1)}, {}, {}, {}};
  EXPECT_FALSE(has(tasks_of(law_of_air, 0), "stress"));
  EXPECT_TRUE(has(tasks_of(law_of_air, 1), "molecular viscosity"));
  EXPECT_TRUE(has(tasks_of(law_of_air, 2), "viscosity of each material"));
  EXPECT_TRUE(has(tasks_of(law_of_air, 2), "viscosity of fronts"));
  Transport slipping{{1, 1}, {1, 1}, 1, {}, {}, {}, [](ExchangeSettings& x) {
                       x.slip = MultiVelocityExchange{1, 0, 1, 1, true, {}};
                     }};
  EXPECT_TRUE(has(tasks_of(slipping, 2), "surface along which"));
  EXPECT_TRUE(has(tasks_of(slipping, 2), "slip on axis 1"));
  slipping.change = [](ExchangeSettings& x) {
    x.slip = MultiVelocityExchange{1, 0, 1, 1, false, {}};
  };
  EXPECT_EQ(tasks_of(slipping, 2).find("slip"), std::string::npos);
  const Transport turbulent{{0, 0}, {}, 0, {}, eddies(false, .1), {}, {}};
  EXPECT_FALSE(has(tasks_of(turbulent, 2), "viscosity of each material"));
  for (const int kind : {0, 1, 2}) EXPECT_TRUE(has(tasks_of(turbulent, kind), "eddy viscosity"));
}

}  // namespace
}  // namespace sluice::ice::transport_models_test
