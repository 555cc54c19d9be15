// AMR and LoadBalancer: read and checked; one level is what is built.
#include "framework/deck/framework_schema.hpp"
#include "framework/deck/rule_tools.hpp"

namespace sluice {
namespace {

TagSpec regridder() {
  const std::vector<std::string> tiled = {"Tiled"};
  const std::vector<std::string> single = {"SingleLevel"};
  return tag("Regridder", "how finer levels follow the solution")
      .attribute(attribute("type", "the way it is done").once().words({"Tiled", "SingleLevel"}))
      .with_children({
          tag("adaptive", "levels follow the solution").boolean().by_default("true"),
          tag("max_levels", "most levels").once().integer().at_least(1),
          tag("regrid_once", "only at the start").boolean().by_default("false"),
          tag("cell_refinement_ratio", "coarse spacing by fine spacing, per level")
              .int_vectors()
              .at_least(1)
              .only_for("type", tiled),
          tag("simple_refinement_ratio", "the same ratio for every level and direction")
              .integer()
              .at_least(1),
          tag("min_patch_size", "cells of the smallest tile, per level")
              .int_vectors()
              .at_least(1)
              .only_for("type", tiled),
          tag("min_boundary_cells", "coarse cells between two level jumps")
              .int_vector()
              .at_least(0)
              .by_default("[1,1,1]")
              .only_for("type", tiled),
          tag("patches_per_level_per_proc", "tiles a rank should have")
              .real()
              .above(0)
              .by_default("4")
              .only_for("type", tiled),
          tag("cell_stability_dilation", "flagged cells are widened by this")
              .int_vector()
              .at_least(0)
              .by_default("[1,1,1]"),
          tag("cell_regrid_dilation", "further widening when tiles are laid")
              .int_vector()
              .at_least(0)
              .by_default("[0,0,0]"),
          tag("cell_deletion_dilation", "widening that keeps tiles alive")
              .int_vector()
              .at_least(0)
              .by_default("[1,1,1]"),
          tag("max_timestep_interval", "most steps between regrids; 0: no limit")
              .integer()
              .at_least(0)
              .by_default("50"),
          tag("min_timestep_interval", "fewest steps between regrids")
              .integer()
              .at_least(0)
              .by_default("1"),
          tag("dynamic_dilation", "accepted without effect").boolean(),
          tag("amr_overhead_low", "accepted without effect").real().at_least(0).at_most(1),
          tag("amr_overhead_high", "accepted without effect").real().at_least(0).at_most(1),
          tag("max_dilation", "accepted without effect").text(),
          tag("new_patch_layout", "patches per direction")
              .once()
              .int_vector()
              .at_least(1)
              .only_for("type", single),
          tag("level", "the level that is laid anew")
              .integer()
              .at_least(0)
              .only_for("type", single),
      });
}

TagSpec cost(const std::string& name, const std::string& doc) {
  return tag(name, "accepted without effect: " + doc).real().at_least(0);
}

TagSpec load_balancer() {
  return tag("LoadBalancer", "accepted without effect: boxes are dealt out by measured cost")
      .attribute(attribute("type", "the balancer of the deck's author")
                     .words({"Simple", "SimpleLoadBalancer", "RoundRobin", "DLB", "PLB"}))
      .with_children({
          tag("timestepInterval", "accepted without effect").integer().at_least(0),
          tag("interval", "accepted without effect").real().at_least(0),
          tag("costAlgorithm", "accepted without effect")
              .words({"Model", "ModelLS", "Kalman", "Memory"}),
          tag("dynamicAlgorithm", "accepted without effect")
              .words({"patchFactor", "patchFactorParticles", "particle3", "cyclic", "random",
                      "Zoltan"}),
          tag("doSpaceCurve", "accepted without effect").boolean(),
          tag("hasParticles", "accepted without effect").boolean(),
          tag("gainThreshold", "accepted without effect").real().at_least(0).at_most(1),
          tag("levelIndependent", "accepted without effect").boolean(),
          tag("outputNthProc", "accepted without effect").integer().at_least(1),
          tag("profileTimestepWindow", "accepted without effect").integer().at_least(1),
          tag("zoltanAlgorithm", "accepted without effect").words({"HSFC", "RIB", "RCB"}),
          cost("zoltanIMBTol", "tolerance"),
          cost("cellCost", "weight of a cell"),
          cost("extraCellCost", "weight of a boundary cell"),
          cost("particleCost", "weight of a particle"),
          cost("patchCost", "weight of a patch"),
      });
}

}  // namespace

void add_refinement_tags(Schema& schema) {
  schema.add(
      tag("AMR", "levels that follow the solution; one level is built")
          .attribute(
              attribute("type", "how levels come about").words({"Dynamic", "StaticGridML", ""}))
          .with_children({tag("useLockStep", "all levels take the same time step")
                              .boolean()
                              .by_default("false"),
                          tag("doMultiTaskgraphing", "accepted without effect").boolean(),
                          regridder()}));
  schema.add(load_balancer());
  schema.rules.emplace_back(check_refinement);
}

void check_refinement(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* regridder = root.find("AMR/Regridder");
  const auto levels = integer_of(regridder, "max_levels");
  if (!levels || *levels <= 1) return;
  Fault fault{Severity::error, regridder->child("max_levels")->where,
              "<max_levels> above 1 is known to the format, but not built yet",
              "run on the coarsest level with --set AMR/Regridder/max_levels=1"};
  fault.not_built = true;
  faults.push_back(std::move(fault));
}

}  // namespace sluice
