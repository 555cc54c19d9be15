#include "mpm/step/solid_effects.hpp"

#include <algorithm>

#include "mpm/step/artificial_viscosity.hpp"
#include "mpm/step/energy_books.hpp"
#include "mpm/step/heat.hpp"
#include "mpm/step/jumps.hpp"
#include "mpm/step/loads_on_particles.hpp"
#include "mpm/step/particle_temperature.hpp"
#include "mpm/step/pore_water.hpp"

namespace sluice::mpm {

template <class Effect, class... Arguments>
Effect* SolidEffects::add(Arguments&&... arguments) {
  auto effect = std::make_unique<Effect>(std::forward<Arguments>(arguments)...);
  Effect* const at = effect.get();
  own_.push_back(std::move(effect));
  list_.push_back(at);
  return at;
}

// The order is that of a step: forces, stress beside that of the law, temperatures, books.
SolidEffects::SolidEffects(const SolidParts& parts, const LevelNodes& nodes,
                           std::vector<Body>& bodies, const std::vector<BlockWork>& work,
                           const ContactStage* contact, const MappedBack* mapped)
    : outside_(*parts.solids, nodes.level, *parts.carried),
      pushes_(outside_.any() || !parts.solids->cohesive_zones.empty()) {
  const MpmScene& solids = *parts.solids;
  const std::vector<Carried>& carried = *parts.carried;
  if (!solids.cohesive_zones.empty()) add<CohesiveZones>(solids, *parts.kinds, nodes, bodies);
  if (LoadsOnParticles::possible(solids, outside_, carried))
    add<LoadsOnParticles>(solids, outside_, nodes, work);
  corners_ = add<CornerForces>(solids, nodes, bodies, work, outside_,
                               solids.midpoint() ? mapped : nullptr);
  transmitted_ = add<TransmittedForces>(solids, carried, work, outside_,
                                        contact != nullptr ? &contact->rules() : nullptr);
  if (ArtificialViscosity::possible(carried))
    add<ArtificialViscosity>(solids, carried, nodes.level);
  if (solids.any_water()) add<PoreWater>(solids, nodes, bodies, work);
  add_heat(parts, nodes, bodies, work);
  if (std::any_of(carried.begin(), carried.end(),
                  [](const Carried& of) { return of.columns.lost_energy >= 0; }))
    losses_ = add<LostEnergy>(solids, nodes, bodies, mapped);
  if (solids.contact_heats() && solids.prescribed_file.empty())
    friction_ = add<FrictionHeat>(solids, nodes, bodies);
  if (SavedHeating::possible(carried)) add<SavedHeating>();
  add<EnergyBooks>();
  if (PartedBooks::possible(solids, carried, nodes.level))
    add<PartedBooks>(solids, carried, nodes.level);
  if (!solids.insert_file.empty())
    add<Jumps>(read_insertions(solids.insert_file, static_cast<int>(solids.materials.size())));
}

void SolidEffects::add_heat(const SolidParts& parts, const LevelNodes& nodes,
                            std::vector<Body>& bodies, const std::vector<BlockWork>& work) {
  add<HeatOfLaw>();
  for (const Spreading* what : {&heat_spreads, &concentration_spreads})
    if (Heat::possible(*parts.solids, *what))
      add<Heat>(*parts.scene, *parts.solids, nodes, bodies, work, outside_, *what);
}

double SolidEffects::most_force(int body) const {
  double most = 0;
  for (const SolidEffect* effect : list_) most = std::max(most, effect->most_force(body));
  return most;
}

double SolidEffects::tension(int body) const {
  double sum = 0;
  for (const SolidEffect* effect : list_) sum += effect->tension(body);
  return sum;
}

}  // namespace sluice::mpm
