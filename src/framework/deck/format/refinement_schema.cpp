// AMR and LoadBalancer: how levels come about, follow the solution and are dealt out.
#include <fmt/format.h>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/spelling.hpp"

namespace sluice {
namespace {

// Table: a row for each tag of <Regridder>.
TagSpec regridder() {
  // Types of older decks stand for the Tiled one; so do their tags.
  const std::vector<std::string> tiled = {"Tiled", "Hierarchical", "BNR", "GBRv1", "GBRv2"};
  const std::vector<std::string> single = {"SingleLevel"};
  return tag("Regridder", "how finer levels follow the solution")
      .attribute(
          attribute("type", "all except SingleLevel, which has no effect, refine flagged tiles")
              .once()
              .words({"Tiled", "SingleLevel", "Hierarchical", "BNR", "GBRv1", "GBRv2"}))
      .with_children({
          tag("adaptive", "levels follow the solution").boolean().by_default("true"),
          tag("max_levels", "maximum number of levels, including the coarsest")
              .once()
              .integer()
              .at_least(1),
          tag("regrid_once", "only at the start").boolean().by_default("false"),
          tag("cell_refinement_ratio",
              "coarse spacing divided by fine spacing (1, 2 or 4), per finer level; the last value "
              "is used for further levels")
              .int_vectors()
              .at_least(1)
              .only_for("type", tiled),
          tag("simple_refinement_ratio",
              "the same ratio (2 or 4) for every level and active direction")
              .integer()
              .at_least(1),
          tag("min_patch_size",
              "cells of a tile, per finer level; the last value is used for further levels")
              .int_vectors()
              .at_least(1)
              .only_for("type", tiled),
          tag("min_boundary_cells", "coarse cells between the edges of two levels")
              .int_vector()
              .at_least(0)
              .by_default("[1,1,1]")
              .only_for("type", tiled),
          tag("patches_per_level_per_proc",
              "accepted without effect: boxes are divided as ranks need them")
              .real()
              .above(0)
              .by_default("4")
              .only_for("type", tiled),
          tag("cell_stability_dilation",
              "flags are widened by at least this; a level is rebuilt when it no longer contains "
              "them")
              .int_vector()
              .at_least(0)
              .by_default("[1,1,1]"),
          tag("cell_regrid_dilation", "further widening when a level is rebuilt")
              .int_vector()
              .at_least(0)
              .by_default("[0,0,0]"),
          tag("cell_deletion_dilation", "further widening within which existing tiles are kept")
              .int_vector()
              .at_least(0)
              .by_default("[1,1,1]"),
          tag("max_timestep_interval", "maximum number of steps between regrids; 0: by flags only")
              .integer()
              .at_least(0)
              .by_default("50"),
          tag("min_timestep_interval", "minimum number of steps between regrids")
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
          tag("level", "the level that is rebuilt").integer().at_least(0).only_for("type", single),
      });
}

TagSpec refined_region() {
  return tag("Refine", "a region that is always refined")
      .multiple()
      .with_attributes({attribute("name", "name of the region").text(),
                        attribute("level", "refined up to this level; absent: the finest")
                            .integer()
                            .at_least(1)})
      .child(tag("geom_object", "the region").once().group("geometry_piece"));
}

TagSpec error_estimate() {
  return tag("ErrorEstimate", "refines where the estimated error of a variable is too large")
      .multiple()
      .with_attributes(
          {attribute("variable", "a variable that can be saved").once().text(),
           attribute("matl", "material index").integer().at_least(0).by_default("0"),
           attribute("tolerance", "largest error, as a fraction of the variable's range")
               .once()
               .real()
               .above(0)
               .at_most(1)});
}

TagSpec material_interface() {
  return tag("MaterialInterface", "refines cells near the interfaces between materials")
      .multiple()
      .with_attributes(
          {attribute("distance", "distance from the interface; 0: the cells that contain it")
               .once()
               .real()
               .at_least(0)
               .unit("length"),
           attribute("matl", "material index or all").text().by_default("all"),
           attribute("level", "refined up to this level; absent: the finest")
               .integer()
               .at_least(1)});
}

TagSpec cost(const std::string& name, const std::string& doc) {
  return tag(name, "accepted without effect: " + doc).real().at_least(0);
}

TagSpec load_balancer() {
  return tag("LoadBalancer", "boxes are distributed to ranks by measured cost")
      .attribute(attribute("type",
                           "accepted without effect: boxes are ordered along a space-filling curve")
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
          tag("gainThreshold", "smallest gain for which boxes change ranks")
              .real()
              .at_least(0)
              .at_most(1)
              .by_default("0.05"),
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

// Levels are those of <AMR>; older decks say once more whether there are any.
void drop_old_switch(DeckNode& root, std::vector<Fault>& faults) {
  std::erase_if(root.children, [&](const std::unique_ptr<DeckNode>& child) {
    if (plain_spelling(child->name) != "doamr") return false;
    const bool off = child->text == "false";
    if (off && root.find("AMR/Regridder") != nullptr) {
      add_not_built(faults, child->where, "<doAMR> false with <AMR>",
                    "remove <AMR>, or write <adaptive>false</adaptive> in its <Regridder>");
      return true;
    }
    add_warning(faults, child->where, fmt::format("<{}> is obsolete; dropped", child->name),
                "<AMR> determines it");
    return true;
  });
}

}  // namespace

void add_refinement_tags(Schema& schema) {
  schema.rewrites.emplace_back(drop_old_switch);
  schema.add(
      tag("AMR", "finer levels: those of Grid, or levels that follow the solution")
          .attribute(
              attribute("type", "StaticGridML, or no Regridder: the levels of Grid are fixed")
                  .words({"Dynamic", "StaticGridML", ""}))
          .with_children({tag("useLockStep", "all levels take the same time step")
                              .boolean()
                              .by_default("false"),
                          tag("doMultiTaskgraphing", "accepted without effect").boolean(),
                          regridder(), refined_region(), error_estimate(), material_interface()}));
  schema.add(load_balancer());
  schema.rules.emplace_back(check_refinement);
}

namespace {

// The regridder, when the deck asks it for finer levels.
const DeckNode* asked_regridder(const DeckNode& root) {
  const DeckNode* amr = root.child("AMR");
  const DeckNode* regridder = amr == nullptr ? nullptr : amr->child("Regridder");
  if (regridder == nullptr || amr->attribute("type") == "StaticGridML" ||
      regridder->attribute("type") == "SingleLevel")
    return nullptr;
  const auto levels = integer_of(regridder, "max_levels");
  const DeckNode* adaptive = regridder->child("adaptive");
  const bool off = adaptive != nullptr && adaptive->text == "false";
  return levels && *levels > 1 && !off ? regridder : nullptr;
}

void check_ratio(const DeckNode& list, int ratio, std::vector<Fault>& faults) {
  if (ratio == 1 || ratio == 2 || ratio == 4) return;
  add_error(faults, list.where,
            fmt::format("<{}>: refinement ratio {}; it must be 1, 2 or 4", list.name, ratio),
            ratio > 4 ? "use several levels to reach it" : "use 2 or 4");
}

}  // namespace

// What can be judged without the grid; tiles and active directions are judged with the scene.
void check_refinement(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* regridder = asked_regridder(root);
  if (regridder == nullptr) return;
  const DeckNode* list = regridder->child("cell_refinement_ratio");
  const DeckNode* simple = regridder->child("simple_refinement_ratio");
  if (list == nullptr && simple == nullptr)
    add_error(faults, regridder->where, "<Regridder> has no refinement ratios for its finer levels",
              "give them as <cell_refinement_ratio>[[2,2,1]]</cell_refinement_ratio>");
  if (regridder->attribute("type") == "Tiled" && regridder->child("min_patch_size") == nullptr)
    add_error(faults, regridder->where,
              "<Regridder> has no <min_patch_size>: the tiles that are refined",
              "give it as <min_patch_size>[[8,8,1]]</min_patch_size>");
  if (const auto ratio = integer_of(regridder, "simple_refinement_ratio"))
    check_ratio(*simple, *ratio, faults);
  if (const auto ratios =
          parsed_child<std::vector<IntVec3>>(regridder, "cell_refinement_ratio", parse_int_vectors))
    for (const IntVec3& r : *ratios)
      for (int d = 0; d < 3; ++d)
        if (d == 0 || (r[d] != r[0] && r[d] != r[d - 1])) check_ratio(*list, r[d], faults);
}

}  // namespace sluice
