#include "mpmice/make_component.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/scene/deck_values.hpp"
#include "mpm/deck/read_mpm_scene.hpp"
#include "mpm/start/seed_faults.hpp"

namespace sluice::mpmice {
namespace {

// Beside solids fluids move with one velocity: also those that are bound through others alone.
void bind_fluids(ice::IceScene& fluid, std::vector<Fault>& faults) {
  if (fluid.one_velocity()) return;
  ice::PairCoefficients& momentum = fluid.exchange.momentum;
  const int count = static_cast<int>(fluid.materials.size());
  if (!momentum.bind_all(ice::one_velocity_coefficient)) {
    add_not_built(faults, fluid.exchange.momentum_where,
                  "velocities of their own of fluids beside solids",
                  fmt::format("give pairs of fluids momentum coefficients of {:g} or more",
                              ice::one_velocity_coefficient));
    return;
  }
  add_warning(faults, fluid.exchange.momentum_where,
              "fluids whose momentum coefficient is small are bound through others: all of them "
              "have one velocity",
              fmt::format("give all pairs of fluids {:g} or more", ice::one_velocity_coefficient));
  for (int m = 0; m < count; ++m)
    for (int n = m + 1; n < count; ++n)
      momentum.set(m, n, std::max(momentum(m, n), ice::one_velocity_coefficient));
}

// Cracks that burn are those of the solid's law.
void check_cracks(const std::vector<models::SolidBurn>& burns, const MpmIce& component,
                  std::vector<Fault>& faults) {
  for (const models::SolidBurn& burn : burns) {
    const auto* ddt = std::get_if<models::Ddt1>(&burn.law);
    const auto solid = static_cast<std::size_t>(burn.solid);
    if (ddt == nullptr || !ddt->cracks ||
        mpm::column_of(component.solids().carried()[solid], "p.crackRad") >= 0)
      continue;
    add_error(faults, burn.where,
              fmt::format("<useCrackModel> of <DDT1>: the law of '{}' has no cracks",
                          component.solids().scene().materials[solid].name),
              "take <constitutive_model type=\"visco_scram\">, or useCrackModel false");
  }
}

}  // namespace

std::unique_ptr<MpmIce> make_component(const Deck& deck, const Scene& scene,
                                       std::vector<Fault>& faults) {
  ice::IceScene fluid = ice::read_ice_scene(deck, scene, faults);
  mpm::MpmScene solids = mpm::read_mpm_scene(deck, scene, faults);
  if (any_error(faults)) return nullptr;
  bind_fluids(fluid, faults);
  bind_solids(fluid, solids);
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
