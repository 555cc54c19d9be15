// The <material> of solids with its geometry objects.
#include "mpm/deck/material_law.hpp"
#include "mpm/deck/pore_water.hpp"
#include "mpm/deck/schema.hpp"

namespace sluice::mpm {
namespace {

// x -> A x + b of the seeded places.
std::vector<TagSpec> affine_tags() {
  return {
      tag("affineTransformation_A0", "first row of A: particles are seeded at A x + b")
          .vector()
          .by_default("[1,0,0]"),
      tag("affineTransformation_A1", "second row of A").vector().by_default("[0,1,0]"),
      tag("affineTransformation_A2", "third row of A").vector().by_default("[0,0,1]"),
      tag("affineTransformation_b", "the shift b").vector().by_default("[0,0,0]").unit("length")};
}

TagSpec geom_object() {
  return tag("geom_object",
             "a region and the particles that fill it; each object fills its own region, so that "
             "overlapping objects fill it twice")
      .multiple()
      .attribute(attribute("name", "name of the object").text())
      .group("geometry_piece")
      .with_children(
          {tag("res", "particles per cell and direction").once().int_vector().at_least(1),
           tag("velocity", "velocity").once().vector().unit("velocity"),
           tag("temperature", "temperature").once().real().at_least(0).unit("temperature"),
           tag("volumeFraction", "fraction of the density that particles have; absent: 1")
               .real()
               .above(0)
               .at_most(1),
           tag("numLevelsParticleFilling",
               "number of smaller particle sizes, each half the previous one, that fill gaps at "
               "the surface; negative: particles cut by the surface are omitted")
               .integer()
               .at_least(-8)
               .at_most(8)
               .by_default("1"),
           tag("cut_cells",
               "particles cut by the surface have the volume and the centroid of the part inside; "
               "false: those whose centre is inside are full")
               .boolean()
               .by_default("false"),
           tag("color", "colour of the particles").real().by_default("0"),
           tag("concentration", "initial concentration, if do_scalar_diffusion is true; absent: 0")
               .real()
               .at_least(0)})
      .with_children(affine_tags());
}

std::vector<TagSpec> constants_tags() {
  return {
      tag("density", "density of the undeformed material").once().real().above(0).unit("density"),
      tag("thermal_conductivity", "thermal conductivity").once().real().at_least(0),
      tag("specific_heat", "at constant volume")
          .once()
          .real()
          .above(0)
          .unit("energy/(mass temperature)"),
      tag("C_p", "specific heat at constant pressure; absent: specific_heat")
          .real()
          .above(0)
          .unit("energy/(mass temperature)"),
      tag("linear_thermal_expansion_coef",
          "coefficient of linear thermal expansion, relative to room_temp")
          .real()
          .by_default("0")
          .unit("1/temperature"),
      tag("room_temp", "temperature without thermal strain")
          .real()
          .at_least(0)
          .by_default("294")
          .unit("temperature"),
      tag("melt_temp", "melting temperature")
          .real()
          .above(0)
          .by_default("295e10")
          .unit("temperature")};
}

TagSpec diffusion_model() {
  return tag("diffusion_model", "diffusion law, if do_scalar_diffusion is true")
      .attribute(attribute("type", "jg: J = -D grad C")
                     .once()
                     .words({"jg"})
                     .not_built({"rf1", "non_linear1", "non_linear2", "constant_rate"}))
      .with_children(
          {tag("diffusivity", "D").once().real().at_least(0).unit("length^2/time"),
           tag("min_concentration", "minimum concentration of a particle").real().by_default("0"),
           tag("max_concentration", "maximum concentration of a particle; absent: no bound")
               .real()});
}

std::vector<TagSpec> role_tags() {
  return {tag("is_rigid", "moves as prescribed, and is not deformed").boolean().by_default("false"),
          tag("is_force_transmitting_material",
              "moves as a rigid body, by the force that contacts transmit to it")
              .boolean()
              .by_default("false"),
          tag("is_active", "active from the start").boolean().by_default("true"),
          tag("activation_time", "active from this time on, if is_active is false")
              .real()
              .at_least(0)
              .by_default("0")
              .unit("time"),
          tag("deactivation_time", "active until this time")
              .real()
              .at_least(0)
              .by_default("1e8")
              .unit("time"),
          tag("possible_alpha_material", "friction_LR: normals may be taken from its surface")
              .boolean()
              .by_default("true")};
}

// Read where <DoGranularMPM> is true.
std::vector<TagSpec> grain_tags() {
  return {tag("critical_density",
              "DoGranularMPM: grains of smaller density have lost contact; absent: density over "
              "GranularMPMVcrix, y and z")
              .real()
              .above(0)
              .unit("mass/length^3"),
          tag("stress_free", "DoGranularMPM: grains that have lost contact have no stress")
              .boolean()
              .by_default("false"),
          tag("MatTypeIdx",
              "DoGranularMPM: materials with the same number and type of law exchange particles")
              .integer(),
          tag("allow_DWIndex_correction",
              "DoGranularMPM: whether the material exchanges particles with others of its family")
              .boolean()
              .by_default("true"),
          tag("applied_contact_model",
              "DoGranularMPM: whether contact rules act on the material; false: clusters are "
              "assigned to it only when no other material is left, and they have no contact")
              .boolean()
              .by_default("true")};
}

}  // namespace

TagSpec material_tag() {
  return tag("material", "a solid")
      .at_least_once()
      .with_attributes(
          {attribute("name", "name of the material").text(),
           attribute("index", "accepted without effect: the index follows from the order")
               .integer()
               .at_least(0)})
      .with_children(constants_tags())
      .with_children(law_tags())
      .child(diffusion_model())
      .with_children(pore_water_tags())
      .with_children(role_tags())
      .with_children(grain_tags())
      .child(geom_object());
}

}  // namespace sluice::mpm
