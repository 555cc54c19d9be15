// The Courant number of decks that do not say one.
#include <gtest/gtest.h>

#include "ice/deck/ice_scene.hpp"

namespace sluice::ice::courant_number_test {
namespace {

Scene scene_of(IntVec3 cells) {
  Scene scene;
  scene.grid.levels.resize(1);
  scene.grid.levels[0].domain = {{0, 0, 0}, cells};
  return scene;
}

TEST(CourantNumber, IsLargeWhereOneFluidMovesAlongOneDirectionAlone) {
  IceScene ice;
  ice.materials.resize(1);
  EXPECT_EQ(ice.courant_number(scene_of({100, 1, 1})), .8);
  EXPECT_EQ(ice.courant_number(scene_of({1, 1, 7})), .8);
  EXPECT_EQ(ice.courant_number(scene_of({100, 2, 1})), .4);
  EXPECT_EQ(ice.courant_number(scene_of({10, 10, 10})), .4);
  Scene levels = scene_of({100, 1, 1});
  levels.grid.levels.push_back(levels.grid.levels[0]);
  EXPECT_EQ(ice.courant_number(levels), .4);
  ice.cfl = .3;
  EXPECT_EQ(ice.courant_number(scene_of({100, 1, 1})), .3);
}

TEST(CourantNumber, IsUsualWithWhatNoMapProves) {
  const Scene row = scene_of({100, 1, 1});
  IceScene ice;
  ice.materials.resize(2);
  EXPECT_EQ(ice.courant_number(row), .4);
  ice.materials.resize(1);
  ice.solids = 1;
  EXPECT_EQ(ice.courant_number(row), .4);
  ice.solids = 0;
  ice.implicit.emplace();
  EXPECT_EQ(ice.courant_number(row), .4);
  ice.implicit.reset();
  ice.internal_energy_form = true;
  EXPECT_EQ(ice.courant_number(row), .4);
  ice.internal_energy_form = false;
  ice.materials[0].viscosity = 1e-5;
  EXPECT_EQ(ice.courant_number(row), .4);
  ice.materials[0].viscosity = 0;
  ice.materials[0].conductivity = 1;
  EXPECT_EQ(ice.courant_number(row), .4);
  ice.materials[0].conductivity = 0;
  EXPECT_EQ(ice.courant_number(row), .8);
  ice.models.scalars.emplace_back();
  EXPECT_EQ(ice.courant_number(row), .4);
}

}  // namespace
}  // namespace sluice::ice::courant_number_test
