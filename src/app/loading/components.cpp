#include "app/loading/components.hpp"

#include "examples/burger.hpp"
#include "examples/linear_solve.hpp"
#include "examples/poisson.hpp"
#include "examples/repeated_poisson.hpp"
#include "examples/wave.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/deck/schema.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/ice.hpp"
#include "models/models.hpp"
#include "mpm/deck/read_mpm_scene.hpp"
#include "mpm/deck/schema.hpp"
#include "mpm/histories.hpp"
#include "mpm/implicit_mpm.hpp"
#include "mpm/loads/check_motions.hpp"
#include "mpm/start/seed_faults.hpp"
#include "mpmice/make_component.hpp"

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
  std::unique_ptr<mpm::Mpm> component = mpm::make_solids(scene, std::move(solids));
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

constexpr ComponentKind kinds[] = {
    // type  tags          made by, histories
    {"ice", add_ice_tags, make_ice, histories_of_fluid},
    {"mpm", mpm::add_mpm_tags, make_mpm, histories_of_solids, true},
    {"amrmpm", nullptr, make_mpm, histories_of_solids, true},
    {"impm", nullptr, make_mpm, histories_of_solids, true},
    {"sfmpm", nullptr, make_mpm, histories_of_solids, true},
    {"shmpm", nullptr, make_mpm, histories_of_solids, true},
    {"mpmice", nullptr, make_mpmice, histories_of_both},
    {"rmpmice", nullptr, make_mpmice, histories_of_both},
    {"rigidmpmice", nullptr, make_mpmice, histories_of_both},
    // Examples of components: docs/your_own_component.md.
    {"poisson1", examples::add_poisson_tags, examples::make_poisson, residual},
    {"benchmark", nullptr, examples::make_poisson, residual},
    {"poisson2", nullptr, examples::make_repeated_poisson, residual},
    {"poisson3", nullptr, examples::make_poisson_on_levels, residual},
    {"solvertest", examples::add_solver_test_tags, examples::make_solver_test},
    {"burger", examples::add_burger_tags, examples::make_burger},
    {"wave", examples::add_wave_tags, examples::make_wave},
};

}  // namespace

std::span<const ComponentKind> component_kinds() {
  return kinds;
}

const ComponentKind* component_kind(const Deck& deck) {
  const DeckNode* named = deck.root->child("SimulationComponent");
  if (named == nullptr) return nullptr;
  const std::string type = named->attribute("type").value_or("");
  for (const ComponentKind& kind : kinds)
    if (type == kind.type) return &kind;
  return nullptr;
}

}  // namespace sluice
