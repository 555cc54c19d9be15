// Bodies of any size and stiffness in gas: exchange of any coefficient, thin shells, bodies that
// meet with gas between them, three dimensions, rotation.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numeric>

#include "mpmice/test_support/coupled_run.hpp"

namespace sluice::mpmice::hard_coupled_runs_test {
namespace {

constexpr int gas = 1;

double farthest(const DenseField& f, double value, int c = 0) {
  double most = 0;
  for (const double q : f.components[c]) most = std::max(most, std::fabs(q - value));
  return most;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::pair<double, double> range(const DenseField& f) {
  const auto& values = f.components.front();
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

// A disk thrown through gas of two pressures.
CoupledDeck thrown(const std::string& drag) {
  CoupledDeck deck;
  deck.cells = "[24,24,1]";
  deck.upper = "[1,1,0.041666666666666664]";
  deck.solid = solid_object(disk_at(0.4, 0.5, 0.15), "[40,15,0]");
  deck.gas = gas_object(box_from("[-1,-1,-1]", "[0.7,2,2]"), 1e5) +
             gas_object(box_from("[0.7,-1,-1]", "[2,2,2]"), 3e5);
  deck.drag = drag;
  return deck;
}

class ExchangeOfAnySize : public testing::TestWithParam<const char*> {};

TEST_P(ExchangeOfAnySize, KeepsMassMomentumAndNearlyEnergy) {
  const CoupledRun run(thrown(GetParam()));
  ASSERT_EQ(run.report().status, RunStatus::done);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
  EXPECT_LT(std::fabs(run.drift("total energy")), 1e-3);
  RecordProperty("energy", fmt::format("{:.3e}", run.drift("total energy")));
}

INSTANTIATE_TEST_SUITE_P(Of, ExchangeOfAnySize, testing::Values("0", "1e3", "1e7", "1e15", "1e20"),
                         [](const auto& test) { return std::string(test.param); });

TEST(ExchangeWithoutEnd, IsOneMotion) {
  const CoupledRun large(thrown("1e15")), larger(thrown("1e20"));
  const auto v = large.particles("p.velocity"), w = larger.particles("p.velocity");
  for (std::size_t p = 0; p < v[0].size(); ++p) EXPECT_NEAR(v[0][p], w[0][p], 1e-6);
}

// A plate that moves along itself drags the gas in cells with both, by a coefficient or by the
// viscosity of the gas; pressures do nothing. What motion loses heat gains.
class RubbingPlate : public testing::TestWithParam<bool> {};

TEST_P(RubbingPlate, LosesNoEnergy) {
  CoupledDeck deck;
  deck.cells = "[20,4,1]";
  deck.upper = "[1,0.2,0.05]";
  deck.periodic = "[0,1,0]";
  deck.multiplier = "0.2";
  deck.solid = solid_object(box_from("[0.41,-1,-1]", "[0.59,2,2]"), "[0,50,0]");
  (GetParam() ? deck.viscosity : deck.drag) = GetParam() ? "5" : "1e5";
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done);
  double moving = 0, before = 0;  // energy of motion of the plate, J per mass
  const auto velocities = run.particles("p.velocity");
  for (const double v : velocities[1]) {
    moving += 0.5 * v * v;
    before += 0.5 * 50 * 50;
  }
  const Json books = Json::parse(run.report().conservation_json);
  const double scale = books.at("total energy").at("scale").get<double>();
  const double mass = 100 * 0.18 * 0.2 * 0.05;
  const double lost = (1 - moving / before) * 0.5 * mass * 50 * 50 / scale;
  RecordProperty("lost", fmt::format("{:.3e}", lost));
  EXPECT_GT(lost, 0);
  // Of viscosity: the plate is pulled at its surfaces and shears, which costs transfers something.
  EXPECT_LT(std::fabs(run.drift("total energy")), (GetParam() ? 1e-2 : 1e-4) * lost);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(By, RubbingPlate, testing::Bool(),
                         [](const auto& test) { return test.param ? "viscosity" : "coefficient"; });

CoupledDeck ball() {
  CoupledDeck deck;
  deck.cells = "[16,16,16]";
  deck.upper = "[1,1,1]";
  deck.solid = solid_object("<sphere><origin>[0.45,0.5,0.52]</origin><radius>0.2</radius></sphere>",
                            "[40,15,-20]", "[2,2,2]");
  deck.time = "0.0008";
  return deck;
}

// Gas that moves with it, through periodic sides.
TEST(Ball, AndGasThatMoveTogetherFeelNothing) {
  CoupledDeck deck = ball();
  deck.periodic = "[1,1,1]";
  deck.gas = gas_object(everywhere, 1e5, "[40,15,-20]");
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done);
  EXPECT_LT(farthest(run.field("press_CC", 0), 1e5), 1e-10 * 1e5);
  EXPECT_LT(farthest(run.field("temp_CC", gas), 300), 1e-10 * 300);
  for (int c = 0; c < 3; ++c)
    EXPECT_LT(farthest(run.field("vel_CC", gas), std::array{40, 15, -20}[c], c), 1e-9);
}

TEST(Ball, TakesFromTheGasWhatItGets) {
  CoupledDeck deck = ball();
  deck.gas = gas_object(box_from("[-1,-1,-1]", "[0.7,2,2]"), 1e5) +
             gas_object(box_from("[0.7,-1,-1]", "[2,2,2]"), 3e5);
  deck.drag = "1e15";
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
  EXPECT_LT(std::fabs(run.drift("total energy")), 2e-3);
}

// A shell as thick as a cell between 2e5 and 1e5 Pa, its surfaces anywhere in their cells.
class ThinShell : public testing::TestWithParam<double> {};

TEST_P(ThinShell, IsDrivenAndLeavesNothingBehind) {
  CoupledDeck deck;
  deck.cells = "[50,1,1]";
  deck.upper = "[1,0.02,0.02]";
  const double x = 0.4 + 0.02 * GetParam();
  deck.solid = solid_object(
      fmt::format("<box><min>[{:.12g},-1,-1]</min><max>[{:.12g},2,2]</max></box>", x, x + 0.02),
      "[0,0,0]", "[2,1,1]");
  deck.density = "1000";
  deck.bulk = "1e8";
  deck.shear = "6e7";
  const std::string middle = fmt::format("{:.12g}", x + 0.01);
  deck.gas = gas_object(box_from("[-1,-1,-1]", "[" + middle + ",2,2]"), 2e5) +
             gas_object(box_from("[" + middle + ",-1,-1]", "[2,2,2]"), 1e5);
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
  const auto [low, high] = range(run.field("press_CC", 0));
  EXPECT_GT(low, 0.9e5);
  EXPECT_LT(high, 2.2e5);
  // dp/Z (1 - e^(-Z t/m)) = 4.88 with Z = 1210 of both gases. While such a shell crosses a plane of
  // the grid one cell holds gas of both sides, at one pressure: measured 4.44 to 4.67.
  RecordProperty("velocity", std::to_string(mean(run.particles("p.velocity")[0])));
  const double expected = GetParam() < 0.8 ? 4.88 : 4.55;
  EXPECT_NEAR(mean(run.particles("p.velocity")[0]), expected, GetParam() < 0.8 ? 0.02 : 0.15);
}

INSTANTIATE_TEST_SUITE_P(At, ThinShell,
                         testing::Values(0.0, 1e-8, 1e-4, 0.01, 0.25, 0.5, 0.75, 0.9, 0.99, 0.9999,
                                         0.99999999),
                         [](const auto& test) { return std::to_string(test.index); });

// Two bars of steel that close on the gas between them: contact carries them.
TEST(BarsInGas, MeetAndPart) {
  CoupledDeck deck;
  deck.cells = "[50,1,1]";
  deck.upper = "[1,0.02,0.02]";
  deck.time = "0.003";
  deck.density = "7800";
  deck.bulk = "1.6e11";
  deck.shear = "8e10";
  deck.multiplier = "0.4";
  const auto bar = [](double low, double high, const char* v) {
    return solid_object(
        fmt::format("<box><min>[{},-1,-1]</min><max>[{},2,2]</max></box>", low, high), v,
        "[2,1,1]");
  };
  deck.solid = bar(0.2, 0.4, "[20,0,0]");
  deck.further = solid_of(deck, "other", bar(0.5, 0.7, "[-20,0,0]")) +
                 "<contact><type>friction_bard</type><materials>[0,1]</materials><mu>0</mu>"
                 "</contact>";
  deck.drag = "0,0,0";
  deck.heat = "0,0,0";
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  EXPECT_LT(run.worst_drift_but_energy(), 1e-12);
  EXPECT_LT(mean(run.particles("p.velocity", 0)[0]), 0);
  EXPECT_GT(mean(run.particles("p.velocity", 1)[0]), 0);
  EXPECT_GT(range(run.field("press_CC", 0)).first, 0);
}

// A disk of foam squeezed by a pulse of 32 times the pressure around it.
TEST(FoamDisk, IsSqueezedAndKeepsItsBooks) {
  CoupledDeck deck;
  deck.gas = gas_object(box_from("[-1,-1,-1]", "[0.15,2,2]"), 32e5) +
             gas_object(box_from("[0.15,-1,-1]", "[2,2,2]"), 1e5);
  deck.multiplier = "0.2";
  deck.time = "0.0006";
  deck.saves.emplace_back("p.volume");
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
  EXPECT_LT(std::fabs(run.drift("total energy")), 0.01);
  const auto [low, high] = range(run.field("press_CC", 0));
  EXPECT_GT(low, 0.05e5);
  EXPECT_LT(high, 60e5);
  double area = 0;
  const auto volumes = run.particles("p.volume");
  for (const double v : volumes[0]) area += v / 0.025;
  RecordProperty("area", fmt::format("{:.4f}", area / (M_PI * 0.15 * 0.15)));
  EXPECT_LT(area / (M_PI * 0.15 * 0.15), 0.9);  // measured .855
}

// A disk of foam thrown at a wall, through the gas before it, which contact does not know.
TEST(FoamDisk, ReboundsFromAWallThroughItsFilmOfGas) {
  CoupledDeck deck;
  deck.solid = solid_object(disk_at(0.8, 0.5, 0.15), "[60,0,0]");
  deck.time = "0.006";
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  EXPECT_LT(run.worst_drift_but_energy(), 1e-12);
  EXPECT_LT(mean(run.particles("p.velocity")[0]), 0);  // it flies back
  EXPECT_GT(range(run.field("press_CC", 0)).first, 0.5e5);
}

// A weak body whose halves fly apart: particles between them let go, and the halves move on.
CoupledDeck torn_body() {
  CoupledDeck deck;
  deck.cells = "[40,20,1]";
  deck.upper = "[1,0.5,0.025]";
  deck.time = "0.004";
  deck.bulk = "1e4";
  deck.shear = "3e3";
  deck.solid = solid_object(box_from("[0.3,0.15,-1]", "[0.5,0.35,1]"), "[-40,0,0]") +
               solid_object(box_from("[0.5,0.15,-1]", "[0.7,0.35,1]"), "[40,0,0]");
  return deck;
}

TEST(BodyTornApart, PartsAndKeepsItsBooks) {
  const CoupledRun run(torn_body());
  ASSERT_EQ(run.report().status, RunStatus::done);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
  const Json events = Json::parse(run.report().events_json);
  ASSERT_TRUE(events.contains("particle torn from its neighbours")) << events.dump();
  // The halves fly on: their ends are where they would be alone, but for the gas.
  const auto [low, high] = [&] {
    const std::vector<double> x = run.particles("p.x").front();
    const auto ends = std::minmax_element(x.begin(), x.end());
    return std::pair{*ends.first, *ends.second};
  }();
  EXPECT_NEAR(low + high, 1, 1e-6);
  EXPECT_LT(low, 0.18);
}

TEST(BodyTornApart, NeitherBoxesNorThreadsShow) {
  const CoupledRun one(torn_body()), many(torn_body(), {}, 2, {3, 2, 1});
  EXPECT_EQ(one.field("press_CC", 0).components[0], many.field("press_CC", 0).components[0]);
}

// Dense gas that bursts into thin hot gas of its neighbourhood, past a soft disk: its traces among
// small cells have energies that are none of its own law's, two cells away from the disk too.
TEST(SoftDisk, BetweenThinAndDenseGasLosesNothing) {
  CoupledDeck deck;
  deck.cells = "[30,30,1]";
  deck.upper = "[1,1,0.0333333333333333]";
  deck.multiplier = "0.2";
  deck.time = "5e-5";
  deck.density = "1000";
  deck.bulk = "1.5e7";
  deck.shear = "1e4";
  deck.solid = solid_object(disk_at(0.27, 0.5755, 0.16767), "[0,0,0]", "[3,3,1]");
  deck.specific_heat = "3000";
  deck.gas = gas_of(box_from("[-9,-9,-9]", "[0.3892,9,9]"), 0.311, 837);
  deck.further_gas =
      "<material name='dense'><EOS type='ideal_gas'/><dynamic_viscosity>0</dynamic_viscosity>"
      "<thermal_conductivity>0</thermal_conductivity><specific_heat>717.5</specific_heat>"
      "<gamma>1.2</gamma>" +
      gas_of(box_from("[0.3892,-9,-9]", "[9,9,9]"), 11.108, 608.7) + "</material>";
  deck.drag = "1e15,1e15,1e15";
  deck.heat = "1e9,1e9,1e9";
  const CoupledRun run(deck, {"MPM/interpolator=cpdi"});
  ASSERT_EQ(run.report().status, RunStatus::done);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
  EXPECT_LT(run.report().steps, 80);  // and no step was redone smaller and smaller
}

// Two viscous gases of 300 and 600 K that meet beside a disk, at one pressure with it.
TEST(DiskInTwoGases, HeatPassesTheOpenFaces) {
  CoupledDeck deck;
  deck.time = "0.002";
  deck.viscosity = "0.01";
  deck.gas = gas_of(box_from("[-9,-9,-9]", "[0.4,9,9]"), 1e5 / (287 * 300), 300);
  deck.further_gas =
      "<material name='hot'><EOS type='ideal_gas'/><dynamic_viscosity>0.01</dynamic_viscosity>"
      "<thermal_conductivity>50</thermal_conductivity><specific_heat>717.5</specific_heat>"
      "<gamma>1.2</gamma>" +
      gas_of(box_from("[0.4,-9,-9]", "[9,9,9]"), 1e5 / (143.5 * 600), 600) + "</material>";
  deck.drag = "0,0,1e15";
  deck.heat = "0,0,0";
  const std::vector<std::string> conducts = {
      "MaterialProperties/ICE/material[1]/thermal_conductivity=50"};
  const CoupledRun run(deck, conducts), all(deck, conducts, 1, {}, true);
  ASSERT_EQ(run.report().status, RunStatus::done);
  EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
  EXPECT_LT(std::fabs(run.drift("total energy")), 1e-6);
  for (const int m : {1, 2}) {
    const DenseField T = run.field("temp_CC", m);
    double least = 1e300, most = 0;  // where it is
    for (const double t : T.components[0]) {
      if (t > 0) least = std::min(least, t);
      most = std::max(most, t);
    }
    EXPECT_GT(least, 299) << m;
    EXPECT_LT(most, 601) << m;
    if (m == 1) {
      EXPECT_GT(most, 310);
    }
    EXPECT_EQ(T.components, all.field("temp_CC", m).components) << m;
  }
}

// Velocity of the disk behind a shock of Mach 1.5, on 80 cells against 320. (Where a coefficient
// binds the gas of its cells the drag falls with the cells: 3.72 and 2.99 m/s.)
TEST(FullFoamDisk, MovesAlikeOnFinerGrids) {
  double found[2];
  for (const int n : {80, 320}) {
    const CoupledRun run(
        "shock_over_foam",
        {fmt::format("Grid/Level/Box/resolution=[{0},{0},1]", n),
         fmt::format("Grid/Level/Box/upper=[1,1,{:.12g}]", 1.0 / n),
         "MaterialProperties/exchange_properties/exchange_coefficients/momentum=[0]",
         "Time/maxTime=0.0012"});
    ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
    EXPECT_LT(run.worst_drift_but_energy(), 1e-13);
    found[n / 320] = mean(run.particles("p.velocity")[0]);
    RecordProperty(fmt::format("velocity_{}", n), fmt::format("{:.5f}", found[n / 320]));
  }
  EXPECT_NEAR(found[0] / found[1], 1, 0.005);
}

// Half a turn of a rigid disk in still gas without friction: the gas stays as it is.
TEST(SpinningDisk, HardlyTurnsTheGas) {
  const TemporaryFolder folder;
  const std::filesystem::path profile = folder.path() / "turn.txt";
  std::ofstream(profile) << "0 0 0 0 0.5 0.5 0 0 0 200\n1 0 0 0 0.5 0.5 0 0 0 200\n";
  CoupledDeck deck;
  deck.solid = "<is_rigid>true</is_rigid>" + solid_object(disk_at(0.5, 0.5, 0.15), "[0,0,0]");
  deck.further = "<contact><type>specified</type><filename>" + profile.string() +
                 "</filename><include_rotation>true</include_rotation><materials>[0]</materials>"
                 "<master_material>0</master_material><direction>[1,1,1]</direction></contact>";
  deck.time = "0.0157";
  const CoupledRun run(deck);
  ASSERT_EQ(run.report().status, RunStatus::done) << run.report().message;
  const DenseField rho = run.field("rho_CC", gas), u = run.field("vel_CC", gas);
  double torque = 0;
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 40; ++i) {
      const std::size_t n = j * 40 + i;
      const double x = (i + 0.5) / 40 - 0.5, y = (j + 0.5) / 40 - 0.5;
      torque += rho.components[0][n] * (x * u.components[1][n] - y * u.components[0][n]) / 1600;
    }
  const double of_disk = 0.5 * 100 * M_PI * std::pow(0.15, 4) * 200;
  RecordProperty("torque", fmt::format("{:.3e}", torque / of_disk));
  EXPECT_LT(std::fabs(torque / of_disk), 1e-4);
  EXPECT_LT(farthest(run.field("press_CC", 0), 1e5), 2e-3 * 1e5);  // measured 1.2e-3
}

}  // namespace
}  // namespace sluice::mpmice::hard_coupled_runs_test
