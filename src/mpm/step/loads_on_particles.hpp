// Forces from outside on particles, through a step: at the time of the positions, to nodes, and
// what they work (outside_forces.hpp has the forces).
#pragma once
#include "mpm/step/level_nodes.hpp"
#include "mpm/step/outside_forces.hpp"
#include "mpm/step/solid_effect.hpp"

namespace sluice::mpm {

class LoadsOnParticles final : public SolidEffect {
 public:
  // Where loads act, or a saved column tells that none do.
  static bool possible(const MpmScene& solids, const OutsideForces& outside,
                       const std::vector<Carried>& carried);
  // Keeps references.
  LoadsOnParticles(const MpmScene& solids, OutsideForces& outside, const LevelNodes& nodes,
                   const std::vector<BlockWork>& work);

  void begin(const StageScope& scope) override;
  double most_force(int body) const override { return most_[static_cast<std::size_t>(body)]; }
  void give(const BlockWork& work, ParticlesToGrid& columns) const override {
    columns.load = outside_->middle_forces(work.kind, work.box);
  }
  void after_nodes(const NodeStep& step, NodeBooks& books) override;
  void moved(const Chunk& chunk) override;

 private:
  void save(const Chunk& chunk) const;

  OutsideForces* outside_;
  const LevelNodes* nodes_;
  const std::vector<BlockWork>* work_;
  std::vector<double> most_;  // by body, of this rank
  bool acts_;                 // there are forces
  double kick_ = 0;           // s
};

}  // namespace sluice::mpm
