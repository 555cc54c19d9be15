// Materials that move together in equilibrium stay in it, on one level and across faces where
// levels meet; a shock over a bubble.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/archive/archive.hpp"
#include "verification/amr_case.hpp"

namespace sluice::verification::mixture_flow_test {
namespace {

constexpr double allowed = 1e-10;        // relative
constexpr double allowed_drift = 1e-13;  // of sum |q|, per 1,000 steps

double drift_per_thousand(const CaseRun& run) {
  const double drift = run.worst_drift() / std::max(1., run.steps() / 1000.);
  record("drift", drift);
  return drift;
}

// Largest relative distance of a variable of a material from `wanted` where that material is, on
// any level.
double unevenness(const CaseRun& run, const std::string& variable, int component, double wanted,
                  int material) {
  const Archive opened = Archive::open(run.archive());
  const ArchiveStep step = opened.read_output(opened.select_output("last"));
  double worst = 0;
  long cells = 0;
  for (std::size_t l = 0; l < step.grid().levels.size(); ++l) {
    const FieldInfo* field = step.find(variable, material, static_cast<int>(l));
    const FieldInfo* share = step.find("vol_frac_CC", material, static_cast<int>(l));
    if (field == nullptr || share == nullptr)
      throw std::runtime_error("the archive holds no " + variable);
    for (const GridBox& box : step.grid().levels[l].boxes) {
      const DenseField values = step.read(*field, box.cells), shares = step.read(*share, box.cells);
      for_each_cell(box.cells, [&](IntVec3 c) {
        if (!(shares.at(c, 0) > 0)) return;
        ++cells;
        const double distance = std::fabs(values.at(c, component) / wanted - 1);
        if (!(distance <= worst)) worst = distance;  // a NaN stays
      });
    }
  }
  EXPECT_GT(cells, 0) << variable << " of material " << material;
  return worst;
}

struct Equilibrium {
  double pressure, temperature;
  Vec3 velocity;
  int materials;
};

// `most`: distances of pressure, velocity and temperature, as shares.
void expect_uniform(const CaseRun& run, const Equilibrium& e, Vec3 most = Vec3::all(allowed)) {
  const double p = farthest_on_levels(run, "press_CC", 0, e.pressure) / e.pressure;
  record("pressure", p);
  EXPECT_LE(p, most[0]);
  double u = 0, T = 0;
  for (int m = 0; m < e.materials; ++m) {
    for (const int d : {0, 1})
      if (e.velocity[d] != 0) u = std::fmax(u, unevenness(run, "vel_CC", d, e.velocity[d], m));
    T = std::fmax(T, unevenness(run, "temp_CC", 0, e.temperature, m));
  }
  record("velocity", u);
  record("temperature", T);
  EXPECT_LE(u, most[1]);
  EXPECT_LE(T, most[2]);
}

TEST(MixtureFlow, ThreeMaterialsInARowStayInEquilibrium) {
  const CaseRun run("three_in_a_row");
  expect_uniform(run, {101325, 300, {100, 0, 0}, 3});
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
  EXPECT_EQ(run.events(), 0);
  // Each is where it was, once round: its edges are no wider than four cells.
  for (int m = 0; m < 3; ++m) {
    const CellValues share = run.field("vol_frac_CC", 0, "last", m);
    const auto mixed = std::count_if(share.values.begin(), share.values.end(),
                                     [](double v) { return v > .01 && v < .99; });
    record("mixed_" + std::to_string(m), static_cast<double>(mixed));
    EXPECT_LE(mixed, 8);
  }
}

// A finer level follows the edge of the water.
struct Levels {
  const char* name;
  std::vector<std::string> overrides;
};
void expect_untouched(const CaseRun& run, Vec3 most = Vec3::all(allowed)) {
  expect_uniform(run, {101325, 300, {100, -40, 0}, 2}, most);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
  ASSERT_GE(max_cells(run).size(), 2u);
  EXPECT_GT(max_cells(run)[1], 0);
  // A cell that holds a trace may be unable to give what passed the finer face: the fine cells then
  // bear the difference. Nothing else may happen, and that rarely. Measured: once in 1,381 steps.
  const auto& events = run.record().at("events");
  const bool limited = events.contains("correction of fluxes limited");
  EXPECT_EQ(events.size(), limited ? 1u : 0u) << events.dump();
  EXPECT_LE(run.events(), run.steps() / 500) << events.dump();
}

std::string drag(const char* coefficient) {
  return std::string("MaterialProperties/exchange_properties/exchange_coefficients/momentum=[") +
         coefficient + "]";
}
const std::string by_four = "AMR/Regridder/cell_refinement_ratio=[[4,4,1]]";
const std::string tiles_for_four = "AMR/Regridder/min_patch_size=[[8,8,1]]";
const std::string three_levels = "AMR/Regridder/max_levels=3";

// Another material in the place of the water, at its pressure and temperature.
std::vector<std::string> square_of(const char* law, const std::vector<std::string>& numbers) {
  const std::string material = "MaterialProperties/ICE/material[1]/";
  std::vector<std::string> all = {material + "EOS/pinf=", material + "EOS/q=",
                                  material + "EOS/@type=" + law, resolution(16, 16)};
  for (const std::string& number : numbers) all.push_back(material + number);
  return all;
}
const std::vector<std::string> solid =
    square_of("Murnaghan", {"EOS/n=7.4", "EOS/K=39e-11", "EOS/rho0=1160", "EOS/P0=101325",
                            "geom_object/density=1160", "specific_heat=1400"});
// p = (gamma - 1) rho cv T/(1 - b rho), with 28 kg/m3
const std::vector<std::string> hard_spheres = square_of(
    "hard_sphere_gas", {"EOS/b=1e-2", "gamma=1.3", "geom_object/density=28",
                        fmt::format("specific_heat={:.17g}", 101325 * .72 / (.3 * 28 * 300))});
const std::vector<std::string> helium = square_of(
    "ideal_gas", {"gamma=1.667", "specific_heat=3116",
                  fmt::format("geom_object/density={:.17g}", 101325 / (.667 * 3116 * 300))});
// The specific heat of air at any temperature.
const std::vector<std::string> air_by_nasa =
    square_of("ideal_gas", {"SpecificHeatModel/@type=airNasa", "gamma=1.4", "specific_heat=717.5",
                            "geom_object/density=1.176829268292683"});

class WaterSquare : public testing::TestWithParam<Levels> {};

TEST_P(WaterSquare, LeavesNoTraceInPressureVelocityAndTemperature) {
  const CaseRun run("amr_water_square", GetParam().overrides);
  expect_untouched(run);
  EXPECT_GT(regrids(run), 0);
}

const std::string coarse = resolution(12, 12);
INSTANTIATE_TEST_SUITE_P(
    On, WaterSquare,
    testing::Values(Levels{"Coarse", {coarse}},
                    Levels{"CoarseLockstep", {coarse, "AMR/useLockStep=true"}},
                    Levels{"CoarseCopiedCells", {coarse, "AMR/ICE/orderOfInterpolation=0"}},
                    Levels{"CoarseFree", {coarse, drag("0")}}, Levels{"OfASolid", solid},
                    Levels{"OfHardSpheres", hard_spheres}, Levels{"OfHelium", helium},
                    Levels{"OfAirByNasa", air_by_nasa}),
    [](const auto& test) { return std::string(test.param.name); });
INSTANTIATE_TEST_SUITE_P(
    Full, WaterSquare,
    testing::Values(Levels{"Ratio2", {}}, Levels{"Lockstep", {"AMR/useLockStep=true"}},
                    Levels{"Ratio4", {resolution(16, 16), by_four, tiles_for_four}},
                    Levels{"ThreeLevels", {resolution(16, 16), three_levels}},
                    Levels{"CopiedCells", {"AMR/ICE/orderOfInterpolation=0"}},
                    Levels{"Free", {drag("0")}},
                    Levels{"FreeByFour", {drag("0"), resolution(16, 16), by_four, tiles_for_four}},
                    Levels{"FreeOnThreeLevels", {drag("0"), resolution(16, 16), three_levels}},
                    Levels{"DraggedInLockstep", {drag("1e6"), "AMR/useLockStep=true"}}),
    [](const auto& test) { return std::string(test.param.name); });

void expect_a_drop_to_leave_no_trace(const std::vector<std::string>& overrides) {
  const CaseRun run("amr_followed_drop", overrides);
  expect_untouched(run);
  EXPECT_GT(regrids(run), 0);
}
TEST(MixtureFlow, LevelsThatGoWithTheSurfaceOfADropLeaveNoTrace) {
  expect_a_drop_to_leave_no_trace({"Time/maxTime=0.0005"});
}
TEST(FullMixtureFlow, LevelsThatGoWithTheSurfaceOfADropLeaveNoTrace) {
  expect_a_drop_to_leave_no_trace({});
}

TEST(FullMixtureFlow, EdgesCrossFacesOfAFixedRegion) {
  expect_untouched(CaseRun("amr_water_through_region"));
}
TEST(FullMixtureFlow, EdgesOfFreeWaterCrossFacesOfAFixedRegion) {
  expect_untouched(CaseRun("amr_water_through_region", {drag("0")}));
}

// Drops that fly through a gas at rest, a shock that overtakes them, a cylinder of water in their
// way; each material has a velocity of its own.
struct Flight {
  Levels levels;
  const char* K;
};
class Drops : public testing::TestWithParam<Flight> {};

TEST_P(Drops, KeepMassesMomentumAndEnergy) {
  std::vector<std::string> overrides = GetParam().levels.overrides;
  overrides.push_back(drag(GetParam().K));
  const CaseRun run("amr_drops", overrides);
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
  EXPECT_LE(run.events(), 1) << run.record().at("events").dump();
  // The water bears tension: its pressure may be negative, its temperature may not.
  for (const LevelCell& cell : level_cells(run, "temp_CC")) ASSERT_GE(cell.value, 0);
}

// Each way of levels with one coefficient of drag, and with the others.
std::vector<Flight> flights(bool others) {
  const Levels ways[] = {{"OneLevel", {one_level()}},
                         {"Ratio2", {}},
                         {"Lockstep", {"AMR/useLockStep=true"}},
                         {"Ratio4", {resolution(16, 16), by_four, tiles_for_four}},
                         {"ThreeLevels", {resolution(16, 16), three_levels}}};
  const char* const K[] = {"100", "0", "1e6"};
  std::vector<Flight> all;
  for (std::size_t way = 0; way < std::size(ways); ++way)
    for (std::size_t n = 0; n < std::size(K); ++n)
      if ((n == way % std::size(K)) != others) all.push_back({ways[way], K[n]});
  return all;
}
const auto name_of_flight = [](const auto& test) {
  return std::string(test.param.levels.name) + "_" + test.param.K;
};
// The first quarter of each flight, and all of it.
std::vector<Flight> begun(std::vector<Flight> all) {
  for (Flight& f : all) f.levels.overrides.push_back("Time/maxTime=1e-3");
  return all;
}
INSTANTIATE_TEST_SUITE_P(Begun, Drops, testing::ValuesIn(begun(flights(false))), name_of_flight);
INSTANTIATE_TEST_SUITE_P(Full, Drops, testing::ValuesIn(flights(false)), name_of_flight);
INSTANTIATE_TEST_SUITE_P(FullOthers, Drops, testing::ValuesIn(flights(true)), name_of_flight);

TEST(MixtureFlow, ShockOverAWaterCylinderConserves) {
  const CaseRun run("amr_water_cylinder");
  EXPECT_LE(drift_per_thousand(run), allowed_drift);
  EXPECT_GT(regrids(run), 0);
}

// The air is a mixture with helium, in stripes of two fractions at one pressure and temperature,
// whose edges cross those of the fine level. Measured: pressure to 1.5e-6, velocity 7.9e-5,
// temperature 3.1e-5 with substeps, in lockstep 1.8e-8, 7.1e-8, 1.4e-6 as on one level: between
// steps of the coarse level density and fraction are interpolated, not their product.
class WaterAmongHelium : public testing::TestWithParam<Levels> {};

TEST_P(WaterAmongHelium, LeavesNoTraceInPressureVelocityAndTemperature) {
  const std::string model = "Models/Model/BinaryProperties/", scalar = model + "scalar/";
  const std::string object = scalar + "geom_object/", constants = scalar + "constants/";
  std::vector<std::string> changes = GetParam().overrides;
  changes.insert(changes.end(),
                 {"Models/Model/@type=BinaryProperties", model + "material=air", scalar + "@name=f",
                  constants + "cv_A=717.5", constants + "cv_B=3116", constants + "R_A=287",
                  constants + "R_B=2077", constants + "rho_A=1.176829268292683",
                  constants + fmt::format("rho_B={:.17g}", 1.176829268292683 * 287 / 2077),
                  object + "box/@label=helium", object + "box/min=[0.2,-9,-9]",
                  object + "box/max=[0.6,9,9]", object + "scalar=0.7"});
  expect_untouched(CaseRun("amr_water_square", changes), {5e-6, 2e-4, 1e-4});
}

INSTANTIATE_TEST_SUITE_P(On, WaterAmongHelium,
                         testing::Values(Levels{"Coarse", {resolution(16, 16)}},
                                         Levels{"CoarseLockstep",
                                                {resolution(16, 16), "AMR/useLockStep=true"}}),
                         [](const auto& test) { return std::string(test.param.name); });
INSTANTIATE_TEST_SUITE_P(
    Full, WaterAmongHelium,
    testing::Values(Levels{"Ratio2", {}}, Levels{"Lockstep", {"AMR/useLockStep=true"}},
                    Levels{"Ratio4", {resolution(16, 16), by_four, tiles_for_four}},
                    Levels{"ThreeLevels", {resolution(16, 16), three_levels}}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace sluice::verification::mixture_flow_test
