// Forces on corners of particles: loads, and what a fluid gives. They go to the nodes around their
// places with hat functions, whatever the basis.
#pragma once
#include <span>
#include <vector>

#include "mpm/loads/corner_loads.hpp"
#include "mpm/step/mapped_back.hpp"
#include "mpm/step/outside_forces.hpp"
#include "mpm/step/solid_effect.hpp"

namespace sluice::mpm {

class CornerForces final : public SolidEffect {
 public:
  // Keeps references. `mapped`: velocities that particles give back at the middle of a step; null:
  // the transfer has none.
  CornerForces(const MpmScene& solids, const LevelNodes& nodes, std::vector<Body>& bodies,
               const std::vector<BlockWork>& work, const OutsideForces& outside,
               const MappedBack* mapped);

  // Loads on corners alone (use_CBDI_boundary_condition), once loads are filled.
  void begin(const StageScope& scope) override;
  double most_force(int body) const override;
  // Before particles give to nodes: further ones, behind all loads.
  void add(int body, std::span<const CornerForce> forces);
  void give_beside() override;
  // Work of loads on corners, and of what a fluid gives to corners, in a kick: when velocities of
  // nodes are final, in the midpoint transfer those that particles have given back.
  void after_nodes(const NodeStep& step, NodeBooks& books) override;
  void before_particles(const StageScope& scope, NodeBooks& books) override;

 private:
  struct OfBody {
    solids::CornerForces forces;  // loads, then the fluid's
    std::size_t loads = 0;
  };
  void add_work(std::size_t body, std::size_t begin, std::size_t end, NodeBooks& books) const;
  void book_work(NodeBooks& books) const;
  Vec3 mean_velocity(std::size_t body, Vec3 place) const;

  const MpmScene* solids_;
  const LevelNodes* nodes_;
  std::vector<Body>* bodies_;
  const std::vector<BlockWork>* work_;
  const OutsideForces* outside_;
  const MappedBack* mapped_;
  std::vector<OfBody> corners_;  // by body
  NodeStep step_;
};

}  // namespace sluice::mpm
