// What a deck means, put together block by block.
#include "framework/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "framework/scene/deck_values.hpp"
#include "framework/scene/formula.hpp"

namespace sluice {

namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Materials in index order: those of MPM first, then those of ICE; peridynamic ones are alone.
std::vector<MaterialEntry> read_materials(const DeckNode& root) {
  std::vector<MaterialEntry> materials;
  for (const char* kind : {"MPM", "ICE", "Peridynamics"})
    if (const DeckNode* block = root.find(fmt::format("MaterialProperties/{}", kind)))
      for (const DeckNode* m : block->all("material"))
        materials.push_back({m->attribute("name").value_or(""), kind,
                             static_cast<int>(materials.size()), m->where});
  return materials;
}

// ICE needs a full set of conditions for each of its materials, and the one pressure.
std::vector<BoundaryNeed> boundary_needs(const std::vector<MaterialEntry>& materials) {
  std::vector<int> fluids;
  for (const MaterialEntry& m : materials)
    if (m.kind == "ICE") fluids.push_back(m.index);
  if (fluids.empty()) return {};
  return {{"Pressure", {0}}, {"Density", fluids}, {"Temperature", fluids}, {"Velocity", fluids}};
}

bool is_zero(const std::string& formula) {
  return formula.find_first_not_of(" \t+-0.") == std::string::npos;
}

void note_velocity(Vec3 velocity, const Location& where, DirectionFacts& facts) {
  for (int d = 0; d < 3; ++d) {
    if (velocity[d] == 0 || facts.moving[d]) continue;
    facts.moving[d] = true;
    facts.moving_where[d] = where;
  }
}

// Velocities at the start, from geometry objects and formulas.
void note_initial_velocities(const DeckNode& root, DirectionFacts& facts,
                             std::vector<Fault>& faults) {
  for (const char* kind : {"MPM", "ICE", "Peridynamics"})
    if (const DeckNode* block = root.find(fmt::format("MaterialProperties/{}", kind)))
      for (const DeckNode* material : block->all("material"))
        for (const DeckNode* object : material->all("geom_object"))
          if (const DeckNode* v = object->child("velocity"))
            collect(faults, v->where, [&] { note_velocity(v->as_vector(), v->where, facts); });
  const DeckNode* formulas = root.find("CFD/ICE/customInitialization/formula");
  if (formulas == nullptr) return;
  for (int d = 0; d < 3; ++d) {
    const DeckNode* v = formulas->child(fmt::format("velocity_{}", "xyz"[d]));
    if (v == nullptr || is_zero(v->text)) continue;
    Vec3 moving{};
    moving[d] = 1;
    note_velocity(moving, v->where, facts);
  }
}

// A bad formula is a fault of the deck, not of the cell that would need it first.
void check_formulas(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* formulas = root.find("CFD/ICE/customInitialization/formula");
  if (formulas == nullptr) return;
  for (const auto& child : formulas->children)
    if (!child->text.empty())
      collect(faults, child->where, [&] { const Formula parsed(child->text); });
}

// Kinds whose value is a velocity of the gas or of a wall.
bool gives_velocity(const Condition& c) {
  return c.kind == ConditionKind::dirichlet || (c.kind == ConditionKind::other && c.is_vector);
}

void note_boundary_velocities(const BoundaryConditions& boundary, DirectionFacts& facts) {
  for (const BoundarySide& side : boundary.sides)
    for (const BoundaryRegion& region : side.regions)
      for (const Condition& c : region.conditions)
        if (c.variable == "Velocity" && gives_velocity(c)) note_velocity(c.vector, c.where, facts);
}

PhysicalConstants read_constants(const DeckNode& root, std::vector<Fault>& faults) {
  PhysicalConstants constants;
  const DeckNode* node = root.child("PhysicalConstants");
  if (node == nullptr) return constants;
  collect(faults, node->where, [&] {
    constants.gravity = vector_or(*node, "gravity", {});
    constants.reference_pressure = real_or(*node, "reference_pressure", 0);
    const DeckNode* gravity = node->child("gravity");
    constants.gravity_where = gravity != nullptr ? gravity->where : node->where;
  });
  return constants;
}

// The block, or a fault and nullptr.
const DeckNode* need_block(const DeckNode& root, std::string_view name,
                           std::vector<Fault>& faults) {
  const DeckNode* block = root.child(name);
  if (block == nullptr) add_error(faults, root.where, fmt::format("the deck has no <{}>", name));
  return block;
}

void check_error_criteria(const Scene& scene, std::vector<Fault>& faults) {
  const int count = static_cast<int>(scene.materials.size());
  for (const ErrorCriterion& e : scene.refinement.errors)
    if (e.material < 0 || e.material >= count)
      add_error(faults, e.where,
                fmt::format("<ErrorEstimate>: there is no material {}: the deck has {}, counted "
                            "from 0",
                            e.material, count));
}

void read_grid_and_boundary(const DeckNode& root, const SceneOptions& options, Scene& scene,
                            std::vector<Fault>& faults) {
  const DeckNode* grid = need_block(root, "Grid", faults);
  if (grid == nullptr) return;
  std::vector<Fault> mine;
  scene.grid_settings = read_grid_settings(*grid, mine);
  const bool good = !any_error(mine) && !scene.grid_settings.levels.empty();
  faults.insert(faults.end(), mine.begin(), mine.end());
  if (!good) return;
  // Without materials fields belong to "material" 0.
  const int materials = std::max(1, static_cast<int>(scene.materials.size()));
  scene.boundary = read_boundary_conditions(grid->child("BoundaryConditions"), scene.grid_settings,
                                            materials, boundary_needs(scene.materials), faults);
  DirectionFacts facts;
  facts.gravity = scene.constants.gravity;
  facts.force_all = options.force_directions;
  note_initial_velocities(root, facts, faults);
  note_boundary_velocities(scene.boundary, facts);
  scene.directions = find_active_directions(scene.grid_settings, scene.boundary, facts);
  GridOptions cut;
  cut.ranks = options.ranks;
  cut.boxes = options.boxes;
  for (std::size_t d = 0; d < 3; ++d) cut.active[d] = scene.directions[d].active;
  std::vector<Fault> of_levels;
  scene.refinement = read_refinement(root, scene.grid_settings, cut.active, of_levels);
  check_error_criteria(scene, of_levels);
  faults.insert(faults.end(), of_levels.begin(), of_levels.end());
  if (!any_error(of_levels)) scene.grid = build_grid(scene.grid_settings, cut);
}

std::string joined(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& f : faults) {
    if (!text.empty()) text += '\n';
    text += to_string(f);
  }
  return text;
}

}  // namespace

SceneError::SceneError(std::vector<Fault> faults)
    : InputError(joined(faults)), faults_(std::move(faults)) {}

Scene read_scene(const Deck& deck, const SceneOptions& options, std::vector<Fault>& faults) {
  Scene scene;
  if (!deck.good()) {
    faults.insert(faults.end(), deck.faults.begin(), deck.faults.end());
    return scene;
  }
  const DeckNode& root = *deck.root;
  if (const DeckNode* title = root.find("Meta/title")) scene.title = title->text;
  if (const DeckNode* component = need_block(root, "SimulationComponent", faults))
    scene.component = lower_case(component->attribute("type").value_or(component->text));
  scene.materials = read_materials(root);
  scene.constants = read_constants(root, faults);
  if (const DeckNode* time = need_block(root, "Time", faults))
    scene.time = read_time_settings(*time, faults);
  read_grid_and_boundary(root, options, scene, faults);
  if (const DeckNode* archiver = need_block(root, "DataArchiver", faults))
    scene.output = read_output_settings(*archiver, faults);
  check_intervals(scene.output, scene.time, faults);
  check_formulas(root, faults);
  std::vector<std::string> names;
  for (const MaterialEntry& m : scene.materials) names.push_back(m.name);
  scene.analysis = read_analysis_settings(root.child("DataAnalysis"), names, faults);
  return scene;
}

Scene read_scene(const Deck& deck, const SceneOptions& options) {
  std::vector<Fault> faults;
  Scene scene = read_scene(deck, options, faults);
  if (any_error(faults)) throw SceneError(std::move(faults));
  return scene;
}

}  // namespace sluice
