#include "app/components.hpp"

#include "examples/burger.hpp"
#include "examples/linear_solve.hpp"
#include "examples/poisson.hpp"
#include "examples/repeated_poisson.hpp"
#include "examples/wave.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/deck/schema.hpp"
#include "ice/ice.hpp"
#include "mpm/deck/read_mpm_scene.hpp"
#include "mpm/deck/schema.hpp"
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

constexpr ComponentKind kinds[] = {
    // type  tags          made by
    {"ice", add_ice_tags, make_ice},
    {"mpm", mpm::add_mpm_tags, make_mpm},
    {"amrmpm", nullptr, make_mpm},
    {"impm", nullptr, make_mpm},
    {"sfmpm", nullptr, make_mpm},
    {"shmpm", nullptr, make_mpm},
    {"mpmice", nullptr, make_mpmice},
    {"rmpmice", nullptr, make_mpmice},
    {"rigidmpmice", nullptr, make_mpmice},
    // Examples of components: docs/your_own_component.md.
    {"poisson1", examples::add_poisson_tags, examples::make_poisson},
    {"benchmark", nullptr, examples::make_poisson},
    {"poisson2", nullptr, examples::make_repeated_poisson},
    {"poisson3", nullptr, examples::make_poisson_on_levels},
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
