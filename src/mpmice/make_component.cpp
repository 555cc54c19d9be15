#include "mpmice/make_component.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/scene/deck_values.hpp"
#include "mpm/deck/read_mpm_scene.hpp"
#include "mpm/loads/check_motions.hpp"
#include "mpm/start/seed_faults.hpp"

namespace sluice::mpmice {
namespace {

// Cracks that burn are those of the solid's law.
void check_cracks(const std::vector<models::SolidBurn>& burns, const MpmIce& component,
                  std::vector<Fault>& faults) {
  for (const models::SolidBurn& burn : burns) {
    const std::size_t solid = burn.solid;
    if (!burn.law->burns_cracks() ||
        mpm::column_of(component.solids().carried()[solid], "p.crackRad") >= 0)
      continue;
    add_error(faults, burn.where,
              fmt::format("<useCrackModel> of <DDT1>: the constitutive model of '{}' has no cracks",
                          component.solids().scene().materials[solid].name),
              "use <constitutive_model type=\"visco_scram\">, or useCrackModel false");
  }
}

}  // namespace

std::unique_ptr<MpmIce> make_component(const Deck& deck, const Scene& scene,
                                       std::vector<Fault>& faults) {
  ice::IceScene fluid = ice::read_ice_scene(deck, scene, faults);
  mpm::MpmScene solids = mpm::read_mpm_scene(deck, scene, faults);
  if (any_error(faults)) return nullptr;
  bind_solids(fluid, solids);
  mpm::check_motions(*deck.root, solids, faults);
  mpm::check_seeds(solids, scene.grid, faults);
  if (any_error(faults)) return nullptr;
  models::MaterialNames names;
  for (const ice::IceMaterial& m : fluid.materials) names.fluids.push_back(m.name);
  for (const mpm::SolidMaterial& m : solids.materials) names.solids.push_back(m.name);
  const std::vector<models::SolidBurn> burns = models::read_burns(*deck.root, names);
  auto component = std::make_unique<MpmIce>(scene, std::move(fluid), std::move(solids), burns);
  check_cracks(burns, *component, faults);
  component->solids().warn_of_absent_labels(faults);
  return component;
}

}  // namespace sluice::mpmice
