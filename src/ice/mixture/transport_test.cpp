// Friction and conduction with several materials: like fluids are one, conservation, the same bits
// for any cut, mirror images, nothing where they are off.
#include <gtest/gtest.h>

#include <cmath>

#include "ice/test_support/transport.hpp"

namespace sluice::ice::transport_test {
namespace {

constexpr double low_speed = .05;

struct Difference {
  double velocity = 0, energy = 0, change = 0;
};
// Of a mixture from one gas, and how much the gas has changed.
Difference from_one_gas(const std::function<std::vector<double>(Vec3)>& shares, double exchange) {
  const GasBox box = box_of({24, 20, 1}, true, &GasBox::walls);
  const Fluid gas = ideal_gas(1.4, 1);
  MixtureBox one(box, {gas}, [](Vec3 x) { return waves(x, {1.0}, low_speed); }, {}, {},
                 {{.01}, {.02}, 0});
  MixtureBox two(box, {gas, gas}, [&](Vec3 x) { return waves(x, shares(x), low_speed); }, {}, {},
                 {{.01, .01}, {.02, .02}, exchange});
  MixtureBox start(box, {gas}, [](Vec3 x) { return waves(x, {1.0}, low_speed); });
  for (int n = 0; n < 60; ++n) {
    const double dt = .4 / 24 / 1.3;
    one.step(dt);
    two.step(dt);
  }
  Difference d;
  for_each_cell(one.domain(), [&](IntVec3 c) {
    const double e = two.energy(0, c) + two.energy(1, c);
    d.velocity = std::fmax(d.velocity, std::fabs(two.velocity(c) - one.velocity(c)));
    d.energy = std::fmax(d.energy, std::fabs(e - one.energy(0, c)) / one.energy(0, c));
    d.change = std::fmax(d.change, std::fabs(one.velocity(c) - start.velocity(c)));
  });
  return d;
}

TEST(MixtureTransport, LikeFluidsAreOneFluid) {
  constexpr double round_off = 1e-12;
  const Difference uniform = from_one_gas([](Vec3) { return std::vector{.3, .7}; }, 0);
  std::printf("uniform shares: u %.2e E %.2e of change %.2e\n", uniform.velocity, uniform.energy,
              uniform.change);
  EXPECT_GT(uniform.change, 1e-2);
  EXPECT_LE(uniform.velocity, round_off);
  EXPECT_LE(uniform.energy, round_off);
}

// Friction, conduction and heat exchange.
const Transport all_three{{1e3, 20, 0}, {6e5, 2e3, 1e4}, 1e8};

TEST(MixtureTransport, AClosedBoxKeepsMassAndEnergy) {
  expect_closed_box_keeps_mass_and_energy(&GasBox::walls, all_three, 1000);
}

TEST(MixtureTransport, BlocksBoxesAndKindsLeaveNoTrace) {
  expect_same_bits_of_three(&GasBox::walls, all_three, 40);
}

TEST(MixtureTransport, MirroredStartsGiveMirroredBits) {
  for (const int ny : {1, 16}) expect_mirrored_bits_of_three(&GasBox::walls, ny, all_three, 60);
}

bool has_task(const Transport& transport, int kind, const std::string& part) {
  return tasks_of(transport, kind).find(part) != std::string::npos;
}

TEST(MixtureTransport, WhatIsOffAddsNoTask) {
  const std::string friction[] = {"stress", "viscosity", "heat of friction"};
  const std::string heat[] = {"heat flux", "contacts", "temperature of each material",
                              "heat of friction"};
  for (const int kind : {0, 1, 2})
    for (const auto& names : {std::vector(std::begin(friction), std::end(friction)),
                              std::vector(std::begin(heat), std::end(heat))})
      for (const std::string& name : names) EXPECT_FALSE(has_task({}, kind, name)) << name;
  // Air conducts, water rubs: each kind of block has what its material needs.
  const Transport some{{1, 0}, {0, 1}, 0};
  EXPECT_TRUE(has_task(some, 0, "stress"));
  EXPECT_FALSE(has_task(some, 0, "heat flux"));
  EXPECT_FALSE(has_task(some, 1, "stress"));
  EXPECT_TRUE(has_task(some, 1, "heat flux"));
  for (const char* name : {"stress", "viscosity", "contacts", "heat of friction"})
    EXPECT_TRUE(has_task(some, 2, name)) << name;
}

}  // namespace
}  // namespace sluice::ice::transport_test
