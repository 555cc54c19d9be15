// Decks of one particle: the example decks, and what is told of bad ones.
#include "mpm/material/material_driver.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "framework/base/temporary_folder.hpp"
#include "mpm/material/test_support/law_test_support.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::mpm::material_driver {
namespace {

const std::string folder = SLUICE_SOURCE_DIR "/inputs/mpm/drive/";

std::size_t column(const DriverTable& table, const std::string& name) {
  const auto at = std::find(table.columns.begin(), table.columns.end(), name);
  EXPECT_NE(at, table.columns.end()) << name;
  return at - table.columns.begin();
}

DriverTable driven(const std::string& file, const std::vector<std::string>& overrides = {}) {
  std::vector<Fault> faults;
  const auto deck = read_driver_deck(file, overrides, faults);
  EXPECT_TRUE(deck) << told(faults);
  return deck ? drive(*deck) : DriverTable{};
}

TEST(MaterialDriver, RubberComesBack) {
  const DriverTable table = driven(folder + "rubber_cycle.ups");
  ASSERT_EQ(table.rows.size(), 201u);
  const std::size_t stress = column(table, "stress_xx"), energy = column(table, "energy");
  EXPECT_GT(table.rows[100][stress], 1e5);
  EXPECT_NEAR(table.rows[200][stress], 0, 1e-6);
  EXPECT_NEAR(table.rows[200][energy], 0, 1e-6);
  EXPECT_NEAR(table.rows[150][energy], table.rows[50][energy], 1e-9 * table.rows[50][energy]);
}

TEST(MaterialDriver, CopperHardensWarmsAndTurns) {
  const DriverTable table = driven(folder + "copper_shear.ups");
  ASSERT_EQ(table.rows.size(), 1021u);
  const std::vector<double>&sheared = table.rows[1000], &turned = table.rows[1020];
  const std::size_t equivalent = column(table, "equivalent_stress");
  // Johnson and Cook at the strain and temperature reached, at 1e4/3^(1/2) a second.
  const double strain = sheared[column(table, "p.plasticStrain")];
  const double T = sheared[column(table, "temperature")];
  const double flow = (90e6 + 292e6 * std::pow(strain, 0.31)) *
                      (1 + 0.025 * std::log(1e4 / std::sqrt(3.0))) *
                      (1 - std::pow((T - 298) / (1356 - 298), 1.09));
  EXPECT_NEAR(sheared[equivalent] / flow, 1, 1e-3);
  EXPECT_NEAR(strain, 1 / std::sqrt(3.0), 0.01);
  EXPECT_NEAR((T - 298) * 8960 * 383 / (0.9 * sheared[column(table, "energy")]), 1, 0.02);
  // By 90 degrees about z: xx and yy change places.
  EXPECT_NEAR(turned[column(table, "stress_xx")], sheared[column(table, "stress_yy")], 1e6);
  EXPECT_NEAR(turned[column(table, "energy")] / sheared[column(table, "energy")], 1, 1e-4);
}

TEST(MaterialDriver, ValuesCanBeSet) {
  const DriverTable table =
      driven(folder + "rubber_cycle.ups",
             {"MaterialDriver/material/constitutive_model/he_constant_1=2e5",
              "MaterialDriver/material/constitutive_model/he_constant_2=4e4"});
  const DriverTable plain = driven(folder + "rubber_cycle.ups");
  const std::size_t stress = column(table, "stress_xx");
  EXPECT_NEAR(table.rows[50][stress] / plain.rows[50][stress], 2, 1e-12);
}

TEST(MaterialDriver, BadDecksAreTold) {
  const TemporaryFolder temporary;
  const std::string file = (temporary / "bad.ups").string();
  const auto told_of = [&](const std::string& inside) {
    std::ofstream(file) << "<Uintah_specification><MaterialDriver><material>\n"
                           "<density>1</density>\n"
                           "<constitutive_model type=\"comp_neo_hook\">"
                           "<bulk_modulus>1</bulk_modulus><shear_modulus>1</shear_modulus>"
                           "</constitutive_model></material>\n"
                        << inside << "</MaterialDriver></Uintah_specification>\n";
    std::vector<Fault> faults;
    EXPECT_FALSE(read_driver_deck(file, {}, faults));
    return told(faults);
  };
  using testing::HasSubstr;
  EXPECT_THAT(told_of(""), HasSubstr("needs <piece>"));
  EXPECT_THAT(told_of("<piece><duration>1</duration><velocity_gradient>[1,2]</velocity_gradient>"
                      "</piece>"),
              HasSubstr("2 numbers, expected nine"));
  EXPECT_THAT(told_of("<piece><duration>1</duration>"
                      "<deformation>[-1,0,0,0,1,0,0,0,1]</deformation></piece>"),
              HasSubstr("det F = -1"));
  EXPECT_THAT(told_of("<piece><duratoin>1</duratoin></piece>"),
              HasSubstr("did you mean 'duration'?"));
}

}  // namespace
}  // namespace sluice::mpm::material_driver
