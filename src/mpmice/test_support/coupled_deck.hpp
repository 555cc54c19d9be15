// A deck of fluid and solids of a few parts.
#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

namespace sluice::mpmice {

// An object of particles, or of gas.
inline std::string solid_object(const std::string& shape, const std::string& velocity,
                                const std::string& res = "[2,2,1]") {
  return fmt::format(
      "<geom_object>{}<res>{}</res><velocity>{}</velocity><temperature>300</temperature>"
      "</geom_object>",
      shape, res, velocity);
}
inline std::string gas_object(const std::string& shape, double pressure,
                              const std::string& velocity = "[0,0,0]") {
  return fmt::format(
      "<geom_object>{}<res>[1,1,1]</res><velocity>{}</velocity><temperature>300</temperature>"
      "<density>{:.17g}</density><pressure>{:.17g}</pressure></geom_object>",
      shape, velocity, pressure / (287 * 300), pressure);
}
inline std::string gas_of(const std::string& shape, double density, double temperature) {
  return fmt::format(
      "<geom_object>{}<res>[1,1,1]</res><velocity>[0,0,0]</velocity><temperature>{:.17g}"
      "</temperature><density>{:.17g}</density></geom_object>",
      shape, temperature, density);
}
inline std::string box_from(const std::string& low, const std::string& high) {
  return "<box><min>" + low + "</min><max>" + high + "</max></box>";
}
inline std::string disk_at(double x, double y, double radius) {
  return fmt::format(
      "<cylinder><bottom>[{0},{1},-1]</bottom><top>[{0},{1},1]</top><radius>{2}</radius></"
      "cylinder>",
      x, y, radius);
}
constexpr const char* everywhere = "<box><min>[-9,-9,-9]</min><max>[9,9,9]</max></box>";

// Each part may be replaced; the rest is a disk of foam in gas at rest in a closed box.
struct CoupledDeck {
  std::string lower = "[0,0,0]", upper = "[1,1,0.025]", cells = "[40,40,1]", periodic = "[0,0,0]";
  std::string time = "0.001", multiplier = "0.4";
  std::string density = "100", bulk = "1e6", shear = "3e5";
  std::string solid = solid_object(disk_at(0.4, 0.5, 0.15), "[0,0,0]");  // further tags, objects
  std::string further;                                                   // further solids, contacts
  std::string gas = gas_object(everywhere, 1e5), viscosity = "0", specific_heat = "717.5";
  std::string drag = "0", heat = "0";  // coefficients
  std::string fluid;                   // in <CFD><ICE>
  std::string further_gas;             // further fluids
  std::string models;                  // in <Models>
  std::string gravity = "[0,0,0]";
  std::string faces;  // in place of symmetric sides
  std::string finer;  // finer levels
  std::vector<std::string> saves = {"press_CC", "temp_CC",    "vel_CC",       "rho_CC",
                                    "p.x",      "p.velocity", "p.particleID", "p.stress"};
};

inline std::string solid_of(const CoupledDeck& deck, const std::string& name,
                            const std::string& inside) {
  return fmt::format(
      "<material name='{}'><density>{}</density><thermal_conductivity>0</thermal_conductivity>"
      "<specific_heat>1000</specific_heat><constitutive_model type='comp_neo_hook'>"
      "<bulk_modulus>{}</bulk_modulus><shear_modulus>{}</shear_modulus></constitutive_model>{}"
      "</material>\n",
      name, deck.density, deck.bulk, deck.shear, inside);
}

inline std::string text_of(const CoupledDeck& deck) {
  std::string faces = deck.faces, saves;
  if (faces.empty())
    for (const char* side : {"x-", "x+", "y-", "y+", "z-", "z+"})
      if (deck.periodic[side[0] == 'x' ? 1 : side[0] == 'y' ? 3 : 5] == '0')
        faces += fmt::format(
            "<Face side='{}'><BCType id='all' label='Symmetric' var='symmetry'/></Face>\n", side);
  for (const std::string& label : deck.saves) saves += "<save label='" + label + "'/>";
  return fmt::format(
      "<Uintah_specification>\n<Meta><title>coupled</title></Meta>\n"
      "<SimulationComponent type='mpmice'/>\n"
      "<Time><initTime>0</initTime><maxTime>{}</maxTime><delt_min>0</delt_min><delt_max>1</"
      "delt_max>"
      "<timestep_multiplier>{}</timestep_multiplier></Time>\n"
      "<DataArchiver><filebase>a.uda</filebase><outputTimestepInterval>1000000"
      "</outputTimestepInterval><outputInitTimestep/><outputLastTimestep>true</outputLastTimestep>"
      "{}</DataArchiver>\n"
      "<PhysicalConstants><gravity>{}</gravity><reference_pressure>1e5</reference_pressure>"
      "</PhysicalConstants>\n"
      "<CFD><cfl>0.4</cfl><ICE><advection type='SecondOrder'/>{}</ICE></CFD>\n"
      "<MPM><DoExplicitHeatConduction>false</DoExplicitHeatConduction></MPM>\n"
      "<MaterialProperties><MPM>\n{}{}</MPM>\n<ICE><material name='gas'><EOS type='ideal_gas'/>"
      "<dynamic_viscosity>{}</dynamic_viscosity><thermal_conductivity>0</thermal_conductivity>"
      "<specific_heat>{}</specific_heat><gamma>1.4</gamma>{}</material>{}</ICE>\n"
      "<exchange_properties><exchange_coefficients><momentum>[{}]</momentum><heat>[{}]</heat>"
      "</exchange_coefficients></exchange_properties></"
      "MaterialProperties>\n{}<Grid><BoundaryConditions>\n{}</BoundaryConditions><Level><Box "
      "label='1'><lower>{}</lower>"
      "<upper>{}</upper><resolution>{}</resolution></Box><periodic>{}</periodic></Level>{}</Grid>\n"
      "</Uintah_specification>\n",
      deck.time, deck.multiplier, saves, deck.gravity, deck.fluid,
      solid_of(deck, "solid", deck.solid), deck.further, deck.viscosity, deck.specific_heat,
      deck.gas, deck.further_gas, deck.drag, deck.heat,
      deck.models.empty() ? "" : "<Models>" + deck.models + "</Models>\n", faces, deck.lower,
      deck.upper, deck.cells, deck.periodic, deck.finer);
}

}  // namespace sluice::mpmice
