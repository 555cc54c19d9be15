// A tube of one material as deck text.
#include "verification/law_deck.hpp"

#include <fmt/format.h>

#include <fstream>

#include "framework/base/error.hpp"
#include "framework/deck/deck.hpp"
#include "ice/deck/read_fluid.hpp"

namespace sluice::verification {
namespace {

#define JWL_TNT \
  "<A>371.2e9</A><B>3.231e9</B><R1>4.15</R1><R2>0.95</R2><om>0.3</om><rho0>1630</rho0>"

constexpr LawCase cases[] = {
    {"ideal_gas", R"(<EOS type="ideal_gas"/>)", 1.4, 717.5, 1.2, 300, 400},
    {"StiffenedGas", R"(<EOS type="StiffenedGas"><pinf>6e8</pinf></EOS>)", 4.4, 300, 1000, 600,
     300},
    {"hard_sphere_gas", R"(<EOS type="hard_sphere_gas"><b>1e-3</b></EOS>)", 1.3, 1100, 100, 2000,
     600},
    {"TST", R"(<EOS type="TST"><a>300</a><b>1e-3</b><u>-0.5</u><w>3</w><Gamma>1.4</Gamma></EOS>)",
     1.4, 1500, 50, 600, 300},
    {"JWL", R"(<EOS type="JWL">)" JWL_TNT "</EOS>", 1.3, 1000, 1630, 3000, 500},
    {"JWLC", R"(<EOS type="JWLC">)" JWL_TNT "<C>1.045e9</C></EOS>", 1.3, 1000, 1630, 3000, 500},
    {"Murnaghan",
     R"(<EOS type="Murnaghan"><n>7.4</n><K>39e-11</K><rho0>1160</rho0><P0>101325</P0></EOS>)", 1.4,
     1400, 1200, 300, 100},
    {"BirchMurnaghan",
     R"(<EOS type="BirchMurnaghan"><n>5</n><K>7e-11</K><rho0>2000</rho0><P0>101325</P0></EOS>)",
     1.4, 900, 2050, 300, 200},
    {"MieGruneisen",
     R"(<EOS type="MieGruneisen"><C0>3940</C0><S>1.489</S><Gamma0>2.02</Gamma0><rho0>8930</rho0>)"
     "<T0>294</T0></EOS>",
     1, 385, 8940, 294, 500},
    {"Gruneisen",
     R"(<EOS type="Gruneisen"><A>1.3338e9</A><B>7.027e5</B><rho0>1823.3</rho0><T0>317.4</T0>)"
     "<P0>101325</P0></EOS>",
     1, 820.7, 1823.3, 320, 50},
    {"Tillotson",
     R"(<EOS type="Tillotson"><a>0.5</a><b>1.63</b><A>75.2e9</A><B>65e9</B><E0>5e6</E0>)"
     "<Es>3e6</Es><Esp>13.9e6</Esp><alpha>5</alpha><beta>5</beta><rho0>2700</rho0></EOS>",
     1, 900, 2710, 300, 1000},
    {"Thomsen_Hartka_water",
     R"(<EOS type="Thomsen_Hartka_water"><a>2e-7</a><b>2.6</b><co>4205.7</co><ko>5e-10</ko>)"
     "<To>277</To><L>8e-6</L><vo>1.00008e-3</vo></EOS>",
     1, 4205, 1010, 300, 20},
    {"KnaussSeaWater", R"(<EOS type="KnaussSeaWater"/>)", 1, 3990, 1030, 290, 20},
    {"NobleAbelStiffenedGas",
     R"(<EOS type="NobleAbelStiffenedGas"><pinf>7028e5</pinf><b>6.61e-4</b><q>-1177788</q></EOS>)",
     1.19, 3610, 1000, 400, 100},
    {"airNasa", R"(<EOS type="ideal_gas"/><SpecificHeatModel type="airNasa"/>)", 1.4, 717.5, 1.2,
     300, 1500},
    {"Component",
     R"(<EOS type="ideal_gas"/><SpecificHeatModel type="Component"><XCO2>0.2</XCO2>)"
     "<XH2O>0.3</XH2O><XN2>0.5</XN2></SpecificHeatModel>",
     1.25, 1184, 5, 2000, 1000},
    {"Polynomial",
     R"(<EOS type="ideal_gas"/><SpecificHeatModel type="Polynomial"><MaxOrder>7</MaxOrder>)"
     "<coefficient>[-8.330700e14, 1.811170e14, -1.426913e13, 5.305770e11, -9.958630e9, 9.237480e7, "
     "-3.85805e5, 1476.8]</coefficient><Tmin>250</Tmin></SpecificHeatModel>",
     1.3, 1200, 5, 2000, 1000},
    {"Debye",
     R"(<EOS type="StiffenedGas"><pinf>2e10</pinf></EOS><SpecificHeatModel type="Debye">)"
     "<Atoms>9.48e24</Atoms><DebyeTemperature>343</DebyeTemperature></SpecificHeatModel>",
     3, 385, 8900, 500, 300},
};

std::string material(const LawCase& law) {
  return fmt::format(
      "{}<dynamic_viscosity>0</dynamic_viscosity><thermal_conductivity>0</thermal_conductivity>"
      "<specific_heat>{}</specific_heat><gamma>{}</gamma>",
      law.eos, law.specific_heat, law.gamma);
}

std::string half(const char* low, const char* high, double speed, const LawCase& law) {
  return fmt::format(
      "<geom_object><box><min>[{},-1,-1]</min><max>[{},1,1]</max></box>"
      "<velocity>[{},0,0]</velocity><density>{}</density><temperature>{}</temperature>"
      "</geom_object>",
      low, high, speed, law.density, law.temperature);
}

std::string open_end(const char* side) {
  std::string text = fmt::format("<Face side=\"{}\">", side);
  for (const char* label : {"Pressure", "Density", "Temperature", "Velocity"})
    text += fmt::format("<BCType id=\"0\" label=\"{}\" var=\"Neumann\"><value>{}</value></BCType>",
                        label, label[0] == 'V' ? "[0,0,0]" : "0");
  return text + "</Face>";
}

}  // namespace

std::span<const LawCase> law_cases() {
  return cases;
}

ice::Fluid fluid_of(const LawCase& law) {
  const Deck deck = read_deck_text(
      "<Uintah_specification><material>" + material(law) + "</material></Uintah_specification>",
      law.name);
  const DeckNode* node = deck.root != nullptr ? deck.root->child("material") : nullptr;
  const auto fluid = node != nullptr ? ice::readable_fluid(*node) : std::nullopt;
  if (!fluid) throw InputError(std::string("no fluid in the deck of ") + law.name);
  return *fluid;
}

std::filesystem::path write_law_deck(const std::filesystem::path& folder, const LawCase& law,
                                     double speed_left, double speed_right, double end_time,
                                     bool periodic, const std::string& finer) {
  const std::string ends =
      periodic ? std::string{}
               : "<BoundaryConditions>" + open_end("x-") + open_end("x+") + "</BoundaryConditions>";
  const std::string text = fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<Uintah_specification>
  <Meta><title>{0}</title></Meta>
  <SimulationComponent type="ice"/>
  <Time><maxTime>{1}</maxTime><initTime>0</initTime><delt_min>0</delt_min><delt_max>1</delt_max>
    <timestep_multiplier>1</timestep_multiplier>
    <end_at_max_time_exactly>true</end_at_max_time_exactly></Time>
  <Grid>{2}<Level><Box label="domain"><lower>[-0.5,0,0]</lower><upper>[0.5,0.01,0.01]</upper>
    <extraCells>[{3},0,0]</extraCells><patches>[1,1,1]</patches><resolution>[200,1,1]</resolution>
    </Box><periodic>[{4},1,1]</periodic></Level>{8}</Grid>
  <DataArchiver><filebase>law.uda</filebase><outputInterval>{1}</outputInterval>
    <outputInitTimestep/><outputLastTimestep>true</outputLastTimestep>
    <save label="rho_CC"/><save label="press_CC"/><save label="vel_CC"/><save label="temp_CC"/>
    <save label="gamma"/><save label="specific_heat"/><save label="speedSound_CC"/>
  </DataArchiver>
  <CFD><cfl>0.4</cfl><ICE><advection type="SecondOrder"/></ICE></CFD>
  <PhysicalConstants><gravity>[0,0,0]</gravity><reference_pressure>101325</reference_pressure>
  </PhysicalConstants>
  <MaterialProperties><ICE><material name="body">{5}{6}{7}</material></ICE></MaterialProperties>
</Uintah_specification>
)",
      law.name, end_time, ends, periodic ? 0 : 1, periodic ? 1 : 0, material(law),
      half("-9", "0", speed_left, law), half("0", "9", speed_right, law), finer);
  const std::filesystem::path file = folder / (std::string(law.name) + ".ups");
  std::ofstream(file) << text;
  return file;
}

}  // namespace sluice::verification
