// How solids act on each other: contacts, heat between them, cohesive zones.
#include "mpm/deck/schema.hpp"

namespace sluice::mpm {
namespace {

std::vector<TagSpec> specified_tags() {
  return {tag("master_material", "material whose motion is prescribed, or that prescribes it")
              .integer()
              .at_least(0)
              .by_default("0")
              .alias("rigid_material"),
          tag("filename",
              "motion of the master: rows of time and velocity, with include_rotation also a point "
              "of the axis and the angular velocity; absent: it keeps its initial velocity")
              .file(),
          tag("direction", "1: this component of the velocity is prescribed")
              .int_vector()
              .at_least(0)
              .at_most(1)
              .by_default("[0,0,1]"),
          tag("normal_only", "others are only prevented from entering the master")
              .boolean()
              .by_default("false"),
          tag("include_rotation", "the rows of the file contain a rotation")
              .boolean()
              .by_default("false"),
          tag("stop_time", "time at which velocity_after_stop replaces the motion")
              .real()
              .at_least(0)
              .unit("time"),
          tag("velocity_after_stop", "velocity after that time")
              .vector()
              .by_default("[0,0,0]")
              .unit("velocity")};
}

}  // namespace

TagSpec contact_tag() {
  return tag("contact",
             "contact rule for the velocities of several materials at a node; several blocks act "
             "in deck order")
      .multiple()
      .with_children(
          {tag("type",
               "null: no contact; single_velocity: one common velocity; friction_bard, "
               "friction_LR, friction_LRVar, approach: approaching motion is stopped, with "
               "friction; specified (also rigid, specified_velocity): the velocity of a master; "
               "specified_friction: a master, with friction")
               .once()
               .words({"null", "single_velocity", "friction_bard", "friction_LR", "friction_LRVar",
                       "approach", "specified", "specified_friction"})
               .spelling("friction", "friction_bard")
               .spelling("rigid", "specified")
               .spelling("specified_velocity", "specified")
               .not_built({"nodal_svf", "fluid"}),
           tag("materials", "indices of the materials; absent: all").integers().at_least(0),
           tag("mu", "coefficient of friction").real().at_least(0),
           tag("volume_constraint",
               "acts where materials fill more than this fraction of the cells")
               .real()
               .at_least(0)
               .by_default("0"),
           tag("separation_factor",
               "accepted without effect: contact of surfaces is determined from the particles")
               .real()
               .above(0)
               .by_default("9.9e99")
               .unit("cells"),
           tag("OneOrTwoStep",
               "2: acts before and after forces, 1: after them; absent: 1 for a master, else 2")
               .integer()
               .at_least(1)
               .at_most(2),
           tag("ExcludeMaterial", "does not act where this material is present")
               .integer()
               .at_least(0),
           tag("colinear_norms",
               "accepted without effect: determined by computeColinearNormals of <MPM>")
               .boolean(),
           tag("variable_friction", "friction_LRVar: friction by colour of the master")
               .child(tag("entry", "one colour")
                          .multiple()
                          .with_children({tag("color", "the colour").once().real(),
                                          tag("mu", "coefficient of friction of this colour")
                                              .once()
                                              .real()
                                              .at_least(0)}))})
      .with_children(specified_tags());
}

// Through contacts nothing diffuses.
TagSpec diffusion_interface_tag() {
  return tag("diffusion_interface", "diffusion between materials")
      .with_children(
          {tag("type", "null: nothing")
               .words({"null"})
               .not_built({"common", "paired"})
               .by_default("null"),
           tag("materials", "accepted without effect: there is no diffusion between materials")
               .text()});
}

TagSpec thermal_contact_tag() {
  return tag("thermal_contact", "materials that meet at a node get one temperature");
}

TagSpec cohesive_zone_tag() {
  const auto stress = [](const std::string& name, const std::string& doc) {
    return tag(name, doc).once().real().above(0).unit("pressure");
  };
  const auto opening = [](const std::string& name, const std::string& doc) {
    return tag(name, doc).real().above(0).unit("length");
  };
  return tag("cohesive_zone", "surfaces that connect two materials")
      .multiple()
      .with_children(
          {tag("cz_filename", "points: position, area, normal, tangent, materials below and above")
               .once()
               .file(),
           stress("sig_max", "largest normal traction"),
           stress("tau_max", "largest tangential traction"),
           opening("delta_n", "opening at the largest normal traction").once(),
           opening("delta_t", "slip at the largest tangential traction").once(),
           opening("delta_n_fail", "opening at which they fail; absent: 4 delta_n"),
           opening("delta_t_fail", "slip at which they fail; absent: 4 delta_t"),
           tag("do_rotation", "true: normals rotate with the materials (not supported yet)")
               .boolean()
               .by_default("false")});
}

}  // namespace sluice::mpm
