// Which effects a scene of several materials calls for, and the reasons that it gives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ice/ice.hpp"
#include "ice/step/effect_ids.hpp"

namespace sluice::ice::effects_test {
namespace {

using ::testing::HasSubstr;

Scene tube() {
  Scene scene;
  scene.grid.levels.emplace_back();
  scene.grid.levels[0].periodic = {true, true, true};
  return scene;
}

IceScene materials(int count, double momentum, double heat) {
  IceScene scene;
  scene.exchange.momentum = PairCoefficients(count);
  scene.exchange.heat = PairCoefficients(count);
  for (int m = 0; m < count; ++m) {
    scene.materials.emplace_back();
    scene.materials.back().index = m;
    scene.materials.back().name = m == 0 ? "air" : "water";
    for (int n = m + 1; n < count; ++n) {
      scene.exchange.momentum.set(m, n, momentum);
      scene.exchange.heat.set(m, n, heat);
    }
  }
  scene.exchange.written = true;
  return scene;
}

TEST(Effects, OneMaterialExchangesNothing) {
  const EffectList e = find_effects(tube(), materials(1, 0, 0));
  for (const int id : {effect_equilibration, effect_momentum_exchange, effect_heat_exchange}) {
    EXPECT_FALSE(e.on(id));
    EXPECT_THAT(e[id].reason, HasSubstr("one material"));
  }
}

TEST(Effects, SeveralMaterialsShareAPressureAndExchangeByTheirCoefficients) {
  const EffectList e = find_effects(tube(), materials(2, 1e10, 0));
  EXPECT_TRUE(e.on(effect_equilibration));
  EXPECT_TRUE(e.on(effect_momentum_exchange));
  EXPECT_THAT(e[effect_momentum_exchange].reason, HasSubstr("1e+10 (0-1)"));
  EXPECT_THAT(e[effect_momentum_exchange].reason, HasSubstr("one velocity"));
  EXPECT_FALSE(e.on(effect_heat_exchange));
  EXPECT_THAT(e[effect_heat_exchange].reason, HasSubstr("0 (0-1)"));
}

TEST(Effects, OneVelocityNeedsEveryPair) {
  IceScene scene = materials(3, 1e15, 1e3);
  EXPECT_TRUE(scene.one_velocity());
  scene.exchange.momentum.set(0, 2, 1e9);
  EXPECT_FALSE(scene.one_velocity());
  EXPECT_EQ(scene.exchange.momentum(2, 0), 1e9);
  const EffectList e = find_effects(tube(), scene);
  EXPECT_EQ(e[effect_momentum_exchange].reason.find("one velocity,"), std::string::npos);
  EXPECT_THAT(e[effect_momentum_exchange].reason, HasSubstr("one velocity per material"));
  EXPECT_TRUE(e.on(effect_heat_exchange));
  EXPECT_FALSE(materials(2, 0, 0).one_velocity());
  EXPECT_TRUE(find_effects(tube(), materials(2, 0, 0)).on(effect_momentum_exchange));
  EXPECT_TRUE(materials(1, 0, 0).one_velocity());
}

TEST(Effects, OneMaterialWithACoefficientIsEnough) {
  IceScene scene = materials(2, 0, 0);
  scene.materials[1].viscosity = 1e-3;
  scene.materials[1].viscosity_where = {"deck.ups", 12, 1};
  const EffectList e = find_effects(tube(), scene);
  EXPECT_TRUE(e.on(effect_viscosity));
  EXPECT_EQ(e[effect_viscosity].reason, "dynamic_viscosity is 0 (air), 0.001 (water)");
  EXPECT_EQ(e[effect_viscosity].line.line, 12);
  EXPECT_FALSE(e.on(effect_conduction));
  EXPECT_TRUE(e.on(effect_momentum_exchange));  // free of each other: one velocity per material
}

TEST(Effects, ShocksAreShearedWhereRowsLieBesideEachOther) {
  IceScene ice = materials(1, 0, 0);
  ice.shears_shocks = false;
  EXPECT_FALSE(find_effects(tube(), ice).on(effect_shock_shear));
  EXPECT_THAT(find_effects(tube(), ice)[effect_shock_shear].reason, HasSubstr("shearAlongShocks"));
  ice.shears_shocks = true;
  Scene line = tube(), plane = tube();
  line.grid.levels[0].active = {true, false, false};
  plane.grid.levels[0].active = {true, true, false};
  EXPECT_TRUE(find_effects(plane, ice).on(effect_shock_shear));
  EXPECT_FALSE(find_effects(line, ice).on(effect_shock_shear));
  EXPECT_THAT(find_effects(line, ice)[effect_shock_shear].reason, HasSubstr("one active"));
  ice.internal_energy_form = true;
  EXPECT_FALSE(find_effects(plane, ice).on(effect_shock_shear));
  ice.internal_energy_form = false;
  ice.implicit.emplace();
  EXPECT_THAT(find_effects(plane, ice)[effect_shock_shear].reason,
              HasSubstr("with <ImplicitSolver>"));
}

TEST(Effects, TurbulenceBringsFrictionAndHeatFlux) {
  IceScene scene = materials(1, 0, 0);
  EXPECT_FALSE(find_effects(tube(), scene).on(effect_turbulence));
  scene.turbulence.emplace();
  scene.turbulence->constant = 0.1;
  scene.turbulence->where = {"deck.ups", 30, 1};
  scene.materials[0].subgrid = true;
  const EffectList e = find_effects(tube(), scene);
  for (const int id : {effect_turbulence, effect_viscosity, effect_conduction}) {
    EXPECT_TRUE(e.on(id));
    EXPECT_EQ(e[id].line.line, 30);
  }
  EXPECT_THAT(e[effect_turbulence].reason, HasSubstr("C_s = 0.1"));
  EXPECT_THAT(e[effect_conduction].reason, HasSubstr("Prandtl number 0.9"));
}

TEST(Effects, SutherlandAndSpongesAreViscous) {
  IceScene scene = materials(1, 0, 0);
  scene.materials[0].viscosity_models.sutherland.emplace();
  scene.materials[0].viscosity_models.sponges.resize(2);
  const EffectList e = find_effects(tube(), scene);
  EXPECT_TRUE(e.on(effect_viscosity));
  EXPECT_EQ(e[effect_viscosity].reason, "Sutherland's law, 2 sponge layers");
  EXPECT_FALSE(e.on(effect_conduction));
}

}  // namespace
}  // namespace sluice::ice::effects_test
