// Rigid bodies that transmit forces: no particle of them has an equation of its own; what contact
// gives them, loads and gravity move all of them alike, dv = (J + dk sum f)/M + dk g.
#pragma once
#include <vector>

#include "mpm/contact/contact.hpp"
#include "mpm/step/outside_forces.hpp"
#include "mpm/step/solid_effect.hpp"

namespace sluice::mpm {

// Does a body transmit forces: no rule prescribes its motion (null).
inline bool transmits_forces(const SolidMaterial& material, const MasterMotion* motion) {
  return material.force_transmitting && motion == nullptr;
}

class TransmittedForces final : public SolidEffect {
 public:
  // Keeps references. `rules`: null without contact.
  TransmittedForces(const MpmScene& solids, const std::vector<Carried>& carried,
                    const std::vector<BlockWork>& work, const OutsideForces& outside,
                    const Contact* rules);

  bool transmits(int body) const;
  // Mass and what moves bodies beside gravity, N s, of this level and rank: forces from outside,
  // less what contact gave to other bodies. What is no reaction came from outside, into the books;
  // the reaction others have given.
  void after_nodes(const NodeStep& step, NodeBooks& books) override;
  const MassAndImpulse& sums(int body) const { return sums_[static_cast<std::size_t>(body)]; }
  // Mass and impulse of the whole body change its velocity, along active directions.
  void push(int body, double mass, Vec3 impulse, const std::array<bool, 3>& active);
  // Change of velocity of a body in this step, m/s.
  Vec3 pushed(int body) const { return pushed_[static_cast<std::size_t>(body)]; }

 private:
  void sum_particles(int body, double kick, MassAndImpulse& sums) const;

  const MpmScene* solids_;
  const std::vector<Carried>* carried_;
  const std::vector<BlockWork>* work_;
  const OutsideForces* outside_;
  const Contact* rules_;
  Vec3 fall_{};  // kick by gravity, m/s
  std::vector<MassAndImpulse> sums_;
  std::vector<Vec3> pushed_;
};

}  // namespace sluice::mpm
