// Tags of peridynamic solids.
#include "peridynamics/deck/schema.hpp"

namespace sluice::peridynamics {
namespace {

TagSpec settings() {
  return tag("Peridynamics", "settings of the component peridynamics")
      .with_children(
          {tag("gravity", "acceleration of all points; absent: that of PhysicalConstants")
               .vector()
               .unit("acceleration"),
           tag("time_integrator", "velocity_verlet; forward_euler runs as velocity_verlet")
               .words({"velocity_verlet", "forward_euler"})
               .not_built({"backward_euler", "quasi_static"})
               .by_default("velocity_verlet"),
           tag("num_cells_in_horizon",
               "horizon of materials without <horizon>, in longest edges of a cell; absent: 3")
               .real()
               .above(0),
           tag("influence",
               "weight of a bond of length r: one: 1; linear: 1 - r/horizon; inverse: horizon/r")
               .words({"one", "linear", "inverse"})
               .by_default("linear"),
           tag("partial_volume",
               "weight of neighbours at the edge of the horizon: ramp: by how far they reach into "
               "it; none: 1")
               .words({"ramp", "none"})
               .not_built({"exact"})
               .by_default("ramp"),
           tag("surface_weights",
               "linear_elastic_bond: volume: stiffness of a point by its own family; none: one "
               "constant for all")
               .words({"volume", "none"})
               .not_built({"matched"})
               .by_default("volume"),
           tag("family_search",
               "bonds: same_material: within each material; all: between "
               "materials too")
               .words({"same_material", "all"})
               .by_default("same_material"),
           tag("plane", "state along the direction of one cell, in two dimensions")
               .words({"strain", "stress"}),
           tag("damping", "drag force per volume and velocity").real().at_least(0).by_default("0"),
           tag("damage_order",
               "bonds break behind the forces of a step, which are then summed once more, or "
               "before_force, as in Peridigm")
               .words({"after_force", "before_force"})
               .by_default("after_force"),
           tag("use_load_curves", "accepted without effect while a deck has no ParticleBC")
               .boolean()
               .by_default("false"),
           tag("interpolator", "accepted without effect: nothing is interpolated").text()});
}

TagSpec geom_object() {
  return tag("geom_object", "a region and the points that fill it")
      .at_least_once()
      .attribute(attribute("name", "name of the object").text())
      .group("geometry_piece")
      .with_children(
          {tag("res", "points per cell and direction").once().int_vector().at_least(1),
           tag("velocity", "velocity at the start").once().vector().unit("velocity"),
           tag("temperature", "accepted without effect").real().at_least(0).unit("temperature")});
}

TagSpec material_model() {
  return tag("material_model", "how bonds answer to their extension")
      .once()
      .attribute(
          attribute("type",
                    "linear_elastic_bond: bond-based (PMB), Poisson's ratio 1/4 (1/3 in "
                    "plane stress); linear_elastic_state: linear peridynamic solid (LPS)")
              .once()
              .words({"linear_elastic_bond", "linear_elastic_state"})
              .not_built({"elastic_neo_hookean_state", "polar_orthotropic_linear_elastic_state",
                          "plastic_state", "viscoelastic_state"}))
      .with_children({tag("young_modulus", "E").real().above(0).unit("pressure"),
                      tag("poisson_ratio", "nu").real(),
                      tag("bulk_modulus", "K").real().above(0).unit("pressure"),
                      tag("shear_modulus", "G").real().above(0).unit("pressure")});
}

TagSpec damage_model() {
  return tag("damage_model", "when bonds break; absent: never")
      .attribute(
          attribute("type", "spherical_strain_energy: at a critical energy; critical_stretch; none")
              .once()
              .words({"spherical_strain_energy", "critical_stretch", "none"}))
      .with_children(
          {tag("G_Ic", "fracture energy per area").real().above(0).unit("energy/length^2"),
           tag("s0", "critical_stretch: e/r at which a bond breaks").real().above(0),
           tag("no_fail", "bonds of points in these pieces never break")
               .multiple()
               .group("geometry_piece")});
}

TagSpec material() {
  return tag("material", "a peridynamic solid")
      .at_least_once()
      .with_attributes({attribute("name", "name of the material").text(),
                        attribute("index",
                                  "accepted without effect: the index follows from the "
                                  "order")
                            .text()})
      .with_children({tag("density", "density of the undeformed material")
                          .once()
                          .real()
                          .above(0)
                          .unit("density"),
                      tag("horizon", "length of the longest bonds; absent: by num_cells_in_horizon")
                          .real()
                          .above(0)
                          .unit("length"),
                      material_model(), damage_model(), geom_object()});
}

TagSpec precrack() {
  return tag("precrack", "a surface that no bond crosses")
      .multiple()
      .exactly_one({"segment", "rectangle", "disk"})
      .with_children(
          {tag("segment", "in two dimensions: a line from p1 to p2")
               .with_children({tag("p1", "one end").once().vector().unit("length"),
                               tag("p2", "the other end").once().vector().unit("length")}),
           tag("rectangle", "a parallelogram from a corner along two edges")
               .with_children({tag("corner", "one corner").once().vector().unit("length"),
                               tag("edge1", "one edge").once().vector().unit("length"),
                               tag("edge2", "the other edge").once().vector().unit("length")}),
           tag("disk", "a circular surface")
               .with_children({tag("centre", "centre").once().vector().unit("length"),
                               tag("normal", "normal").once().vector(),
                               tag("radius", "radius").once().real().above(0).unit("length")})});
}

TagSpec contact_model() {
  return tag("ContactModel", "what happens where bodies meet; absent: nothing")
      .multiple()
      .attribute(attribute("type", "null: nothing")
                     .once()
                     .words({"null"})
                     .not_built({"short_range", "single_velocity"}))
      .child(tag("materials", "indices of materials").integers());
}

}  // namespace

bool runs_peridynamics(const DeckNode& root) {
  const DeckNode* component = root.child("SimulationComponent");
  return component != nullptr && component->attribute("type").value_or("") == "peridynamics";
}

std::vector<const DeckNode*> materials_of(const DeckNode& root) {
  std::vector<const DeckNode*> materials;
  for (const DeckNode* properties : root.all("MaterialProperties"))
    if (const DeckNode* block = properties->child("Peridynamics"))
      for (const DeckNode* node : block->all("material")) materials.push_back(node);
  return materials;
}

void add_tags(Schema& schema) {
  schema.add(settings());
  schema.add(tag("MaterialProperties", "the materials and their interaction")
                 .child(tag("Peridynamics", "peridynamic solids")
                            .with_children({material(), precrack(), contact_model()})));
  schema.rules.emplace_back(check_blocks);
  schema.rules.emplace_back(check_materials);
}

}  // namespace sluice::peridynamics
