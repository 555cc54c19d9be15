#include "mpmice/make_component.hpp"

#include "framework/deck/faults.hpp"
#include "framework/scene/deck_values.hpp"
#include "mpm/deck/read_mpm_scene.hpp"
#include "mpm/start/seed_faults.hpp"

namespace sluice::mpmice {

std::unique_ptr<MpmIce> make_component(const Deck& deck, const Scene& scene,
                                       std::vector<Fault>& faults) {
  ice::IceScene fluid = ice::read_ice_scene(deck, scene, faults);
  mpm::MpmScene solids = mpm::read_mpm_scene(deck, scene, faults);
  if (any_error(faults)) return nullptr;
  bind_solids(fluid, solids);
  mpm::check_seeds(solids, scene.grid, faults);
  if (any_error(faults)) return nullptr;
  models::MaterialNames names;
  for (const ice::IceMaterial& m : fluid.materials) names.fluids.push_back(m.name);
  for (const mpm::SolidMaterial& m : solids.materials) names.solids.push_back(m.name);
  auto component = std::make_unique<MpmIce>(scene, std::move(fluid), std::move(solids),
                                            models::read_burns(*deck.root, names));
  component->solids().warn_of_absent_labels(faults);
  return component;
}

}  // namespace sluice::mpmice
