// Where nodes are, and which lie on sides of the domain.
#include "framework/grid/nodes.hpp"

#include <gtest/gtest.h>

namespace sluice::nodes_test {
namespace {

// A slab: z is no direction of the run, y is periodic.
Level slab() {
  Level level;
  level.anchor = {1, 0, 0};
  level.spacing = {0.5, 0.25, 1};
  level.domain = {{0, 0, 0}, {4, 8, 1}};
  level.active = {true, true, false};
  level.periodic = {false, true, false};
  return level;
}

TEST(Nodes, AreAtLowCornersOfCells) {
  EXPECT_EQ(node_position(slab(), {0, 0, 0}), (Vec3{1, 0, 0}));
  EXPECT_EQ(node_position(slab(), {4, 8, 0}), (Vec3{3, 2, 0}));
}

TEST(Nodes, InnerOnesLieOnNoSide) {
  const IndexBox inner = inner_nodes(slab());
  EXPECT_FALSE(inner.contains(IntVec3{0, 3, 0}));
  EXPECT_TRUE(inner.contains(IntVec3{1, 0, 0}));
  EXPECT_TRUE(inner.contains(IntVec3{3, 8, 0}));
  EXPECT_FALSE(inner.contains(IntVec3{4, 3, 0}));
  EXPECT_TRUE(inner.contains(IntVec3{1, -100, 0}));  // no side along a periodic direction
}

TEST(Nodes, SidesAreWhereTheDomainEnds) {
  EXPECT_TRUE(ends_at(slab(), Side::x_plus));
  EXPECT_FALSE(ends_at(slab(), Side::y_minus));
  EXPECT_FALSE(ends_at(slab(), Side::z_plus));
  const IndexBox box{{2, 2, 0}, {6, 5, 1}};  // ghosts beyond the domain with it
  EXPECT_EQ(side_nodes(slab(), Side::x_plus, box), (IndexBox{{4, 2, 0}, {5, 5, 1}}));
  EXPECT_TRUE(side_nodes(slab(), Side::x_minus, box).empty());
}

}  // namespace
}  // namespace sluice::nodes_test
