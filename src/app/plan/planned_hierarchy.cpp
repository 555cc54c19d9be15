// Laying the levels out as the run will, and collecting what the deck says of them.
#include "app/plan/planned_hierarchy.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/run/levels/hierarchy.hpp"
#include "ice/deck/scheme.hpp"

namespace sluice {
namespace {

std::string cells_text(IntVec3 v) {
  return fmt::format("[{},{},{}]", v.x, v.y, v.z);
}

// The thresholds of gradients: a component reads their numbers, the deck has their lines.
void add_thresholds(const DeckNode& root, std::vector<PlannedRule>& rules) {
  const DeckNode* ice = root.find("AMR/ICE/Refinement_Criteria_Thresholds");
  if (ice == nullptr) return;
  for (const DeckNode* v : ice->all("Variable"))
    rules.push_back({fmt::format("gradient of {}", v->attribute("name").value_or("")),
                     fmt::format("above {}, material {}", v->attribute("value").value_or("0"),
                                 v->attribute("matl").value_or("0")),
                     v->where});
}

void add_criteria(const LoadedScene& loaded, PlannedHierarchy& p) {
  const RefinementSettings& s = loaded.scene.refinement;
  add_thresholds(*loaded.deck.root, p.criteria);
  for (const ErrorCriterion& e : s.errors)
    p.criteria.push_back(
        {"estimated error of " + e.label,
         fmt::format("above {:g} of its range, material {}", e.tolerance, e.material), e.where});
  for (const InterfaceCriterion& c : s.interfaces)
    p.criteria.push_back({c.material < 0 ? "interfaces of all materials"
                                         : fmt::format("interfaces of material {}", c.material),
                          fmt::format("within {:g}, up to level {}", c.distance, c.finest_level),
                          c.where});
  for (const RefinedRegion& r : s.regions)
    p.criteria.push_back({fmt::format("region {}", r.name),
                          fmt::format("always, up to level {}", r.finest_level), s.where});
}

std::string when(const RefinementSettings& s) {
  if (s.once) return "at the start only";
  std::string text = "when flagged cells are not covered by a finer level";
  if (s.max_interval > 0) text += fmt::format(", and every {} coarse steps", s.max_interval);
  if (s.min_interval > 1) text += fmt::format("; at least {} steps apart", s.min_interval);
  return text;
}

void add_rules(const LoadedScene& loaded, PlannedHierarchy& p) {
  const RefinementSettings& s = loaded.scene.refinement;
  if (p.adaptive) {
    p.rules.push_back({"regrids", when(s), s.where});
    p.rules.push_back(
        {"flags are widened by",
         fmt::format("{} cells{}; at a regrid {} more; tiles stay within {} more",
                     cells_text(s.stability_dilation),
                     s.lock_step ? "" : " or the distance that a wave travels in a coarse step",
                     cells_text(s.regrid_dilation), cells_text(s.deletion_dilation)),
         s.where});
    p.rules.push_back(
        {"cells between levels", cells_text(s.min_boundary_cells) + " at least", s.where});
    p.rules.push_back({"new fine cells",
                       fmt::format("interpolated to order {}", s.interpolation_order), s.where});
  }
  p.rules.push_back({"ghost cells of finer levels",
                     fmt::format("interpolated to order {}", s.interface_order), s.where});
  std::string fluxes = "matched: the flux out of one level enters the other";
  if (!s.reflux)
    fluxes = ice::scheme_of(*loaded.deck.root).matches_fluxes
                 ? "matched: do_Refluxing false has no effect, only the classic scheme obeys it"
                 : "not matched (do_Refluxing is false): levels do not conserve";
  p.rules.push_back({"fluxes between levels", fluxes, s.reflux_where});
}

void add_levels(const Scene& scene, PlannedHierarchy& p) {
  int in_coarse_step = 1;
  for (const Level& level : scene.grid.levels) {
    const std::size_t n = level.index;
    PlannedLevel planned;
    planned.level = level;
    if (p.adaptive && n < scene.refinement.tile.size()) planned.tile = scene.refinement.tile[n];
    if (n > 0 && !scene.refinement.lock_step)
      in_coarse_step *= std::max({level.ratio.x, level.ratio.y, level.ratio.z});
    planned.substeps = in_coarse_step;
    p.levels.push_back(std::move(planned));
  }
}

// The boxes of the start, as so many ranks and threads will hold them.
void settle(const LoadedScene& loaded, int ranks, int threads, PlannedHierarchy& p) {
  Scene scene = loaded.scene;  // this process holds the boxes of all ranks
  for (Level& level : scene.grid.levels)
    for (GridBox& box : level.boxes) box.owner = 0;
  Hierarchy hierarchy(scene, *loaded.component, world(), {});
  hierarchy.initialise();
  p.limit = hierarchy.rates().first_limit();
  p.cycle = hierarchy.coarse_step().describe();
  if (!p.adaptive) return;
  Regridder regridder(scene.refinement, scene.grid.levels, ranks, threads);
  regridder.restore(regrid_state_from_json_text(hierarchy.regridding().state()));
  for (std::size_t l = 1; l < p.levels.size(); ++l)
    p.levels[l].level.boxes = regridder.boxes(static_cast<int>(l));
}

}  // namespace

double PlannedLevel::share() const {
  return static_cast<double>(level.cell_count()) / static_cast<double>(level.domain.volume());
}

double PlannedLevel::updates() const {
  return substeps * static_cast<double>(level.cell_count());
}

std::vector<Level> PlannedHierarchy::grid() const {
  std::vector<Level> found;
  for (const PlannedLevel& l : levels)
    if (!l.level.boxes.empty()) found.push_back(l.level);
  return found;
}

double PlannedHierarchy::updates() const {
  double n = 0;
  for (const PlannedLevel& l : levels) n += l.updates();
  return n;
}

double PlannedHierarchy::uniform_updates() const {
  double n = 0;
  for (const PlannedLevel& l : levels)
    if (!l.level.boxes.empty()) n = l.substeps * static_cast<double>(l.level.domain.volume());
  return n;
}

PlannedHierarchy plan_hierarchy(const LoadedScene& loaded, int ranks, int threads,
                                std::int64_t max_cells) {
  const Scene& scene = loaded.scene;
  PlannedHierarchy p;
  p.adaptive = scene.refinement.adaptive;
  p.stepping = scene.refinement.lock_step
                   ? "lockstep: all levels take the same step"
                   : "W-cycle: the number of steps of a finer level is its ratio";
  add_levels(scene, p);
  if (p.levels.size() == 1) return p;
  if (p.adaptive) add_criteria(loaded, p);
  add_rules(loaded, p);
  p.known = scene.grid.cell_count() <= max_cells;
  if (p.known) settle(loaded, ranks, threads, p);
  p.known = p.known || !p.adaptive;
  return p;
}

}  // namespace sluice
