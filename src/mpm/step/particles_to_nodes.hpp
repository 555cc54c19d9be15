// Particles to grid on one level: mass, momentum and force of the nodes of all bodies.
#pragma once
#include <vector>

#include "mpm/step/level_nodes.hpp"
#include "mpm/step/solid_effect.hpp"

namespace sluice::mpm {

// The nodes that the particles of a block reach: its own and those of a stencil around; corners
// farther than that; with shape functions of the start, wherever the particles were then.
void find_nodes_of(const MpmScene& solids, const BlockShape& shape, const Body& body,
                   BlockWork& work);

class ParticlesToNodes {
 public:
  // Keeps references.
  ParticlesToNodes(const MpmScene& solids, const LevelNodes& nodes, std::vector<Body>& bodies)
      : solids_(&solids), nodes_(&nodes), bodies_(&bodies) {}

  // Sums of this rank's particles, and of what effects give. Collective.
  void give(std::vector<BlockWork>& work, const SolidEffectList& effects) const;

 private:
  void find_nodes(std::vector<BlockWork>& work) const;
  void give_block(const BlockWork& work, const SolidEffectList& effects, Window& window,
                  bool shared) const;

  const MpmScene* solids_;
  const LevelNodes* nodes_;
  std::vector<Body>* bodies_;
};

}  // namespace sluice::mpm
