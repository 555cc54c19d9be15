#include "mpm/step/labels.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace sluice::mpm {
namespace {

Label declare(const char* name, ValueType type, const char* unit, const char* definition) {
  return declare_label({name, type, Centring::particle, unit, definition});
}

// Table: a row for each label.
SolidLabels declare_all() {
  using enum ValueType;
  SolidLabels l;
  l.velocity = declare("p.velocity", vector, "m/s",
                       "Velocity of a particle, half a step before its position.");
  l.acceleration = declare("p.acceleration", vector, "m/s^2",
                           "Acceleration of a particle at the end of an implicit step.");
  l.mass = declare("p.mass", real, "kg", "Mass of a particle.");
  l.volume_0 = declare("p.volume_0", real, "m^3", "Volume of a particle in the reference state.");
  l.volume = declare("p.volume", real, "m^3", "Volume of a particle.");
  l.F = declare("p.deformationMeasure", tensor, "1", "Deformation gradient of a particle.");
  l.stress = declare("p.stress", tensor, "Pa", "Cauchy stress of a particle, tension positive.");
  l.energy = declare("p.deformationEnergy", real, "J",
                     "Work that deforming a particle has taken: stored, and turned into heat.");
  l.temperature = declare("p.temperature", real, "K", "Temperature of a particle.");
  l.concentration =
      declare("p.concentration", real, "1", "Concentration in a particle, of what diffuses.");
  l.affine = declare("p.affineVelocity", tensor, "1/s",
                     "Velocity gradient that an affine transfer carries.");
  l.spin = declare(
      "p.spin", vector, "1/s",
      "Angular velocity of a particle, which it transfers to nodes in addition to its velocity.");
  l.half = declare("p.halfWidths", vector, "1", "Half widths of a particle, in cells.");
  l.size = declare("p.size", tensor, "1",
                   "Edges of a particle in the reference state, in cells (columns).");
  l.displacement =
      declare("p.displacement", vector, "m", "Way of a particle from where it was at the start.");
  l.colour = declare("p.color", real, "1", "Colour that the deck gave to a particle.");
  l.marks =
      declare("p.loadCurveID", vector, "1",
              "Loads on a particle, up to three: number in the deck, counted from 1; 0: none.");
  l.given_force = declare("p.givenForce", vector, "N", "Force that a point file gives a particle.");
  l.normal = declare("p.normal", vector, "1", "Normal of a particle's surface, from a point file.");
  l.outside_force = declare("p.externalforce", vector, "N",
                            "Force on a particle from outside in the step just taken: load curves, "
                            "point files, manufactured body forces.");
  l.heat_source = declare("p.externalHeatRate", real, "W",
                          "Heat that loads bring into a particle in the step just taken.");
  l.heating = declare("p.dTdt", real, "K/s",
                      "Rate of a particle's temperature in the step just taken: work that becomes "
                      "heat, conduction, heat sources.");
  l.place_of_format =
      declare("p.xx", vector, "m",
              "Of implicit steps: place of a particle, as p.x, under another name of the format.");
  l.rate_of_format = declare("p.dTdt+", real, "K/s", "p.dTdt, under another name of the format.");
  l.viscous = declare("p.q", real, "Pa", "Artificial pressure of a particle under compression.");
  l.lost_energy = declare("p.lostEnergy", real, "J",
                          "Energy that transfer and integration have taken from a particle.");
  l.lost_heat = declare("p.heatOfLosses", real, "J", "What of that has become heat of it.");
  l.open_energy = declare("p.openEnergy", real, "J",
                          "What of p.lostEnergy is not lost: motion within a cell, and the half "
                          "of a step that is still open.");
  l.loss_temperature = declare("p.temperatureOfLosses", real, "K",
                               "What of a particle's temperature is heat of losses and of the "
                               "artificial viscosity, changed since by compression.");
  l.viscous_heat = declare("p.viscousHeat", real, "J",
                           "Heat that the artificial viscosity has given to a particle.");
  l.reference = declare("p.referencePlace", vector, "m",
                        "Place of a particle at the start, at which a total Lagrangian run takes "
                        "shape functions.");
  l.scale_factor =
      declare("p.scalefactor", tensor, "m", "Edges of a particle as it is deformed (columns).");
  for (std::size_t c = 0; c < l.corner.size(); ++c)
    l.corner[c] = declare(
        ("p.corner" + std::to_string(c + 1)).c_str(), vector, "m",
        "Place of a corner that a particle carries; in the number less one bit a says that it is "
        "on the high side of the a-th direction of the run.");
  l.split = declare("p.refinedMPM", real, "1", "1: part of a particle that was split, 0: whole.");
  l.outer = declare("p.outerFaces", real, "1",
                    "Faces of a particle that no other of its object shared at the start: the sum "
                    "of 1 and 2 for the low and the high side of the first direction, 4 and 8, 16 "
                    "and 32 for the others.");
  l.filled = declare("p.filled", real, "1",
                     "Part of the volume between the corners of a particle that has not burned.");
  l.surface_temperature =
      declare("UnsteadyBurn.PartSurfTemp", real, "K",
              "Temperature that the surface of a particle remembers, of the model Unsteady_Burn; "
              "300 before it burns.");
  l.surface_gradient =
      declare("UnsteadyBurn.PartSurfTempGrad", real, "K/m",
              "Gradient of temperature in the solid at that surface; 1e12 before it burns.");
  l.flame_kind = declare("DDT1.PartFlame", real, "1",
                         "What flames do to a particle, or come to do, of the model DDT1 with "
                         "induction times: 2 burn its surface, 3 its cracks; 0: none has set out.");
  l.flame_come = declare("DDT1.PartFlameCome", real, "1",
                         "Share of its way to the particle that such a flame has come.");
  l.flame_time = declare("DDT1.PartFlameTime", real, "s", "How long ago it set out.");
  l.flame_way =
      declare("DDT1.PartFlameWay", real, "m", "Its way, as it would go along the surface.");
  l.water_mass =
      declare("p.fluidmass", real, "kg", "Mass of the water in the pores of a particle.");
  l.water_velocity = declare("p.fluidvelocity", vector, "m/s",
                             "Velocity of that water, half a step before the particle's place.");
  l.pore_pressure =
      declare("p.porepressure", real, "Pa",
              "Pressure of that water; p.stress is the stress between grains, without "
              "it.");
  l.filtered_pressure = declare(
      "p.porepressureFilter", real, "Pa",
      "That pressure as it acted in the step just taken: with PorePressureFilter, taken from "
      "the nodes.");
  return l;
}

}  // namespace

bool is_label_of_laws(const std::string& name) {
  constexpr std::string_view names[] = {
      "p.damage", "p.localizedMPM", "p.porosity", "p.plasticStrain", "p.plasticStrainRate",
      "p.plasticStrainVol", "p.elasticStrainVol", "p.ep", "p.evp", "p.eve", "p.kappa", "p.Kappa",
      "p.arenisca_kappa", "p.yieldStress", "p.velGrad", "p.progressF", "p.strainRate", "p.epsf",
      "p.timeofloc", "p.plasticTemp", "p.plasticTempInc", "p.xx", "p.q", "p.JThermal",
      "p.lastlevel", "p.refinedMPM",
      // Of water in pores.
      "p.porepressure", "p.porepressureFilter", "p.fluidvelocity", "p.fluidmass",
      // Constants of ArenaSoil, which the deck tells.
      "p.p3", "p.ArenaBETA", "p.ArenaCR", "p.ArenaT1", "p.ArenaT2", "refineFlag"};
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

const SolidLabels& solid_labels() {
  static const SolidLabels labels = declare_all();
  return labels;
}

}  // namespace sluice::mpm
