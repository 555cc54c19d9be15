// The settings that the studies prove: chosen by what a deck has, and the study says so.
#include "app/plan/best_settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "sluice_source_dir.hpp"

namespace sluice::best_settings_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string inputs = SLUICE_SOURCE_DIR "/inputs/";

TEST(BestSettings, OneWholeBodyIsTotalLagrangian) {
  const BestSettings best = best_settings(inputs + "mpm/axis_aligned.ups", {});
  EXPECT_THAT(best.overrides, ElementsAre("MPM/interpolator=gimp", "MPM/total_lagrangian=true"));
  ASSERT_EQ(best.reasons.size(), 1u);
  EXPECT_THAT(best.reasons[0], HasSubstr("study axis_aligned"));
}

TEST(BestSettings, BodiesThatMayTouchGetCornersAndOneParticle) {
  const BestSettings best = best_settings(inputs + "mpm/colliding_disks.ups", {});
  ASSERT_FALSE(best.overrides.empty());
  EXPECT_EQ(best.overrides[0], "MPM/interpolator=cpdi");
  EXPECT_THAT(best.overrides[1], HasSubstr("geom_object[1]/res=[1,1,1]"));
}

TEST(BestSettings, WhereTheBasisHasNoEffectItIsSaid) {
  const BestSettings coupled = best_settings(inputs + "mpmice/shock_on_wall.ups", {});
  EXPECT_TRUE(coupled.overrides.empty());
  EXPECT_THAT(coupled.reasons[0], HasSubstr("<interpolator> has no effect"));
  EXPECT_THAT(best_settings(inputs + "ice/riemann_sod.ups", {}).reasons[0], HasSubstr("no solids"));
}

// The figures that users read are those of the table.
TEST(BestSettings, TheGainIsThatOfTheStudy) {
  std::ifstream csv(SLUICE_SOURCE_DIR "/docs/accuracy/axis_aligned.csv");
  std::map<std::string, double> finest;  // error at 128 cells
  for (std::string line; std::getline(csv, line);) {
    const auto quote = line.rfind('"');
    if (quote == std::string::npos) continue;
    std::istringstream cells(line.substr(quote + 2));
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (row.at(2) == "128") finest[line.substr(1, quote - 1)] = std::stod(row.at(6));
  }
  const double usual = finest.at("basis GIMP, particles 2 x 2");
  const double corners = finest.at("basis CPDI, particles 1");
  const double total = finest.at("basis total Lagrangian GIMP, particles 2 x 2");
  EXPECT_NEAR(corners / usual / corner_basis_gain.error, 1, .3);
  EXPECT_NEAR(total / usual / total_lagrangian_gain.error, 1, .3);
}

}  // namespace
}  // namespace sluice::best_settings_test
