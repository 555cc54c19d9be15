// Bodies that leave the domain through open sides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mpmice/test_support/coupled_run.hpp"

namespace sluice::mpmice::leaving_bodies_test {
namespace {

std::string faces_open_at(const std::vector<std::string>& sides) {
  std::string faces;
  for (const std::string side : {"x-", "x+", "y-", "y+", "z-", "z+"}) {
    if (std::find(sides.begin(), sides.end(), side) == sides.end()) {
      faces += fmt::format(
          "<Face side='{}'><BCType id='all' label='Symmetric' var='symmetry'/></Face>", side);
      continue;
    }
    faces += fmt::format("<Face side='{}'>", side);
    for (const std::string label : {"Pressure", "Density", "Temperature"})
      faces += fmt::format("<BCType id='{}' label='{}' var='Neumann'><value>0</value></BCType>",
                           label == "Pressure" ? "0" : "all", label);
    faces +=
        "<BCType id='all' label='Velocity' var='Neumann'><value>[0,0,0]</value></BCType></Face>";
  }
  return faces;
}

// A disk that falls out of an open side, whole: the rows of cells beside it stay what they are.
TEST(DiskThatLeaves, TakesNoGasAlong) {
  CoupledDeck deck;
  deck.cells = "[24,24,1]";
  deck.upper = "[1,1,0.041666666666666664]";
  deck.time = "0.004";
  deck.density = "7800";
  deck.bulk = "1e8";
  deck.shear = "5e7";
  deck.solid = solid_object(disk_at(0.6, 0.25, 0.17), "[-80,-170,0]");
  deck.faces = faces_open_at({"y-"});
  deck.saves = {"press_CC", "rho_CC"};
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  EXPECT_LT(std::fabs(run.drift("mass of material 1")), 1e-13);
  const DenseField pressure = run.field("press_CC", 0);
  const auto [least, most] =
      std::minmax_element(pressure.components[0].begin(), pressure.components[0].end());
  const double low = *least, high = *most;
  RecordProperty("pressures", fmt::format("{:.3e} {:.3e}", low, high));
  EXPECT_GT(low, 0.5e5);
  EXPECT_LT(high, 2e5);
}

// A bar that leaves so fast that it is torn: the cell on the side holds next to no gas, no cell
// beside it has some to lend, and what flows out of it is no more than it has.
TEST(BarThrownOut, LeavesNoCellInDebt) {
  CoupledDeck deck;
  deck.cells = "[60,1,1]";
  deck.upper = "[1,0.016666666666666666,0.016666666666666666]";
  deck.time = "3e-4";
  deck.density = "1000";
  deck.bulk = "6e5";
  deck.shear = "3e5";
  deck.specific_heat = "300";
  deck.heat = "1000";
  deck.solid = solid_object(box_from("[0.26037835846010937,-9,-9]", "[0.7577604551492665,9,9]"),
                            "[-1024.060172635161,0,0]", "[3,1,1]");
  deck.gas = gas_of(everywhere, 0.14888257554386827, 660.750161466862);
  deck.faces = faces_open_at({"x-", "x+"});
  const CoupledRun run(deck, {"MPM/interpolator=cpdi"});
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
}

}  // namespace
}  // namespace sluice::mpmice::leaving_bodies_test
