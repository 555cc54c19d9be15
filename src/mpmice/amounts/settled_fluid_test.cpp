// Amounts of cells become a state: what a cell holds, gaps, what is no state, cells without fluid.
#include "mpmice/amounts/settled_fluid.hpp"

#include <gtest/gtest.h>

#include "mpmice/amounts/cell_merging.hpp"
#include "mpmice/test_support/block_in_cells.hpp"

namespace sluice::mpmice::settled_fluid_test {
namespace {

constexpr double rho = 1.2, rho_e = 2.5e5;

// A gas beside the face of a block at 5.25 cells, in one direction.
struct GasBesideBlock {
  BlockInCells<1> block{16, 0.5, 5.25, 8.5};
  GivenFluid fluid;
  SmoothNormals<1> normals;
  CellAmounts<1> amounts;
  SolidGeometry<1>* solid = nullptr;

  GasBesideBlock() {
    block.find_surfaces();
    solid = &block.surfaces.solid();
    solid->theta_next = solid->theta;
    solid->covered_next = solid->covered;
    normals.find(block.near, *solid, block.surfaces.on());
    const std::size_t n = block.near.size();
    amounts.volume.assign(n, 1.0);
    amounts.near.assign(n, 1);
    amounts.touched.assign(n, 1);
    for (auto* of : {&amounts.mass, &amounts.filled, &amounts.energy, &amounts.momentum})
      of->assign(1, Column(n, 0.0));
    amounts.kinetic.assign(n, 0.0);
    block.near.for_each([&](const Cell<1>&, std::size_t i) {
      const double V = 1 - solid->theta[i];
      amounts.volume[i] = amounts.filled[0][i] = V;
      amounts.mass[0][i] = rho * V;
      amounts.kinetic[i] = rho_e * V;  // of one gas all of its energy
    });
  }
  std::size_t at(int i) const { return block.at({i}); }
};

TEST(SettledFluid, HasWhatTheCellHoldsPerVolumeOfFluid) {
  GasBesideBlock gas;
  const double u = 20;
  gas.amounts.momentum[0][gas.at(5)] = rho * 0.25 * u;
  SettledFluid<1> settled(gas.fluid.part());
  std::string reason;
  ASSERT_TRUE(settled.settle(gas.block.near, gas.amounts, *gas.solid, reason)) << reason;
  const double p = 0.4 * (rho_e - 0.5 * rho * u * u), c = std::sqrt(1.4 * p / rho);
  EXPECT_NEAR(settled.rates(gas.block.near, gas.amounts).flow, u / 0.5, 1e-11);
  const double at_rest = std::sqrt(1.4 * 0.4 * rho_e / rho) / 0.5;
  EXPECT_NEAR(settled.rates(gas.block.near, gas.amounts).sound, std::max((u + c) / 0.5, at_rest),
              1e-8);
}

TEST(SettledFluid, AGapWithoutFluidWaits) {
  GasBesideBlock gas;
  const std::size_t gap = gas.at(5);
  gas.amounts.mass[0][gap] = gas.amounts.kinetic[gap] = 0;
  SettledFluid<1> settled(gas.fluid.part());
  std::string reason;
  EXPECT_TRUE(settled.settle(gas.block.near, gas.amounts, *gas.solid, reason));
  EXPECT_EQ(gas.solid->theta_next[gap], 1);
  EXPECT_EQ(gas.amounts.volume[gap], 0);
}

TEST(SettledFluid, SaysWhichCellIsInNoState) {
  GasBesideBlock gas;
  gas.amounts.kinetic[gas.at(5)] = -1;
  SettledFluid<1> settled(gas.fluid.part());
  std::string reason;
  EXPECT_FALSE(settled.settle(gas.block.near, gas.amounts, *gas.solid, reason));
  EXPECT_NE(reason.find("cell [5, 0, 0] is in an inadmissible state"), std::string::npos) << reason;
  EXPECT_EQ(settled.inadmissible()[gas.at(5)], 1);
  EXPECT_EQ(settled.inadmissible()[gas.at(4)], 0);
}

// A cell s of a quarter shares with the one beside it, j, which is in a neighbourhood of its own
// too: Q = (A_s + A_j/2)/(V_s + V_j/2), A_s' = V_s Q, A_j' = A_j/2 + V_j Q/2; twice.
TEST(CellMerging, ASmallCellSharesWithTheNext) {
  GasBesideBlock gas;
  const std::size_t small = gas.at(5), large = gas.at(4);
  gas.amounts.mass[0][small] = 3 * 0.25;
  double A_s = gas.amounts.mass[0][small], A_j = gas.amounts.mass[0][large];
  for (int pass = 0; pass < 2; ++pass) {
    const double Q = (A_s + A_j / 2) / (0.25 + 0.5);
    A_s = 0.25 * Q;
    A_j = A_j / 2 + 0.5 * Q;
  }
  CellMerging<1> merging;
  merging.begin();
  merging.share(gas.block.near, *gas.solid, gas.normals, gas.amounts);
  EXPECT_FALSE(merging.trapped());
  EXPECT_NEAR(gas.amounts.mass[0][small], A_s, 1e-15);
  EXPECT_NEAR(gas.amounts.mass[0][large], A_j, 1e-15);
  EXPECT_EQ(gas.amounts.mass[0][gas.at(3)], rho);
}

// One that closes gives all, to the bit; where nobody takes it, it says so.
TEST(CellMerging, AClosingCellGivesAllOrSaysThatItCannot) {
  for (const bool room : {true, false}) {
    GasBesideBlock gas;
    const std::size_t closing = gas.at(5);
    gas.amounts.volume[closing] = 0;
    gas.solid->theta_next[closing] = 1;
    if (!room) gas.amounts.near.assign(gas.amounts.near.size(), 0);
    gas.amounts.near[closing] = 1;
    CellMerging<1> merging;
    merging.begin();
    merging.share(gas.block.near, *gas.solid, gas.normals, gas.amounts);
    EXPECT_EQ(merging.trapped(), !room);
    if (room) {
      EXPECT_EQ(gas.amounts.mass[0][closing], 0);
    }
    const std::string fault = merging.fault(gas.block.near.frame());
    EXPECT_EQ(fault.find("solids close cell [5, 0, 0]") != std::string::npos, !room) << fault;
  }
}

// What is no state is one together with the cells around.
TEST(CellMerging, WhatIsNoStateSharesUntilItIsOne) {
  GasBesideBlock gas;
  FluidAmounts<1> fluid(gas.fluid.part());
  fluid.amounts() = gas.amounts;
  fluid.amounts().kinetic[gas.at(5)] = -1;
  SettledFluid<1> settled(gas.fluid.part());
  std::string reason;
  ASSERT_FALSE(settled.settle(gas.block.near, fluid.amounts(), *gas.solid, reason));
  const CellMerging<1> merging;
  EXPECT_TRUE(merging.share_inadmissible(gas.block.near, *gas.solid, gas.normals, fluid, settled,
                                         world(), reason));
  EXPECT_TRUE(reason.empty());
  EXPECT_GT(fluid.amounts().kinetic[gas.at(5)], 0);
}

}  // namespace
}  // namespace sluice::mpmice::settled_fluid_test
