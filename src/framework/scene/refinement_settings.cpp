// Reading the deck's <AMR> and <LoadBalancer>.
#include "framework/scene/refinement_settings.hpp"
#include "framework/scene/directions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/scene/adaptive_levels.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice {

namespace {

constexpr int default_tile = 8;  // cells, where the deck's regridder has none

using Active = std::array<bool, 3>;

const Location& place_of(const DeckNode& parent, std::string_view child) {
  const DeckNode* node = parent.child(child);
  return node != nullptr ? node->where : parent.where;
}

// Only dimensions of the run are widened.
IntVec3 masked(IntVec3 cells, const Active& active) {
  for (int d = 0; d < 3; ++d)
    if (!active[d]) cells[d] = 0;
  return cells;
}

void read_orders(const DeckNode& amr, RefinementSettings& s) {
  s.lock_step = boolean_or(amr, "useLockStep", false);
  const DeckNode* ice = amr.child("ICE");
  if (ice == nullptr) return;
  s.interpolation_order = integer_or(*ice, "orderOfInterpolation", s.interpolation_order);
  s.interface_order = integer_or(*ice, "orderOf_CFI_Interpolation", s.interpolation_order);
  s.reflux = boolean_or(*ice, "do_Refluxing", true);
  s.reflux_where = place_of(*ice, "do_Refluxing");
}

// What stability asks of the widening: a wave crosses up to one cell of its level a step, and the
// fine level must still hold it at the next regrid.
void check_dilation(const DeckNode& node, const Active& active, RefinementSettings& s,
                    std::vector<Fault>& faults) {
  int least = -1;
  for (int d = 0; d < 3; ++d) {
    if (!active[d]) continue;
    if (least < 0 || s.stability_dilation[d] < least) least = s.stability_dilation[d];
    if (s.stability_dilation[d] == 0)
      add_warning(faults, place_of(node, "cell_stability_dilation"),
                  fmt::format("cell_stability_dilation 0 in direction {}: a wave can leave the "
                              "finer level before it is rebuilt",
                              axis_letter[d]),
                  "use at least 1");
    if (s.min_boundary_cells[d] == 0) {
      add_warning(faults, place_of(node, "min_boundary_cells"),
                  fmt::format("min_boundary_cells 0 in direction {}; read as 1: a level may touch "
                              "only the next coarser one",
                              axis_letter[d]));
      s.min_boundary_cells[d] = 1;
    }
  }
  if (least > 0 && s.min_interval > least + 1)
    add_warning(faults, place_of(node, "min_timestep_interval"),
                fmt::format("min_timestep_interval {} with a cell_stability_dilation of {}: a wave "
                            "can leave the finer level before it is rebuilt",
                            s.min_interval, least),
                fmt::format("use at most {}", least + 1));
  if (s.max_interval > 0 && s.max_interval < s.min_interval)
    add_warning(faults, place_of(node, "max_timestep_interval"),
                fmt::format("max_timestep_interval {} has no effect: min_timestep_interval is {}",
                            s.max_interval, s.min_interval));
}

void read_intervals(const DeckNode& node, const Active& active, RefinementSettings& s,
                    std::vector<Fault>& faults) {
  const RefinementSettings defaults;
  const auto cells = [&](const char* tag, IntVec3 fallback) {
    return masked(int_vector_or(node, tag, fallback), active);
  };
  s.stability_dilation = cells("cell_stability_dilation", defaults.stability_dilation);
  s.regrid_dilation = cells("cell_regrid_dilation", defaults.regrid_dilation);
  s.deletion_dilation = cells("cell_deletion_dilation", defaults.deletion_dilation);
  s.min_boundary_cells = cells("min_boundary_cells", defaults.min_boundary_cells);
  s.max_interval = integer_or(node, "max_timestep_interval", s.max_interval);
  s.min_interval = integer_or(node, "min_timestep_interval", s.min_interval);
  s.once = boolean_or(node, "regrid_once", false);
  check_dilation(node, active, s, faults);
}

// The lists of ratios and tiles; false when the deck lacks one that it must have.
bool read_lists(const DeckNode& node, const Active& active, bool tiled, AdaptiveLevels& levels,
                std::vector<Fault>& faults) {
  levels.ratio_where = levels.tile_where = node.where;
  if (const DeckNode* list = node.child("cell_refinement_ratio")) {
    levels.ratios = list->as_int_vectors();
    levels.ratio_where = list->where;
    if (const DeckNode* one = node.child("simple_refinement_ratio"))
      add_warning(faults, one->where,
                  "<simple_refinement_ratio> has no effect together with <cell_refinement_ratio>",
                  "keep one of them");
  } else if (const DeckNode* one = node.child("simple_refinement_ratio")) {
    IntVec3 ratio{1, 1, 1};
    for (int d = 0; d < 3; ++d)
      if (active[d]) ratio[d] = one->as_integer();
    levels.ratios = {ratio};
    levels.ratio_where = one->where;
  }
  if (levels.ratios.empty()) {
    add_error(faults, node.where, "<Regridder> has no refinement ratios for its finer levels",
              "give them as <cell_refinement_ratio>[[2,2,1]]</cell_refinement_ratio>");
    return false;
  }
  if (const DeckNode* list = node.child("min_patch_size")) {
    levels.tiles = list->as_int_vectors();
    levels.tile_where = list->where;
  } else if (!tiled) {
    levels.tiles = {IntVec3::all(default_tile)};
  }
  if (levels.tiles.empty()) {
    add_error(faults, node.where, "<Regridder> has no <min_patch_size>: the tiles that are refined",
              "give it as <min_patch_size>[[8,8,1]]</min_patch_size>");
    return false;
  }
  return true;
}

// The <Regridder> that makes levels; nullptr when those of <Grid> stay as they are.
const DeckNode* working_regridder(const DeckNode& amr, std::vector<Fault>& faults) {
  const DeckNode* node = amr.child("Regridder");
  const std::string type = amr.attribute("type").value_or("");
  if (node == nullptr) {
    if (type == "Dynamic")
      add_warning(faults, amr.where,
                  "type Dynamic, but no <Regridder>: the levels of <Grid> are fixed");
    return nullptr;
  }
  const int most = integer_or(*node, "max_levels", 1);
  if (type == "StaticGridML") {
    add_warning(faults, node->where,
                "<Regridder> has no effect with type StaticGridML: the levels of <Grid> are fixed",
                "write type Dynamic for levels that follow the solution");
    return nullptr;
  }
  if (node->attribute("type") == "SingleLevel") {
    add_warning(faults, node->where,
                "a SingleLevel regridder has no effect: boxes are divided as ranks need them");
    return nullptr;
  }
  if (most <= 1) return nullptr;
  if (!boolean_or(*node, "adaptive", true)) {
    add_warning(faults, node->where,
                "<adaptive> is false: no finer level is made, whatever max_levels says");
    return nullptr;
  }
  return node;
}

// Finer <Level>s of the deck say where a regridder refines at the start, beside what flags ask for.
void take_start_boxes(GridSettings& grid, RefinementSettings& s) {
  for (std::size_t l = 1; l < grid.levels.size(); ++l) {
    StartBoxes& of_level = s.start_boxes.emplace_back();
    of_level.ratio = grid.levels[l].ratio;
    for (const BoxSettings& b : grid.levels[l].boxes) of_level.boxes.push_back(b.cells);
  }
  grid.levels.resize(1);
}

void read_regridder(const DeckNode& amr, const Active& active, GridSettings& grid,
                    RefinementSettings& s, std::vector<Fault>& faults) {
  const DeckNode* node = working_regridder(amr, faults);
  if (node == nullptr) return;
  const std::string type = node->attribute("type").value_or("Tiled");
  if (type != "Tiled")
    add_warning(
        faults, node->where,
        fmt::format("the {} regridder is replaced by the Tiled one: flagged tiles are refined",
                    type));
  collect(faults, node->where, [&] {
    read_intervals(*node, active, s, faults);
    take_start_boxes(grid, s);
    AdaptiveLevels levels;
    levels.max_levels = node->integer("max_levels");
    if (!read_lists(*node, active, type == "Tiled", levels, faults)) return;
    s.tile = add_adaptive_levels(levels, active, grid, faults);
    if (s.tile.empty()) return;
    s.adaptive = true;
    s.max_levels = levels.max_levels;
  });
}

// Whether a cell of the coarsest level may have its centre between these bounds.
bool may_hold_centres(const Bounds& bounds, const GridSettings& grid) {
  constexpr double spare = 1e-9;  // of a cell, for round-off
  const IndexBox domain = domain_of(grid, 0);
  const Vec3 dx = grid.levels.front().spacing;
  for (int d = 0; d < 3; ++d) {
    const double low = std::ceil((bounds.lower[d] - grid.anchor[d]) / dx[d] - 0.5 - spare),
                 high = std::floor((bounds.upper[d] - grid.anchor[d]) / dx[d] - 0.5 + spare);
    if (std::max(low, 1.0 * domain.lower[d]) > std::min(high, domain.upper[d] - 1.0)) return false;
  }
  return true;
}

// Up to which level a criterion refines.
int finest_level(const DeckNode& node, const RefinementSettings& s, std::vector<Fault>& faults) {
  int finest = s.max_levels - 1;
  collect(faults, node.where, [&] {
    const int asked = integer_attribute(node, "level").value_or(finest);
    if (asked < 1)
      add_error(faults, node.where,
                fmt::format("<{}>: level {}; the coarsest refined level is 1", node.name, asked));
    else if (asked > finest)
      add_warning(faults, node.where,
                  fmt::format("<{}>: level {}, but with max_levels {} the finest level is {}",
                              node.name, asked, s.max_levels, finest));
    finest = std::min(asked, finest);
  });
  return finest;
}

void read_regions(const DeckNode& root, const DeckNode& amr, const GridSettings& grid,
                  RefinementSettings& s, std::vector<Fault>& faults) {
  const std::vector<const DeckNode*> nodes = amr.all("Refine");
  if (nodes.empty()) return;
  std::vector<Fault> of_labels;  // told where materials are read
  const GeometryReader geometry(root, of_labels);
  for (const DeckNode* node : nodes) {
    RefinedRegion region;
    region.name = node->attribute("name").value_or(fmt::format("region {}", s.regions.size()));
    region.finest_level = finest_level(*node, s, faults);
    const DeckNode* object = node->child("geom_object");
    if (object == nullptr) {
      add_error(faults, node->where, "<Refine> has no <geom_object>: the region to refine",
                "give it as <geom_object><box>...</box></geom_object>");
      continue;
    }
    region.piece = geometry.object(*object, faults).piece;
    if (region.piece == nullptr) continue;
    if (!may_hold_centres(region.piece->bounds(), grid))
      add_warning(faults, node->where,
                  fmt::format("<Refine>: {} has no effect: no cell of the coarsest level has its "
                              "centre there",
                              region.name),
                  "it must overlap the domain and be at least one cell wide in every direction");
    s.regions.push_back(std::move(region));
  }
}

void read_errors(const DeckNode& amr, RefinementSettings& s, std::vector<Fault>& faults) {
  for (const DeckNode* node : amr.all("ErrorEstimate"))
    collect(faults, node->where, [&] {
      ErrorCriterion e;
      e.label = node->attribute("variable").value_or("");
      e.material = integer_attribute(*node, "matl").value_or(0);
      e.tolerance = real_attribute(*node, "tolerance").value_or(0);
      e.where = node->where;
      if (e.label.empty())
        throw InputError("<ErrorEstimate> has no variable; name one, as variable=\"rho_CC\"");
      if (!(e.tolerance > 0 && e.tolerance <= 1))
        throw InputError(fmt::format(
            "<ErrorEstimate>: tolerance {}; it must be greater than 0 and at most 1, as "
            "tolerance=\"0.01\" for one percent of the variable's range",
            e.tolerance));
      s.errors.push_back(std::move(e));
    });
}

void read_interfaces(const DeckNode& amr, RefinementSettings& s, std::vector<Fault>& faults) {
  for (const DeckNode* node : amr.all("MaterialInterface"))
    collect(faults, node->where, [&] {
      InterfaceCriterion c;
      if (node->attribute("matl").value_or("all") != "all")
        c.material = integer_attribute(*node, "matl").value_or(c.material);
      const std::optional<double> distance = real_attribute(*node, "distance");
      if (!distance || !(*distance >= 0))
        throw InputError(
            "<MaterialInterface> needs a distance of 0 (cells that contain the interface) or more, "
            "as distance=\"0.05\"");
      c.distance = *distance;
      c.finest_level = finest_level(*node, s, faults);
      c.where = node->where;
      s.interfaces.push_back(c);
    });
}

}  // namespace

RefinementSettings read_refinement(const DeckNode& root, GridSettings& grid, const Active& active,
                                   std::vector<Fault>& faults) {
  RefinementSettings s;
  s.where = s.reflux_where = grid.where;
  check_static_levels(grid, active, faults);
  if (const DeckNode* balancer = root.child("LoadBalancer"))
    collect(faults, balancer->where,
            [&] { s.balance_gain = real_or(*balancer, "gainThreshold", s.balance_gain); });
  const DeckNode* amr = root.child("AMR");
  if (amr != nullptr) {
    s.where = s.reflux_where = amr->where;
    collect(faults, amr->where, [&] { read_orders(*amr, s); });
    read_regridder(*amr, active, grid, s, faults);
  }
  s.max_levels = static_cast<int>(grid.levels.size());
  if (amr == nullptr) return s;
  if (!s.adaptive) {
    if (any_error(faults)) return s;  // which says more than the lack of levels does
    for (const char* tag : {"Refine", "ErrorEstimate", "MaterialInterface"})
      if (const DeckNode* node = amr->child(tag))
        add_warning(faults, node->where,
                    fmt::format("<{}> has no effect: no regridder makes finer levels here", tag));
    return s;
  }
  read_regions(root, *amr, grid, s, faults);
  read_errors(*amr, s, faults);
  read_interfaces(*amr, s, faults);
  return s;
}

}  // namespace sluice
