// Which directions are active, what happens to the velocity along the others, and why.
#include "framework/scene/directions.hpp"

#include "framework/scene/test_support/deck_text.hpp"

namespace sluice::directions_test {
namespace {

using testing::HasSubstr;

const std::string mirror = "<BCType id=\"all\" label=\"Symmetric\" var=\"symmetry\"/>";
const std::string open =
    "<BCType id=\"0\" label=\"Pressure\" var=\"Neumann\"><value>0</value></BCType>"
    "<BCType id=\"0\" label=\"Velocity\" var=\"Neumann\"><value>[0,0,0]</value></BCType>"
    "<BCType id=\"0\" label=\"SpecificVol\" var=\"computeFromDensity\"><value>0</value></BCType>";
const std::string wall =
    "<BCType id=\"0\" label=\"Velocity\" var=\"Dirichlet\"><value>[0,0,0]</value></BCType>"
    "<BCType id=\"0\" label=\"Pressure\" var=\"Neumann\"><value>0</value></BCType>";

// nx x ny x nz cells; the same content on the x, y and z sides.
std::array<ActiveDirection, 3> judge(const std::string& cells, const std::string& y,
                                     const std::string& z, const DirectionFacts& facts,
                                     const std::string& periodic = "[0,0,0]",
                                     const std::string& extra = "") {
  auto sides = [](const std::string& d, const std::string& content) {
    if (content.empty()) return std::string();
    return "<Face side=\"" + d + "-\">" + content + "</Face>\n<Face side=\"" + d + "+\">" +
           content + "</Face>\n";
  };
  const DeckText deck(
      "<Grid><BoundaryConditions>\n" + sides("x", open) + sides("y", y) + sides("z", z) + extra +
      "</BoundaryConditions><Level><Box><lower>[0,0,0]</lower>"
      "<upper>[1,1,1]</upper><resolution>" +
      cells + "</resolution></Box><periodic>" + periodic + "</periodic></Level></Grid>\n");
  std::vector<Fault> faults;
  const GridSettings grid = read_grid_settings(deck.first(), faults);
  const BoundaryConditions boundary =
      read_boundary_conditions(deck.first().child("BoundaryConditions"), grid, 1, {}, faults);
  EXPECT_EQ(all_faults(faults), "");
  return find_active_directions(grid, boundary, facts);
}

DirectionFacts moving(int d) {
  DirectionFacts facts;
  facts.moving[d] = true;
  facts.moving_where[d] = {"deck.ups", 99, 1};
  return facts;
}

TEST(Directions, OneCellBetweenSymmetricFacesIsNotActive) {
  const auto d = judge("[10,1,1]", mirror, mirror, {});
  EXPECT_TRUE(d[0].active);
  EXPECT_EQ(d[0].velocity, VelocityComponent::solved);
  EXPECT_EQ(d[0].reason, "10 cells");
  for (std::size_t i : {1u, 2u}) {
    EXPECT_FALSE(d[i].active);
    EXPECT_EQ(d[i].velocity, VelocityComponent::dropped);
    EXPECT_EQ(d[i].reason, "one cell between symmetric faces");
  }
  EXPECT_EQ(d[1].where.line, 5);
  EXPECT_EQ(d[2].where.line, 7);
}

TEST(Directions, AnyAxisMayBeTheOne) {
  EXPECT_FALSE(judge("[1,10,1]", mirror, mirror, {})[0].active);
  EXPECT_TRUE(judge("[1,10,1]", mirror, mirror, {})[1].active);
  EXPECT_TRUE(judge("[1,1,10]", mirror, mirror, {})[2].active);
  EXPECT_TRUE(judge("[1,1,1]", mirror, mirror, {})[0].active);  // one must remain
}

TEST(Directions, ZeroGradientAndPeriodicCarryAMovingComponent) {
  const auto open_faces = judge("[10,1,1]", open, mirror, moving(1));
  EXPECT_FALSE(open_faces[1].active);
  EXPECT_EQ(open_faces[1].velocity, VelocityComponent::carried);
  EXPECT_EQ(open_faces[1].reason, "one cell between zero-gradient faces");
  EXPECT_EQ(judge("[10,1,1]", open, mirror, {})[1].velocity, VelocityComponent::dropped);
  const auto periodic = judge("[10,1,1]", mirror, "", moving(2), "[0,0,1]");
  EXPECT_FALSE(periodic[2].active);
  EXPECT_EQ(periodic[2].velocity, VelocityComponent::carried);
  EXPECT_EQ(periodic[2].reason, "one cell between periodic faces");
}

TEST(Directions, WhatActsAlongADirectionKeepsItActive) {
  DirectionFacts gravity;
  gravity.gravity = {0, -9.81, 0};
  EXPECT_TRUE(judge("[10,1,1]", mirror, mirror, gravity)[1].active);
  EXPECT_THAT(judge("[10,1,1]", mirror, mirror, gravity)[1].reason, HasSubstr("gravity"));
  const auto pushed = judge("[10,1,1]", mirror, mirror, moving(2));
  EXPECT_TRUE(pushed[2].active);
  EXPECT_EQ(pushed[2].where.line, 99);
  EXPECT_FALSE(pushed[1].active);
}

TEST(Directions, WallsAndMixedSidesStayActive) {
  EXPECT_TRUE(judge("[10,1,1]", wall, mirror, {})[1].active);
  EXPECT_THAT(judge("[10,1,1]", wall, mirror, {})[1].reason, HasSubstr("not both symmetric"));
  EXPECT_TRUE(
      judge("[10,1,1]", "", mirror, {}, "[0,0,0]",
            "<Face side=\"y-\">" + mirror + "</Face><Face side=\"y+\">" + open + "</Face>")[1]
          .active);
  // A hole in a symmetric side.
  EXPECT_TRUE(
      judge("[10,1,1]", mirror, mirror, {}, "[0,0,0]",
            "<Face rectangle=\"y-\" lower=\"0 0 0\" upper=\"0.5 0 1\">" + open + "</Face>")[1]
          .active);
  EXPECT_FALSE(
      judge("[10,1,1]", mirror, mirror, {}, "[0,0,0]",
            "<Face rectangle=\"x-\" lower=\"0 0 0\" upper=\"0 1 1\">" + open + "</Face>")[1]
          .active);
}

TEST(Directions, TheSwitchForcesAll) {
  DirectionFacts facts;
  facts.force_all = true;
  for (const ActiveDirection& d : judge("[10,1,1]", mirror, mirror, facts)) EXPECT_TRUE(d.active);
  EXPECT_THAT(judge("[10,1,1]", mirror, mirror, facts)[2].reason, HasSubstr("--force-directions"));
}

}  // namespace
}  // namespace sluice::directions_test
