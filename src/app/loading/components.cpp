#include "app/loading/components.hpp"

#include "examples/burger.hpp"
#include "examples/labels.hpp"
#include "examples/linear_solve.hpp"
#include "examples/poisson.hpp"
#include "examples/repeated_poisson.hpp"
#include "examples/wave.hpp"
#include "framework/deck/faults.hpp"
#include "framework/run/component/particle_method.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/deck/schema.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/ice.hpp"
#include "models/models.hpp"
#include "mpm/deck/read_mpm_scene.hpp"
#include "mpm/deck/schema.hpp"
#include "mpm/declare_labels.hpp"
#include "mpm/histories.hpp"
#include "mpm/loads/check_motions.hpp"
#include "mpm/mpm.hpp"
#include "mpm/start/seed_faults.hpp"
#include "mpmice/make_component.hpp"
#include "peridynamics/deck/schema.hpp"
#include "peridynamics/peridynamics.hpp"

namespace sluice {
namespace {

std::unique_ptr<Component> make_ice(const Deck& deck, const Scene& scene,
                                    std::vector<Fault>& faults) {
  ice::IceScene fluid = ice::read_ice_scene(deck, scene, faults);
  if (any_error(faults)) return nullptr;
  return std::make_unique<ice::Ice>(scene, std::move(fluid));
}

std::unique_ptr<Component> make_mpm(const Deck& deck, const Scene& scene,
                                    std::vector<Fault>& faults) {
  mpm::MpmScene solids = mpm::read_mpm_scene(deck, scene, faults);
  if (any_error(faults)) return nullptr;
  mpm::check_motions(*deck.root, solids, faults);
  mpm::check_seeds(solids, scene.grid, faults);
  if (any_error(faults)) return nullptr;
  std::unique_ptr<mpm::Mpm> component = std::make_unique<mpm::Mpm>(scene, std::move(solids));
  component->warn_of_absent_labels(faults);
  return component;
}

std::unique_ptr<Component> make_mpmice(const Deck& deck, const Scene& scene,
                                       std::vector<Fault>& faults) {
  return mpmice::make_component(deck, scene, faults);
}

std::vector<std::string> histories_among(const std::vector<Label>& labels) {
  std::vector<std::string> names;
  for (const Label label : labels)
    if (label.info().centring == Centring::reduction) names.push_back(label.name());
  return names;
}

std::vector<std::string> histories_of_fluid(const DeckNode& root) {
  std::vector<std::string> names = histories_among(ice::own_labels());
  for (const std::string& name : models::save_labels(root))
    if (name.starts_with("totalSum_")) names.push_back(name);
  return names;
}

std::vector<std::string> histories_of_solids(const DeckNode& /*root*/) {
  std::vector<Label> labels = all_labels();
  std::erase_if(labels, [](Label label) { return !mpm::is_history(label); });
  return histories_among(labels);
}

std::vector<std::string> histories_of_both(const DeckNode& root) {
  std::vector<std::string> names = histories_of_fluid(root);
  for (std::string& name : histories_of_solids(root)) names.push_back(std::move(name));
  return names;
}

std::vector<std::string> residual(const DeckNode& /*root*/) {
  return {"residual"};
}

void declare_fluid_labels() {
  ice::labels();  // declares them
  models::declare_labels();
}

std::unique_ptr<DeckNode> make_node(const char* name, const Location& where, const char* text) {
  auto node = std::make_unique<DeckNode>();
  node->name = name;
  node->text = text;
  node->where = where;
  return node;
}

// Decks of poisson3 leave it to the component that its levels step together.
void step_levels_together(DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* grid = root.child("Grid");
  if (grid == nullptr || grid->all("Level").size() < 2) return;
  const Location where = root.child("SimulationComponent")->where;
  if (root.child("AMR") == nullptr) root.children.push_back(make_node("AMR", where, ""));
  DeckNode& amr = *root.child("AMR");
  if (amr.child("useLockStep") != nullptr) return;
  amr.children.push_back(make_node("useLockStep", amr.where, "true"));
  add_warning(faults, amr.where, "no <useLockStep> in <AMR>: the levels of poisson3 step together");
}

// Table: a row for each component.
const std::vector<ComponentKind>& kinds() {
  static const std::vector<ComponentKind> all = {
      {.type = "ice",
       .spellings = {"ICE"},
       .add_tags = add_ice_tags,
       .make = make_ice,
       .histories = histories_of_fluid,
       .declare_labels = declare_fluid_labels},
      {.type = "mpm",
       .spellings = {"MPM"},
       .add_tags = mpm::add_mpm_tags,
       .make = make_mpm,
       .histories = histories_of_solids,
       .declare_labels = mpm::declare_labels,
       .takes_gaps = true,
       .in_turn = true},
      {.type = "amrmpm",
       .spellings = {"AMRMPM", "AMRmpm"},
       .make = make_mpm,
       .histories = histories_of_solids,
       .takes_gaps = true},
      {.type = "impm",
       .spellings = {"IMPM"},
       .make = make_mpm,
       .histories = histories_of_solids,
       .takes_gaps = true,
       .in_turn = true},
      {.type = "sfmpm",
       .spellings = {"SFMPM", "SFmpm"},
       .make = make_mpm,
       .histories = histories_of_solids,
       .takes_gaps = true},
      {.type = "shmpm",
       .spellings = {"SHMPM"},
       .make = make_mpm,
       .histories = histories_of_solids,
       .takes_gaps = true},
      {.type = "mpmice",
       .spellings = {"MPMICE"},
       .make = make_mpmice,
       .histories = histories_of_both},
      {.type = "rmpmice", .make = make_mpmice, .histories = histories_of_both},
      {.type = "rigidmpmice",
       .spellings = {"RIGIDMPMICE"},
       .make = make_mpmice,
       .histories = histories_of_both},
      {.type = "peridynamics",
       .spellings = {"PERIDYNAMICS", "Peridynamics"},
       .add_tags = peridynamics::add_tags,
       .make = peridynamics::make,
       .histories = peridynamics::histories,
       .declare_labels = peridynamics::declare_labels},
      // Examples of components: docs/your_own_component.md.
      {.type = "poisson1",
       .spellings = {"POISSON1"},
       .add_tags = examples::add_poisson_tags,
       .make = examples::make_poisson,
       .histories = residual,
       .declare_labels = examples::declare_labels},
      {.type = "poisson2",
       .spellings = {"POISSON2"},
       .make = examples::make_repeated_poisson,
       .histories = residual},
      {.type = "poisson3",
       .spellings = {"POISSON3"},
       .make = examples::make_poisson_on_levels,
       .histories = residual,
       .complete = step_levels_together},
      {.type = "solvertest",
       .spellings = {"SOLVERTEST"},
       .add_tags = examples::add_solver_test_tags,
       .make = examples::make_solver_test},
      {.type = "burger",
       .spellings = {"BURGER"},
       .add_tags = examples::add_burger_tags,
       .make = examples::make_burger},
      {.type = "wave",
       .spellings = {"WAVE"},
       .add_tags = examples::add_wave_tags,
       .make = examples::make_wave},
      {.type = "benchmark",
       .spellings = {"BENCHMARK"},
       .make = examples::make_poisson,
       .histories = residual},
  };
  return all;
}

}  // namespace

std::span<const ComponentKind> component_kinds() {
  return kinds();
}

std::vector<ComponentWord> component_words() {
  std::vector<ComponentWord> words;
  for (const ComponentKind& kind : kinds())
    words.push_back({kind.type, {kind.spellings.begin(), kind.spellings.end()}, kind.in_turn});
  return words;
}

void declare_all_labels() {
  particle_labels();
  for (const ComponentKind& kind : kinds())
    if (kind.declare_labels != nullptr) kind.declare_labels();
}

const ComponentKind* component_kind(const DeckNode& root) {
  const DeckNode* named = root.child("SimulationComponent");
  if (named == nullptr) return nullptr;
  const std::string type = named->attribute("type").value_or("");
  for (const ComponentKind& kind : kinds())
    if (type == kind.type) return &kind;
  return nullptr;
}

}  // namespace sluice
