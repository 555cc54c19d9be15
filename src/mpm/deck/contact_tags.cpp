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
              "motion of the master: rows of time and velocity, with include_rotation a place of "
              "the axis and the angular velocity too; absent: it moves as it started")
              .file(),
          tag("direction", "1: this component of the velocity is prescribed")
              .int_vector()
              .at_least(0)
              .at_most(1)
              .by_default("[0,0,1]"),
          tag("normal_only", "others are only kept from entering the master")
              .boolean()
              .by_default("false"),
          tag("include_rotation", "the file's rows hold a rotation").boolean().by_default("false"),
          tag("stop_time", "time at which velocity_after_stop replaces the motion")
              .real()
              .at_least(0)
              .unit("time"),
          tag("velocity_after_stop", "velocity from then on")
              .vector()
              .by_default("[0,0,0]")
              .unit("velocity")};
}

}  // namespace

TagSpec contact_tag() {
  return tag("contact",
             "how velocities of several materials at a node act on each other; several "
             "blocks act in deck order")
      .multiple()
      .with_children(
          {tag("type",
               "null: not at all; single_velocity: they become one; friction_bard, friction_LR, "
               "friction_LRVar, approach: what comes together is stopped, with friction; "
               "specified (also rigid, specified_velocity): they take the velocity of a master; "
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
           tag("volume_constraint", "acts where materials fill more than this share of the cells")
               .real()
               .at_least(0)
               .by_default("0"),
           tag("separation_factor",
               "accepted without effect: whether surfaces touch is told from the particles")
               .real()
               .above(0)
               .by_default("9.9e99")
               .unit("cells"),
           tag("OneOrTwoStep",
               "2: acts before and after forces, 1: after them; absent: 1 for a master, else 2")
               .integer()
               .at_least(1)
               .at_most(2),
           tag("ExcludeMaterial", "does not act where this material is").integer().at_least(0),
           tag("colinear_norms", "accepted without effect: computeColinearNormals of <MPM> says it")
               .boolean(),
           tag("variable_friction", "friction_LRVar: friction by colour of the master")
               .child(tag("entry", "one colour")
                          .multiple()
                          .with_children({tag("color", "the colour").once().real(),
                                          tag("mu", "its friction").once().real().at_least(0)}))})
      .with_children(specified_tags());
}

// Through contacts nothing diffuses.
TagSpec diffusion_interface_tag() {
  return tag("diffusion_interface", "what diffuses from material to material")
      .with_children(
          {tag("type", "null: nothing")
               .words({"null"})
               .not_built({"common", "paired"})
               .by_default("null"),
           tag("materials", "accepted without effect: nothing passes between any").text()});
}

TagSpec thermal_contact_tag() {
  return tag("thermal_contact", "materials that meet at a node take one temperature");
}

TagSpec cohesive_zone_tag() {
  const auto stress = [](const std::string& name, const std::string& doc) {
    return tag(name, doc).once().real().above(0).unit("pressure");
  };
  const auto opening = [](const std::string& name, const std::string& doc) {
    return tag(name, doc).real().above(0).unit("length");
  };
  return tag("cohesive_zone", "surfaces that hold two materials together")
      .multiple()
      .with_children(
          {tag("cz_filename", "points: place, area, normal, tangent, materials below and above")
               .once()
               .file(),
           stress("sig_max", "greatest normal traction"),
           stress("tau_max", "greatest tangential traction"),
           opening("delta_n", "opening at the greatest normal traction").once(),
           opening("delta_t", "slip at the greatest tangential traction").once(),
           opening("delta_n_fail", "opening at which they fail; absent: 4 delta_n"),
           opening("delta_t_fail", "slip at which they fail; absent: 4 delta_t"),
           tag("do_rotation", "true: normals turn with the materials (not supported yet)")
               .boolean()
               .by_default("false")});
}

}  // namespace sluice::mpm
