// Heat that passes the surfaces of solids, against lumps, conduction in series, and bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "mpmice/test_support/coupled_run.hpp"

namespace sluice::mpmice::heat_through_surfaces_test {
namespace {

const std::string solid_tags = "MaterialProperties/MPM/material/",
                  gas_tags = "MaterialProperties/ICE/material/";

std::string slab(double low, double high) {
  return fmt::format("<box><min>[{:.17g},-1,-1]</min><max>[{:.17g},2,2]</max></box>", low, high);
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double mean_of_solid(const CoupledRun& run) {
  return mean(run.particles("p.temperature")[0]);
}

// A bar in 1-D at 300 K in gas of another temperature between walls; dx = 1 cm, 1 m^2.
struct Bar {
  int cells = 3;
  double low = 1, high = 2;  // cells
  double hot = 301;
  std::string K = "3e6", drag = "0", time = "0.001";
  std::string gas, further_gas, fluid;  // gas: empty, one alone
  std::vector<std::string> further;

  static constexpr double dx = 0.01, rho_s = 1e4, c_s = 0.1, c_v = 717.5;
  double rho() const { return 1e5 / (287 * hot); }

  CoupledRun run() const {
    CoupledDeck deck;
    deck.cells = fmt::format("[{},1,1]", cells);
    deck.upper = fmt::format("[{},{},{}]", cells * dx, dx, dx);
    deck.time = time;
    deck.density = fmt::format("{}", rho_s);
    deck.bulk = "1e9";
    deck.shear = "5e8";
    deck.solid = solid_object(slab(low * dx, high * dx), "[0,0,0]", "[2,1,1]");
    deck.gas = gas.empty() ? gas_of(everywhere, rho(), hot) : gas;
    deck.further_gas = further_gas;
    deck.fluid = fluid;
    deck.heat = K;
    deck.drag = drag;
    deck.saves = {"temp_CC", "p.temperature"};
    std::vector<std::string> overrides = {solid_tags + "specific_heat=" + fmt::format("{}", c_s)};
    overrides.insert(overrides.end(), further.begin(), further.end());
    return CoupledRun(deck, overrides);
  }
};

// Gas on both sides of the bar, its mean temperature in each: h = K dx/4 wherever the faces lie,
//   C_L T_L' = -h (T_L - T),  C_R T_R' = -h (T_R - T),  C T' = h (T_L - T) + h (T_R - T)
double temperature_of_lumps(const Bar& bar, double h, double time) {
  const double C_L = bar.rho() * Bar::c_v * bar.low * Bar::dx,
               C_R = bar.rho() * Bar::c_v * (bar.cells - bar.high) * Bar::dx,
               C = Bar::rho_s * Bar::c_s * (bar.high - bar.low) * Bar::dx;
  double L = bar.hot, R = bar.hot, T = 300;
  constexpr int steps = 200000;
  for (int n = 0; n < steps; ++n) {
    const double dt = time / steps, q = h * (L - T), r = h * (R - T);
    L -= dt * q / C_L;
    R -= dt * r / C_R;
    T += dt * (q + r) / C;
  }
  return T;
}

// Measured: .4 % at most; cells that the faces cut share one state with the next.
TEST(HeatThroughSurfaces, IsThatOfACellCutInHalvesWhereverTheSurfaceLies) {
  double worst = 0;
  for (const double place : {0.0, 1e-7, 1e-3, 0.1, 0.25, 0.4, 0.49}) {
    Bar bar;
    bar.low += place;
    bar.high += place;
    const CoupledRun run = bar.run();
    ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
    const double expected = temperature_of_lumps(bar, 3e6 * Bar::dx / 4, 0.001) - 300;
    const double error = (mean_of_solid(run) - 300) / expected - 1;
    worst = std::max(worst, std::fabs(error));
    EXPECT_LT(std::fabs(error), 0.02) << place << ": " << error;
  }
  RecordProperty("worst", fmt::format("{:.2e}", worst));
}

// exp(-h A t (1/C_1 + 1/C_2)) of a bar with faces on the grid, where each had stayed as it was.
TEST(HeatThroughSurfaces, DecaysExponentially) {
  const Bar bar;
  const double h = 3e6 * Bar::dx / 4, C_s = Bar::rho_s * Bar::c_s * Bar::dx / 2,
               C_g = bar.rho() * Bar::c_v * Bar::dx;
  const double left = std::exp(-h * 0.001 * (1 / C_s + 1 / C_g));
  const CoupledRun run = bar.run();
  const double solid = mean_of_solid(run), gas = run.field("temp_CC", 1).components[0][0];
  EXPECT_NEAR((gas - solid) / left, 1, 0.02);
}

// do_convective_heat_transfer: K dx per area.
TEST(HeatThroughSurfaces, ConvectiveExchangeHasFourTimesTheCoefficient) {
  const std::string exchange = "MaterialProperties/exchange_properties/";
  Bar bar, convective;
  bar.K = "4e5";
  convective.K = "1e5";
  convective.further = {exchange + "do_convective_heat_transfer=true",
                        exchange + "convective_fluid=1", exchange + "convective_solid=0"};
  EXPECT_EQ(mean_of_solid(bar.run()), mean_of_solid(convective.run()));
}

// Half of the volume each, of one law: they exchange as one gas does.
TEST(HeatThroughSurfaces, EqualGasesExchangeAsOne) {
  const Bar bar;
  Bar halves;
  const std::string half = fmt::format(
      "<geom_object>{}<res>[1,1,1]</res><velocity>[0,0,0]</velocity><temperature>{}"
      "</temperature><density>{:.17g}</density><volumeFraction>0.5</volumeFraction>"
      "</geom_object>",
      everywhere, halves.hot, halves.rho());
  halves.gas = half;
  halves.further_gas =
      "<material name='other'><EOS type='ideal_gas'/><dynamic_viscosity>0</dynamic_viscosity>"
      "<thermal_conductivity>0</thermal_conductivity><specific_heat>717.5</specific_heat>"
      "<gamma>1.4</gamma>" +
      half + "</material>";
  halves.drag = "0,0,1e15";
  halves.K = "3e6,3e6,0";
  const CoupledRun run = halves.run();
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  EXPECT_NEAR((mean_of_solid(run) - 300) / (mean_of_solid(bar.run()) - 300), 1, 1e-4);
  // With the first of them alone: through half of the surface.
  halves.K = "3e6,0,0";
  Bar less;
  less.K = "1.5e6";
  const double one = mean_of_solid(halves.run()) - 300, half_film = mean_of_solid(less.run()) - 300;
  EXPECT_LT(one, half_film);  // it cools faster than both together would
  EXPECT_GT(one, 0.75 * half_film);
}

// The same in semi-implicit steps, whatever their length: exchange takes none of it.
TEST(HeatThroughSurfaces, OfSemiImplicitStepsIsTheSame) {
  const Bar bar;
  Bar implicit;
  implicit.fluid =
      "<ImplicitSolver><max_outer_iterations>20</max_outer_iterations>"
      "<outer_iteration_tolerance>1e-12</outer_iteration_tolerance>"
      "<Parameters variable='implicitPressure'><tolerance>1e-12</tolerance></Parameters>"
      "</ImplicitSolver>";
  implicit.further = {"Time/delt_max=1e-5"};
  const CoupledRun run = implicit.run();
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  EXPECT_NEAR((mean_of_solid(run) - 300) / (mean_of_solid(bar.run()) - 300), 1, 0.01);
}

// Of any coefficient: temperatures stay between the two.
TEST(HeatThroughSurfaces, NeverPassesTheTwoTemperatures) {
  for (const char* K : {"1e3", "1e8", "1e15"})
    for (const double place : {0.0, 1e-7, 0.2, 0.5, 0.8, 1 - 1e-7}) {
      Bar bar;
      bar.cells = 8;
      bar.low = 2 + place;
      bar.high = 5 + place;
      bar.hot = 302;
      bar.K = K;
      const CoupledRun run = bar.run();
      ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
      const auto T = run.particles("p.temperature")[0];
      const auto [low, high] = std::minmax_element(T.begin(), T.end());
      EXPECT_GE(*low, 300 - 1e-3) << K << " " << place;
      EXPECT_LE(*high, 302) << K << " " << place;
    }
}

// Two layers that conduct, far from their ends: of different k and rho c, one at 300 K, the other
// at 301. What has passed until t: Q = 2 e_1 (T_i - T_1) sqrt(t/pi), e = sqrt(k rho c),
// T_i = (e_1 T_1 + e_2 T_2)/(e_1 + e_2). A gas of gamma 1.001: its pressure takes no part in it.
double heat_of_two_layers(int cells, double place) {
  constexpr double c_v = 717.5, k_g = 3000, k_s = 6700, rho_g = 1e5 / (0.001 * c_v * 301), c_s = 50,
                   rho_s = 1e4, time = 0.0012;
  const double dx = 0.04 / cells;
  CoupledDeck deck;
  deck.cells = fmt::format("[{},1,1]", cells);
  deck.upper = fmt::format("[0.04,{0},{0}]", dx);
  deck.time = fmt::format("{}", time);
  deck.density = fmt::format("{}", rho_s);
  deck.bulk = "1e7";
  deck.shear = "5e6";
  deck.solid = solid_object(slab(-1, 0.02 + place * dx), "[0,0,0]", "[2,1,1]");
  deck.gas = gas_of(everywhere, rho_g, 301);
  deck.heat = "1e15";
  deck.saves = {"p.temperature"};
  const CoupledRun run(
      deck,
      {gas_tags + "gamma=1.001", gas_tags + fmt::format("thermal_conductivity={}", k_g),
       solid_tags + fmt::format("thermal_conductivity={}", k_s),
       solid_tags + fmt::format("specific_heat={}", c_s), "MPM/DoExplicitHeatConduction=true"});
  EXPECT_EQ(run.report().status, RunStatus::done) << run.report().message;
  const double e_s = std::sqrt(k_s * rho_s * c_s), e_g = std::sqrt(k_g * rho_g * c_v);
  const double exact = 2 * e_s * (e_g / (e_s + e_g)) * std::sqrt(time / std::numbers::pi);
  const double heat = rho_s * c_s * (0.02 + place * dx) * (mean_of_solid(run) - 300);
  return heat / exact - 1;
}

// Measured at the places 0, 0.3, 0.7 of a cell: 2.4, 10, -8 % on 20 cells, 0.9, 2.2, -1.2 % on 80.
TEST(HeatThroughSurfaces, TwoLayersConductInSeriesWithFirstOrder) {
  double coarse = 0, fine = 0;
  for (const double place : {0.0, 0.3, 0.7}) {
    coarse = std::max(coarse, std::fabs(heat_of_two_layers(20, place)));
    fine = std::max(fine, std::fabs(heat_of_two_layers(80, place)));
  }
  RecordProperty("worst", fmt::format("{:.4f} {:.4f}", coarse, fine));
  EXPECT_GE(std::log(coarse / fine) / std::log(4), 0.9) << coarse << " " << fine;
  EXPECT_LT(fine, 0.025);
}

// A block with its corner at the given place of a cell, heated by the gas around it.
class BlockInHotGas : public testing::TestWithParam<double> {
 protected:
  static CoupledRun run(double place, const std::string& time) {
    constexpr double dx = 0.005;
    const std::string box = solid_tags + "geom_object/box/";
    const double low = 0.04 + place * dx, high = 0.06 + place * dx;
    return CoupledRun("block_in_hot_gas",
                      {"Time/maxTime=" + time, box + fmt::format("min=[{0:.17g},{0:.17g},0]", low),
                       box + fmt::format("max=[{0:.17g},{0:.17g},0.005]", high)});
  }
  static void compare(const CoupledRun& run, double expected) {
    ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
    const auto T = run.particles("p.temperature")[0];
    RecordProperty("mean", fmt::format("{:.2f}", mean(T)));
    RecordProperty("energy", fmt::format("{:.2e}", run.drift("total energy")));
    EXPECT_NEAR(mean(T) / expected, 1, 0.02);
    EXPECT_GE(*std::min_element(T.begin(), T.end()), 293 - 1e-3);
    EXPECT_LE(*std::max_element(T.begin(), T.end()), 1073);
  }
};

// 816.4 K: the low-Mach flow on 80 by 80 cells.
TEST_P(BlockInHotGas, IsWarmedAlikeWhereverItsFacesLie) {
  compare(run(GetParam(), "0.005"), 816.4);
}
INSTANTIATE_TEST_SUITE_P(At, BlockInHotGas, testing::Values(0.0, 0.3));
INSTANTIATE_TEST_SUITE_P(Full, BlockInHotGas,
                         testing::Values(1e-7, 1e-3, 0.1, 0.2, 0.4, 0.499, 0.5, 0.501, 0.6, 0.7,
                                         0.8, 0.9, 0.999, 1 - 1e-7));

class FullBlockInHotGas : public BlockInHotGas {};

TEST_P(FullBlockInHotGas, EndsWithTheGasAtOneTemperature) {
  compare(run(GetParam(), "0.02"), 946.4);
  compare(run(GetParam(), "0.05"), 954.7);
}
INSTANTIATE_TEST_SUITE_P(Full, FullBlockInHotGas, testing::Values(0.0, 0.6));

}  // namespace
}  // namespace sluice::mpmice::heat_through_surfaces_test
