// The effects of a scene of solids on a level: an entry for each phenomenon that the deck asks for.
#pragma once
#include <memory>
#include <vector>

#include "mpm/step/cohesive_zones.hpp"
#include "mpm/step/corner_forces.hpp"
#include "mpm/step/friction_heat.hpp"
#include "mpm/step/lost_energy.hpp"
#include "mpm/step/outside_forces.hpp"
#include "mpm/step/transmitted_forces.hpp"

namespace sluice::mpm {

// What the solids of a run are made of.
struct SolidParts {
  const Scene* scene;
  const MpmScene* solids;
  const std::vector<Carried>* carried;
  const std::vector<ParticleKind>* kinds;  // of the materials, then of the cohesive zones
};

class SolidEffects {
 public:
  // Keeps references. Null: `contact`, no rule acts; `mapped`, no velocities are mapped back.
  SolidEffects(const SolidParts& parts, const LevelNodes& nodes, std::vector<Body>& bodies,
               const std::vector<BlockWork>& work, const ContactStage* contact,
               const MappedBack* mapped);

  // In the order in which they act.
  const SolidEffectList& all() const { return list_; }
  // Does any give forces to nodes beside stress and fluid.
  bool pushes() const { return pushes_; }
  // Bounds of what a body's particles give to nodes, see SolidEffect.
  double most_force(int body) const;
  double tension(int body) const;

  // Forces on particles: at hand in every scene, without arrays where none act.
  const OutsideForces& outside() const { return outside_; }
  // Those that others ask by name; null: the scene has none.
  TransmittedForces& transmitted() const { return *transmitted_; }
  CornerForces& corners() const { return *corners_; }
  FrictionHeat* friction() const { return friction_; }
  const LostEnergy* losses() const { return losses_; }

 private:
  template <class Effect, class... Arguments>
  Effect* add(Arguments&&... arguments);
  void add_heat(const SolidParts& parts, const LevelNodes& nodes, std::vector<Body>& bodies,
                const std::vector<BlockWork>& work);

  OutsideForces outside_;
  std::vector<std::unique_ptr<SolidEffect>> own_;
  SolidEffectList list_;
  bool pushes_;
  TransmittedForces* transmitted_ = nullptr;
  CornerForces* corners_ = nullptr;
  FrictionHeat* friction_ = nullptr;
  LostEnergy* losses_ = nullptr;
};

}  // namespace sluice::mpm
