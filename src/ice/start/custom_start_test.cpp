// Named starts: what each leaves in a cell, and the order in which they act.
#include "ice/start/custom_start.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sluice::ice::custom_start_test {
namespace {

// A box of 10 by 10 by 10 cells over [2, 4]^3: no corner at zero.
Level cube() {
  Level level;
  level.anchor = {2, 2, 2};
  level.spacing = {0.2, 0.2, 0.2};
  level.domain = {{0, 0, 0}, {10, 10, 10}};
  return level;
}

CellStart started(const CustomStart& start, Vec3 at) {
  static const Level level = cube();
  CellStart cell{at, 2.0, 300.0, {5, 6, 7}, 1e-3, 0, false};
  apply(start, {level, 1e5}, cell);
  return cell;
}

TEST(CustomStart, AVortexTurnsThePlaneNormalToItsAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    Vec3 at{3, 3, 3};
    at[a] += 0.1;
    at[axis] += 0.5;  // along the axis nothing changes
    const CellStart cell = started(Vortices{{{{3, 3, 3}, 10, 0.5, axis}}}, at);
    const double w = std::exp(-0.5 * 0.01 / 0.25);
    const Vec3 background{5, 6, 7};
    EXPECT_EQ(cell.velocity[a], background[a]);
    EXPECT_NEAR(cell.velocity[b] - background[b], 10 * 0.1 * w / (2.0 * 0.25), 1e-12);
    EXPECT_EQ(cell.velocity[axis], background[axis]);
    EXPECT_NEAR(cell.pressure, 1e5 + 2.0 * 100 / 0.25 * w, 1e-9);
  }
  const CellStart outside = started(Vortices{{{{3, 3, 3}, 10, 0.5, 2}}}, {3.6, 3, 3});
  EXPECT_EQ(outside.velocity.y, 6);
  EXPECT_EQ(outside.pressure, 1e5);
  EXPECT_TRUE(outside.pressure_given);
}

TEST(CustomStart, ASpotIsAddedToTheTemperature) {
  const GaussianTemperature spot{{3, 3, 0}, 0.1, 0.2, 700};
  EXPECT_EQ(started(spot, {3, 3, 9}).temperature, 1000);
  EXPECT_NEAR(started(spot, {3.1, 3.2, 0}).temperature, 300 + 700 * std::exp(-1.0), 1e-9);
  EXPECT_FALSE(started(spot, {3, 3, 3}).pressure_given);
}

// Differences of second order: these flows have no divergence.
TEST(CustomStart, ManufacturedFlowsAndPairsOfVorticesHaveNoDivergence) {
  const double h = 1e-3;
  for (const CustomStart& start :
       {CustomStart{ManufacturedVortices{0.7}}, CustomStart{ManufacturedCells{0.4}},
        CustomStart{VortexPairs{0.3, 0, 1}}, CustomStart{VortexPairs{0.02, 1, 3}},
        CustomStart{VortexPairs{-0.2, 2, 2}}}) {
    const Vec3 at{2.3, 3.1, 2.9};
    double divergence = 0, scale = 0;
    for (int d = 0; d < 3; ++d) {
      Vec3 low = at, high = at;
      low[d] -= h;
      high[d] += h;
      const double slope =
          (started(start, high).velocity[d] - started(start, low).velocity[d]) / (2 * h);
      divergence += slope;
      scale += std::abs(slope);
    }
    EXPECT_GT(scale, 0.01);
    EXPECT_NEAR(divergence, 0, 1e-4 * scale) << start.index();
  }
  EXPECT_NEAR(started(ManufacturedVortices{2}, {0, 0, 0}).pressure, 1e5 - 2 * 2, 1e-9);
}

// Along the middle between the sides the velocity across changes sign twice a pair.
TEST(CustomStart, PairsOfVorticesTurnInTurnAndRestAtTheSides) {
  for (int axis = 0; axis < 3; ++axis)
    for (const bool swapped : {false, true}) {
      Level level = cube();
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      level.periodic[swapped ? a : b] = true;
      const int across = swapped ? b : a, along = swapped ? a : b;
      const auto velocity = [&](double y, double z) {
        CellStart cell{{2.5, 2.5, 2.5}, 2.0, 300.0, {}, 0, 0, false};
        cell.centre[across] = y;
        cell.centre[along] = z;
        apply(VortexPairs{0.5, axis, 3}, {level, 1e5}, cell);
        EXPECT_EQ(cell.velocity[axis], 0);
        EXPECT_FALSE(cell.pressure_given);
        return cell.velocity;
      };
      constexpr int n = 600;
      int turns = 0;
      double most = 0, total = 0;
      for (int i = 0; i < n; ++i) {
        const double z = 2 + 2 * (i + 0.5) / n, u = velocity(3, z)[across];
        turns += u * velocity(3, z + 2.0 / n)[across] < 0;
        most = std::max(most, std::abs(u));
        total += u;
        for (const double side : {2.0, 4.0})
          for (int d = 0; d < 3; ++d) EXPECT_NEAR(velocity(side, z)[d], 0, 1e-15);
        EXPECT_NEAR(velocity(2.3, z)[along], -velocity(3.7, z)[along], 1e-15);
      }
      EXPECT_EQ(turns, 6);
      EXPECT_NEAR(most, 0.5, 1e-4);
      EXPECT_NEAR(total, 0, 1e-12);
    }
}

TEST(CustomStart, JetsMeetInTheMiddleOfTheDomain) {
  const Counterflow flow{100, {0, 0, 0}};
  const CellStart middle = started(flow, {3, 3, 3});
  EXPECT_NEAR(middle.velocity.x, 0, 1e-12);
  EXPECT_NEAR(middle.velocity.y, 0, 1e-12);
  const CellStart corner = started(flow, {2.1, 2.1, 2.1});  // the cell of reference
  EXPECT_NEAR(corner.velocity.x, 90, 1e-9);
  EXPECT_NEAR(corner.velocity.y, -90, 1e-9);
  EXPECT_NEAR(corner.pressure, 1e5, 1e-6);
  EXPECT_NEAR(middle.pressure - corner.pressure, 0.5 * 2.0 * 2 * 90 * 90, 1e-6);  // Bernoulli
}

TEST(CustomStart, ProfilesRiseFromTheFloor) {
  const LogLawProfile log{1, 0, 0.5, 0.01, 0.4};
  EXPECT_EQ(started(log, {3, 2.005, 3}).velocity.x, 0);
  EXPECT_NEAR(started(log, {3, 2.01 * std::exp(0.0) + 0.01 * (std::exp(1.0) - 1), 3}).velocity.x,
              0.5 / 0.4, 1e-9);
  const PowerLawProfile power{1, 0.25, 0.5, {4, 0, 2}};
  EXPECT_NEAR(started(power, {3, 2.0625, 3}).velocity.x, 2, 1e-12);
  EXPECT_EQ(started(power, {3, 3, 3}).velocity.x, 4);
  EXPECT_EQ(started(power, {3, 3, 3}).velocity.z, 2);
  EXPECT_EQ(started(power, {3, 3, 3}).velocity.y, 0);
}

TEST(CustomStart, ChannelsAreSymmetric) {
  ChannelProfile turbulent{1, 0, 395, 1, {}, {}};
  const double low = started(turbulent, {3, 2.3, 3}).velocity.x;
  EXPECT_NEAR(low, started(turbulent, {3, 3.7, 3}).velocity.x, 1e-12);
  EXPECT_NEAR(low, 1e-3 * 395 / 2 / 0.4 * std::log(0.3 * 395), 1e-12);
  EXPECT_EQ(started(turbulent, {3, 2.001, 3}).velocity.x, 0);
  turbulent.ceiling = 3;
  EXPECT_EQ(started(turbulent, {3, 2.999, 3}).velocity.x, 0);
  const LaminarChannel laminar{1, -0.01};
  EXPECT_NEAR(started(laminar, {3, 3, 3}).velocity.x, 0.01 * 4 / (8 * 1e-3), 1e-12);
  EXPECT_NEAR(started(laminar, {3, 2, 3}).velocity.x, 0, 1e-12);
}

TEST(CustomStart, TheLastOfTheDeckActsFirst) {
  const Deck deck = read_deck_text(
      "<Uintah_specification><customInitialization><gaussianTemperature><origin>[0,0,0]</origin>"
      "<spread_x>1</spread_x><spread_y>2</spread_y><amplitude>3</amplitude></gaussianTemperature>"
      "<manufacturedSolution type='mms_3'><angle>0.5</angle></manufacturedSolution>"
      "<vortices><vortex><axis>X</axis><origin>[1,2,3]</origin><strength>10</strength>"
      "<radius>0.5</radius></vortex></vortices><vortexPairs><strength>0.1</strength><axis>y</axis>"
      "<numVortexPairs>2</numVortexPairs></vortexPairs></customInitialization></"
      "Uintah_specification>",
      "starts.ups");
  const auto starts = read_custom_starts(*deck.root->child("customInitialization"));
  ASSERT_EQ(starts.size(), 4u);
  EXPECT_EQ(std::get<VortexPairs>(starts[0]).axis, 1);
  EXPECT_EQ(std::get<VortexPairs>(starts[0]).pairs, 2);
  EXPECT_EQ(std::get<Vortices>(starts[1]).list.at(0).axis, 0);
  EXPECT_EQ(std::get<ManufacturedCells>(starts[2]).angle, 0.5);
  EXPECT_EQ(std::get<GaussianTemperature>(starts[3]).spread_y, 2);
}

}  // namespace
}  // namespace sluice::ice::custom_start_test
