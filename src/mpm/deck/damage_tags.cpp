// <damage_model> and <erosion> of a material.
#include "mpm/deck/schema.hpp"

namespace sluice::mpm {
namespace {

TagSpec number_of(const std::string& type, const std::string& name, const std::string& doc) {
  return tag(name, doc).real().only_for("type", {type});
}

std::vector<TagSpec> threshold_tags() {
  const std::string type = "Threshold";
  return {number_of(type, "failure_mean", "mean of the thresholds").once().above(0),
          number_of(type, "failure_std", "standard deviation, or exponent of weibull")
              .at_least(0)
              .by_default("0"),
          tag("failure_seed", "seed of the random numbers")
              .integer()
              .only_for("type", {type})
              .by_default("0"),
          tag("failure_distrib", "how thresholds vary among particles")
              .only_for("type", {type})
              .words({"constant", "gauss", "weibull"})
              .by_default("constant"),
          tag("failure_criteria", "what is compared with the threshold")
              .once()
              .only_for("type", {type})
              .words({"MaximumPrincipalStress", "MaximumPrincipalStrain", "MohrCoulomb"}),
          number_of(type, "friction_angle", "MohrCoulomb: angle of friction").unit("degree"),
          number_of(type, "tensile_cutoff_fraction_of_cohesion", "MohrCoulomb: greatest tension")
              .at_least(0),
          tag("LocalizeParticles", "accepted without effect: <erosion> says what follows")
              .boolean()
              .only_for("type", {type})};
}

std::vector<TagSpec> brittle_tags() {
  const std::string type = "Brittle", b = "brittle_damage_";
  const auto flag = [&](const std::string& name, const std::string& doc) {
    return tag(b + name, doc).boolean().only_for("type", {type}).by_default("false");
  };
  return {number_of(type, b + "initial_threshold", "energy norm at which damage begins")
              .once()
              .above(0),
          number_of(type, b + "fracture_energy", "energy per area of a crack").once().above(0),
          number_of(type, b + "constant_D", "shape of the softening").by_default("0.1").above(0),
          number_of(type, b + "max_damage_increment", "most damage of a step")
              .by_default("0.1")
              .above(0),
          flag("allowRecovery", "damage is undone under pressure"),
          number_of(type, b + "recoveryCoeff", "share of the stiffness that comes back")
              .by_default("1"),
          flag("printDamage", "accepted without effect")};
}

std::vector<TagSpec> johnson_cook_tags() {
  const std::string type = "johnson_cook";
  std::vector<TagSpec> tags;
  for (int n = 1; n <= 5; ++n)
    tags.push_back(number_of(type, "D" + std::to_string(n), "constant of the fracture strain")
                       .once());
  return tags;
}

// How damage varies at the start.
std::vector<TagSpec> scalar_damage_tags() {
  const std::vector<std::string> types = {"johnson_cook", "hancock_mackenzie"};
  const auto number = [&](const std::string& name, const std::string& doc) {
    return tag(name, doc).real().only_for("type", types);
  };
  return {number("initial_mean_scalar_damage", "mean damage at the start").by_default("0"),
          number("initial_std_scalar_damage", "its standard deviation").by_default("0"),
          number("critical_scalar_damage", "damage at which a particle fails").by_default("1"),
          tag("initial_scalar_damage_distrib", "how damage varies at the start")
              .only_for("type", types)
              .words({"constant", "gauss"})
              .by_default("constant")};
}

}  // namespace

TagSpec damage_model_tag() {
  return tag("damage_model", "how particles fail")
      .attribute(attribute("type", "the law")
                     .once()
                     .words({"Threshold", "Brittle", "johnson_cook", "hancock_mackenzie", "none"})
                     .not_built({"ThresholdVar"}))
      .with_children(threshold_tags())
      .with_children(brittle_tags())
      .with_children(johnson_cook_tags())
      .with_children(scalar_damage_tags());
}

TagSpec erosion_tag() {
  return tag("erosion", "what becomes of particles that have failed")
      .attribute(attribute("algorithm", "which part of the stress they keep")
                     .once()
                     .words({"none", "ZeroStress", "AllowNoTension", "AllowNoShear",
                             "PreserveStress"}))
      .child(tag("char_time", "time in which the stress decays")
                 .real()
                 .at_least(0)
                 .by_default("1e-99")
                 .unit("time"));
}

}  // namespace sluice::mpm
