// A gas that is a mixture of two between heated plates, with eddies: where one of the two is alone
// friction, and heat through the plates, are its own.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "verification/case_run.hpp"

namespace sluice::verification {
namespace {

// The deck with conditions of a scalar on its plates.
std::string deck_with_scalar(const std::filesystem::path& folder) {
  std::ifstream in(SLUICE_SOURCE_DIR "/inputs/ice/couette_heated.ups");
  std::ofstream out(folder / "plates.ups");
  for (std::string line; std::getline(in, line);) {
    if (line.find("</Face>") != std::string::npos)
      out << "<BCType id=\"0\" label=\"scalar-f\" var=\"Neumann\"><value>0.</value></BCType>\n";
    out << line << '\n';
  }
  return (folder / "plates.ups").string();
}

TEST(MixedGasWalls, PassHeatAsTheGasThatIsAlone) {
  constexpr double round_off = 1e-12;
  const std::vector<std::string> eddies = {
      "CFD/ICE/turbulence/@model=Smagorinsky", "CFD/ICE/turbulence/model_constant=0.3",
      // Slopes of a mixed gas have bounds of their own.
      "CFD/ICE/advection/@type=FirstOrder", "Time/maxTime=0.2", "Time/delt_max=2e-4"};
  const char* const coefficients[][3] = {{"1", "0.05", "0.1"}, {"3", "0.08", "0.15"}};
  const TemporaryFolder folder;
  const std::string deck = deck_with_scalar(folder.path());
  for (const int gas : {0, 1}) {
    std::vector<std::string> alone = eddies, mixed = eddies;
    const char* const tags[] = {"specific_heat", "thermal_conductivity", "dynamic_viscosity"};
    for (std::size_t n = 0; n < 3; ++n)
      alone.push_back(std::string("MaterialProperties/ICE/material/") + tags[n] + "=" +
                      coefficients[gas][n]);
    const std::string model = "Models/Model/BinaryProperties/";
    mixed.insert(mixed.end(), {"Models/Model/@type=BinaryProperties", model + "material=gas",
                               model + "scalar/@name=f"});
    for (const int of : {0, 1}) {
      const std::string name = model + "scalar/constants/", end = of == 0 ? "_A=" : "_B=";
      mixed.push_back(name + "cv" + end + coefficients[of][0]);
      mixed.push_back(name + "R" + end + (of == 0 ? "0.4" : "1.2"));
      mixed.push_back(name + "thermalCond" + end + coefficients[of][1]);
      mixed.push_back(name + "dynamic_viscosity" + end + coefficients[of][2]);
    }
    const std::string object = model + "scalar/geom_object/";
    mixed.insert(mixed.end(),
                 {object + "box/@label=everywhere", object + "box/min=[-9,-9,-9]",
                  object + "box/max=[9,9,9]", object + "scalar=" + std::to_string(gas)});
    const CaseRun one("couette_heated", alone), two(deck, mixed);
    ASSERT_EQ(one.steps(), two.steps());
    for (const char* variable : {"temp_CC", "vel_CC"}) {
      const CellValues a = one.field(variable), b = two.field(variable);
      double worst = 0;
      for (std::size_t n = 0; n < a.values.size(); ++n)
        worst = std::fmax(worst, std::fabs(a.values[n] - b.values[n]));
      record(std::string(variable) + "_" + std::to_string(gas), worst);
      EXPECT_LE(worst, round_off) << variable << " of gas " << gas;
      EXPECT_GT(highest(a) - lowest(a), .1);
    }
  }
}

}  // namespace
}  // namespace sluice::verification
