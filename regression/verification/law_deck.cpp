// A tube of one material as deck text.
#include "verification/law_deck.hpp"

#include <fmt/format.h>

#include <fstream>

#include "framework/base/error.hpp"
#include "framework/deck/deck.hpp"
#include "ice/deck/read_fluid.hpp"

namespace sluice::verification {
namespace {

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
                                     bool periodic) {
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
    </Box><periodic>[{4},1,1]</periodic></Level></Grid>
  <DataArchiver><filebase>law.uda</filebase><outputInterval>{1}</outputInterval>
    <outputInitTimestep/><outputLastTimestep>true</outputLastTimestep>
    <save label="rho_CC"/><save label="press_CC"/><save label="vel_CC"/><save label="temp_CC"/>
  </DataArchiver>
  <CFD><cfl>0.4</cfl><ICE><advection type="SecondOrder"/></ICE></CFD>
  <PhysicalConstants><gravity>[0,0,0]</gravity><reference_pressure>101325</reference_pressure>
  </PhysicalConstants>
  <MaterialProperties><ICE><material name="body">{5}{6}{7}</material></ICE></MaterialProperties>
</Uintah_specification>
)",
      law.name, end_time, ends, periodic ? 0 : 1, periodic ? 1 : 0, material(law),
      half("-9", "0", speed_left, law), half("0", "9", speed_right, law));
  const std::filesystem::path file = folder / (std::string(law.name) + ".ups");
  std::ofstream(file) << text;
  return file;
}

}  // namespace sluice::verification
