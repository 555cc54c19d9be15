// Several materials at the start: shares of cells, what is refused, weight of the surroundings.
#include "ice/start/material_fill.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/geometry/boolean.hpp"
#include "framework/geometry/box.hpp"
#include "framework/geometry/round.hpp"
#include "ice/test_support/fluid.hpp"

namespace sluice::ice::material_fill_test {
namespace {

using ::testing::HasSubstr;

// A square of 16 by 16 cells about the origin, side 2.
Level square() {
  Level level;
  level.anchor = {-1, -1, 0};
  level.spacing = {0.125, 0.125, 0.125};
  level.domain = {{0, 0, 0}, {16, 16, 1}};
  level.active = {true, true, false};
  return level;
}

GeomObject object(PiecePtr piece, double density, double temperature, int res = 4) {
  GeomObject o;
  o.piece = std::move(piece);
  o.res = {res, res, 1};
  o.values = {{"density", density}, {"temperature", temperature}};
  return o;
}

PiecePtr box(double x0, double y0, double x1, double y1) {
  return std::make_shared<BoxPiece>(Vec3{x0, y0, -1}, Vec3{x1, y1, 1});
}

PiecePtr disc(double radius) {
  return std::make_shared<SpherePiece>(Vec3{0, 0, 0.0625}, radius);
}

PiecePtr all_but(PiecePtr hole) {
  return std::make_shared<DifferencePiece>(box(-9, -9, 9, 9), std::move(hole));
}

IceMaterial material(int index, const char* name, Fluid fluid, std::vector<GeomObject> objects) {
  IceMaterial m;
  m.name = name;
  m.index = index;
  m.fluid = fluid;
  m.objects = std::move(objects);
  return m;
}

// 1000 kg/m^3 at 1 bar and 300 K.
const Fluid water = stiffened_gas(4.4, 6e8, (1e5 + 6e8) / (3.4 * 1000 * 300));

// Air with a drop of water in the middle.
IceScene drop(int res = 4) {
  IceScene scene;
  scene.materials = {
      material(0, "air", ideal_gas(1.4, 717.5), {object(all_but(disc(0.6)), 1.2, 300, res)}),
      material(1, "water", water, {object(disc(0.6), 1000, 300, res)})};
  return scene;
}

MixtureFill fill(const IceScene& scene, const PhysicalConstants& constants = {}) {
  const Level level = square();
  return fill_materials(scene, constants, level, level, level.domain,
                        weight_profile(scene, constants, level, level));
}

std::string refusal(const IceScene& scene) {
  try {
    fill(scene);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(MaterialFill, CountsSubPointsAndLeavesPureCellsPure) {
  const MixtureFill mix = fill(drop());
  int mixed = 0, pure[2] = {};
  double area = 0;
  for_each_cell(mix.cells, [&](IntVec3 c) {
    const std::size_t n = mix.offset(c);
    const double air = mix.materials[0].volume_fraction[n];
    const double drop_share = mix.materials[1].volume_fraction[n];
    EXPECT_EQ(air + drop_share, 1.0);
    EXPECT_EQ(drop_share * 16, std::round(drop_share * 16));
    area += drop_share / 64;
    if (air == 1.0) ++pure[0];
    if (drop_share == 1.0) ++pure[1];
    if (air > 0 && drop_share > 0) ++mixed;
  });
  EXPECT_EQ(pure[0] + pure[1] + mixed, 256);
  EXPECT_GT(mixed, 20);
  EXPECT_GT(pure[1], 40);
  EXPECT_NEAR(area, std::numbers::pi * 0.36, 0.01);
  const std::size_t middle = mix.offset({8, 8, 0});
  EXPECT_EQ(mix.materials[1].density[middle], 1000);
  EXPECT_NEAR(mix.materials[1].pressure[middle], 1e5, 1);
}

TEST(MaterialFill, IsMirroredToTheBit) {
  const MixtureFill mix = fill(drop());
  for_each_cell(mix.cells, [&](IntVec3 c) {
    const auto share = [&](IntVec3 at) { return mix.materials[1].volume_fraction[mix.offset(at)]; };
    EXPECT_EQ(share(c), share({15 - c.x, c.y, 0}));
    EXPECT_EQ(share(c), share({c.y, c.x, 0}));
  });
}

TEST(MaterialFill, DoesNotDependOnTheBox) {
  const IceScene scene = drop();
  const Level level = square();
  PhysicalConstants constants;
  constants.gravity = {0, -9.81, 0};
  constants.reference_pressure = 1e5;
  const MixtureFill whole = fill(scene, constants);
  const IndexBox part{{3, 5, 0}, {9, 12, 1}};
  const MixtureFill piece = fill_materials(scene, constants, level, level, part,
                                           weight_profile(scene, constants, level, level));
  for (std::size_t m = 0; m < 2; ++m)
    for_each_cell(part, [&](IntVec3 c) {
      const std::size_t a = whole.offset(c), b = piece.offset(c);
      EXPECT_EQ(whole.materials[m].volume_fraction[a], piece.materials[m].volume_fraction[b]);
      EXPECT_EQ(whole.materials[m].pressure[a], piece.materials[m].pressure[b]);
      EXPECT_EQ(whole.materials[m].density[a], piece.materials[m].density[b]);
    });
}

TEST(MaterialFill, LaterObjectsOfAMaterialOverwriteEarlierOnes) {
  IceScene scene = drop();
  // Warm air over all air, then a warmer corner that overlaps it.
  scene.materials[0].objects.push_back(object(all_but(disc(0.6)), 1.1, 310));
  scene.materials[0].objects.push_back(object(box(-1, -1, -0.8, -0.8), 1.0, 320));
  const MixtureFill mix = fill(scene);
  EXPECT_EQ(mix.materials[0].temperature[mix.offset({0, 0, 0})], 320);
  EXPECT_EQ(mix.materials[0].temperature[mix.offset({15, 0, 0})], 310);
  EXPECT_EQ(mix.materials[0].volume_fraction[mix.offset({0, 0, 0})], 1.0);
}

TEST(MaterialFill, AnObjectMayGiveAShare) {
  IceScene scene;
  GeomObject fog = object(box(-9, -9, 9, 9), 1000, 300), air = object(box(-9, -9, 9, 9), 1.2, 300);
  fog.values["volumeFraction"] = 0.1;
  air.values["volumeFraction"] = 0.9;
  scene.materials = {material(0, "air", ideal_gas(1.4, 717.5), {air}),
                     material(1, "fog", water, {fog})};
  const MixtureFill mix = fill(scene);
  EXPECT_EQ(mix.materials[1].volume_fraction[0], 0.1);
  EXPECT_EQ(mix.materials[0].volume_fraction[0], 0.9);
}

TEST(MaterialFill, RefusesFractionsThatDoNotSumToOne) {
  IceScene overlap = drop();
  overlap.materials[0].objects[0].piece = box(-9, -9, 9, 9);
  EXPECT_THAT(refusal(overlap), HasSubstr("volume fractions sum to 1."));
  EXPECT_THAT(refusal(overlap), HasSubstr("overlap: cut one out of the other with <difference>"));
  IceScene hole = drop();
  hole.materials[1].objects[0].piece = disc(0.3);
  EXPECT_THAT(refusal(hole), HasSubstr("part of the cell is empty"));
  IceScene missing = drop();
  missing.materials[0].objects[0].piece = box(-0.87, -9, 9, 9);
  missing.materials[1].objects[0].piece = disc(1e-3);
  EXPECT_THAT(refusal(missing), HasSubstr("in cell [0, 0, 0] at (-0.9375, -0.9375, 0.0625)"));
  EXPECT_THAT(refusal(missing), HasSubstr("(air 0, water 0)"));
  EXPECT_THAT(refusal(missing), HasSubstr("no geom_object covers it"));
  IceScene uneven = drop();
  uneven.materials[1].objects[0].res = {3, 3, 1};
  EXPECT_THAT(refusal(uneven), HasSubstr("the same <res>"));
}

TEST(MaterialFill, RefusesAStateThatTheLawDoesNotHave) {
  IceScene cold = drop();
  cold.materials[1].objects[0].values["temperature"] = -1;
  EXPECT_THAT(refusal(cold), HasSubstr("ICE material 1 starts with density 1000"));
}

PhysicalConstants falling_along_y(double g = -9.81) {
  PhysicalConstants constants;
  constants.gravity = {0, g, 0};
  constants.reference_pressure = 1e5;
  return constants;
}

// p_{i+1} - p_i = g dx (rho_i + rho_{i+1})/2 of the air beside the drop, in all columns alike.
TEST(MaterialFill, TheSurroundingMaterialMakesThePressure) {
  IceScene scene = drop();
  scene.materials[0].surrounding = true;
  const MixtureFill mix = fill(scene, falling_along_y());
  for_each_cell(mix.cells, [&](IntVec3 c) {
    const std::size_t n = mix.offset(c);
    for (const MaterialFill& m : mix.materials) {
      if (m.volume_fraction[n] == 0) continue;
      EXPECT_NEAR(m.pressure[n], 1e5 - 9.81 * 1.2 * 0.125 * c.y, 1e-9);
    }
    if (mix.materials[1].volume_fraction[n] == 0) return;
    // The gas keeps its density, the liquid its temperature.
    EXPECT_EQ(mix.materials[0].density[n], 1.2);
    EXPECT_EQ(mix.materials[1].temperature[n], 300);
    const Fluid& f = scene.materials[1].fluid;
    EXPECT_NEAR(f.pressure(mix.materials[1].density[n],
                           f.energy_from_temperature(mix.materials[1].density[n], 300)),
                mix.materials[1].pressure[n], 1e-5);
  });
}

// Water up to y = .1, in the middle of a cell, air above: one balance through both, whichever is
// marked, of the density that each cell has.
TEST(MaterialFill, LayersRestOnEachOther) {
  for (const std::size_t marked : {0U, 1U}) {
    IceScene scene;
    scene.materials = {
        material(0, "air", ideal_gas(1.4, 717.5), {object(box(-9, 0.0625, 9, 9), 1.2, 300)}),
        material(1, "water", water, {object(box(-9, -9, 9, 0.0625), 1000, 300)})};
    scene.materials[marked].surrounding = true;
    const MixtureFill mix = fill(scene, falling_along_y());
    EXPECT_EQ(mix.materials[1].volume_fraction[mix.offset({3, 8, 0})], 0.5);
    const auto density = [&](IntVec3 c) {
      double sum = 0;
      for (const MaterialFill& m : mix.materials)
        sum += m.volume_fraction[mix.offset(c)] * m.density[mix.offset(c)];
      return sum;
    };
    const auto pressure = [&](IntVec3 c) {
      return mix.materials[c.y <= 8].pressure[mix.offset(c)];
    };
    EXPECT_EQ(pressure({0, 0, 0}), 1e5);
    for_each_cell(mix.cells, [&](IntVec3 c) {
      if (c.y == 0) return;
      const IntVec3 below{c.x, c.y - 1, 0};
      const double weight = 9.81 * 0.125 * 0.5 * (density(c) + density(below));
      EXPECT_NEAR(pressure(c), pressure(below) - weight, 1e-10 * 1e5);
    });
    // Eight cells of water below, a quarter of one in the mixed cell.
    EXPECT_NEAR(pressure({3, 8, 0}), 1e5 - 9.81 * 1000 * 0.125 * 7.75, 1.0);
  }
}

// Nothing carries the weight along a direction that repeats: no pressure balances it.
TEST(MaterialFill, WhatFallsForEverHasOnePressure) {
  IceScene scene = drop();
  scene.materials[0].surrounding = true;
  Level level = square();
  level.periodic = {false, true, false};
  const PhysicalConstants constants = falling_along_y();
  const WeightProfile weight = weight_profile(scene, constants, level, level);
  EXPECT_EQ(weight.direction, -1);
  const MixtureFill mix = fill_materials(scene, constants, level, level, level.domain, weight);
  const double p = ideal_gas(1.4, 717.5).pressure(1.2, 1.2 * 717.5 * 300);
  for (const std::size_t n : {std::size_t{0}, mix.offset({0, 15, 0})})
    EXPECT_NEAR(mix.materials[0].pressure[n], p, 1e-9);
}

TEST(MaterialFill, ALiquidInBalanceFollowsItsPressure) {
  IceScene scene;
  scene.materials = {material(0, "water", water, {object(box(-9, -9, 9, 9), 1000, 300)})};
  PhysicalConstants constants;
  constants.gravity = {0, -9.81, 0};
  constants.reference_pressure = 1e5;
  const Level level = square();
  const PrimitiveFill column =
      fill_primitives(scene, constants, scene.materials[0], level, level, {{4, 0, 0}, {5, 16, 1}});
  for (int j = 1; j < 16; ++j) {
    const std::size_t a = column.offset({4, j - 1, 0}), b = column.offset({4, j, 0});
    EXPECT_NEAR(column.pressure[b] - column.pressure[a],
                -9.81 * 0.125 * 0.5 * (column.density[a] + column.density[b]), 1e-9);
    EXPECT_LT(column.density[b], column.density[a]);
  }
}

// Where the deck's density is not that of the reference pressure, a stiffened gas keeps it, and a
// law without thermal pressure is refused.
TEST(MaterialFill, ADensityOfAnotherPressureIsKeptOrRefused) {
  PhysicalConstants constants;
  constants.gravity = {0, -9.81, 0};
  constants.reference_pressure = 1e5;
  const Level level = square();
  const auto column = [&](const Fluid& fluid) {
    IceScene scene;
    scene.materials = {material(0, "body", fluid, {object(box(-9, -9, 9, 9), 1300, 300)})};
    return fill_primitives(scene, constants, scene.materials[0], level, level,
                           {{4, 0, 0}, {5, 16, 1}});
  };
  const PrimitiveFill water_column = column(water);
  EXPECT_EQ(water_column.density[5], 1300);
  EXPECT_NEAR(water_column.temperature[5], 300 / 1.3, 0.1);
  const eos::Murnaghan solid{{.n = 7.4, .K = 39e-11, .rho0 = 1160, .specific_heat = 1400}};
  EXPECT_THROW(column({solid, std::nullopt, 1.4, 1400}), InputError);
}

}  // namespace
}  // namespace sluice::ice::material_fill_test
