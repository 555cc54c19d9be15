// A gas that is a mixture of two between heated plates, with eddies: where one of the two is alone
// friction, and heat through the plates, are its own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "sluice_source_dir.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::mixed_gas_walls_test {
namespace {

// A gas by its <specific_heat>, <thermal_conductivity>, <dynamic_viscosity>; gas constant .4 c_v.
using Gas = std::array<double, 3>;
constexpr const char* tags[] = {"specific_heat", "thermal_conductivity", "dynamic_viscosity"};
constexpr const char* names[] = {"cv", "thermalCond", "dynamic_viscosity"};

struct Plates {
  const char* deck;
  std::array<Gas, 2> gases;
  std::vector<std::string> changes;
  const char* extremes;  // a variable that must differ between the plates, by .1
};

// The deck with conditions of a scalar on its plates.
std::string deck_with_scalar(const std::string& name, const std::filesystem::path& folder) {
  std::ifstream in(SLUICE_SOURCE_DIR "/inputs/ice/" + name + ".ups");
  std::ofstream out(folder / "plates.ups");
  for (std::string line; std::getline(in, line);) {
    if (line.find("</Face>") != std::string::npos)
      out << "<BCType id=\"0\" label=\"scalar-f\" var=\"Neumann\"><value>0.</value></BCType>\n";
    out << line << '\n';
  }
  return (folder / "plates.ups").string();
}

CaseRun run_alone(const Plates& plates, const Gas& gas) {
  std::vector<std::string> changes = plates.changes;
  for (std::size_t n = 0; n < gas.size(); ++n)
    changes.push_back(fmt::format("MaterialProperties/ICE/material/{}={:.17g}", tags[n], gas[n]));
  return CaseRun(plates.deck, changes);
}

CaseRun run_mixed(const Plates& plates, double fraction) {
  const TemporaryFolder folder;
  std::vector<std::string> changes = plates.changes;
  const std::string model = "Models/Model/BinaryProperties/";
  changes.insert(changes.end(), {"Models/Model/@type=BinaryProperties", model + "material=gas",
                                 model + "scalar/@name=f"});
  for (const std::size_t of : {0, 1}) {
    const Gas& gas = plates.gases[of];
    const auto add = [&](const char* name, double value) {
      changes.push_back(
          fmt::format("{}scalar/constants/{}_{}={:.17g}", model, name, of == 0 ? 'A' : 'B', value));
    };
    for (std::size_t n = 0; n < gas.size(); ++n) add(names[n], gas[n]);
    add("R", .4 * gas[0]);
  }
  const std::string object = model + "scalar/geom_object/";
  changes.insert(changes.end(),
                 {object + "box/@label=everywhere", object + "box/min=[-9,-9,-9]",
                  object + "box/max=[9,9,9]", fmt::format("{}scalar={}", object, fraction)});
  return CaseRun(deck_with_scalar(plates.deck, folder.path()), changes);
}

void expect_same(const Plates& plates, const Gas& gas, double fraction) {
  constexpr double round_off = 1e-13;  // measured 1.8e-15
  SCOPED_TRACE(fmt::format("{}, f {}", plates.deck, fraction));
  const CaseRun one = run_alone(plates, gas), two = run_mixed(plates, fraction);
  ASSERT_EQ(one.steps(), two.steps());
  for (const char* variable : {"temp_CC", "vel_CC"}) {
    const double worst = farthest_from(two.field(variable), one.field(variable));
    record(fmt::format("{}: {} where f is {}", plates.deck, variable, fraction), worst);
    EXPECT_LE(worst, round_off) << variable;
  }
  const CellValues shown = one.field(plates.extremes);
  EXPECT_GT(highest(shown) - lowest(shown), .1);
}

// Slopes of a mixed gas have bounds of their own.
const std::string first_order = "CFD/ICE/advection/@type=FirstOrder";

TEST(MixedGasWalls, PassHeatAsTheGasThatIsAlone) {
  const Plates eddies = {
      "couette_heated",
      {Gas{1, .05, .1}, Gas{3, .08, .15}},
      {"CFD/ICE/turbulence/@model=Smagorinsky", "CFD/ICE/turbulence/model_constant=0.3",
       first_order, "Time/maxTime=0.2", "Time/delt_max=2e-4"},
      "temp_CC"};
  expect_same(eddies, eddies.gases[0], 0);
  expect_same(eddies, eddies.gases[1], 1);
}

// Slip of second order with creep, and the jump of the temperature: of either gas alone, and of a
// mixture that is a gas half way between. slip_flow_test.cpp holds them against exact profiles.
TEST(MixedGasWalls, LetTheGasSlipAsOneThatIsAlone) {
  const Plates slip = {"slip_heat",
                       {Gas{1, .14, .1}, Gas{3, .2, .06}},
                       {"Grid/BoundaryConditions/microSlip/CreepFlow=true", first_order,
                        "Time/maxTime=0.5", "Time/delt_max=1e-3"},
                       "vel_CC"};
  expect_same(slip, slip.gases[0], 0);
  expect_same(slip, slip.gases[1], 1);
  expect_same(slip, {2, .17, .08}, .5);
}

}  // namespace
}  // namespace sluice::verification::mixed_gas_walls_test
