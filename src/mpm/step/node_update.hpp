// The step on the nodes of one body, block by block: v = v_ref + P/M, contact,
// v* = v + dk (f/M - alpha v + g), contact, boundary.
#pragma once
#include <vector>

#include "mpm/step/body.hpp"
#include "mpm/step/level_nodes.hpp"
#include "mpm/step/node_step.hpp"
#include "mpm/step/solid_effect.hpp"
#include "mpm/step/step_sums.hpp"

namespace sluice::mpm {

class NodeUpdate {
 public:
  // Keeps references. `effects` may have nodes of their own beside those of a body.
  NodeUpdate(const LevelNodes& nodes, std::vector<Body>& bodies, std::vector<SolidEffect*> effects)
      : nodes_(&nodes), bodies_(&bodies), effects_(std::move(effects)) {}

  // Sums of a block become M, v_i | f; contact may change v_i.
  void start(const NodeStep& step, BlockMember of, NodeBooks& books) const;
  // M, v_i | f become M, v_i | v*; contact may change v*.
  void kick(const NodeStep& step, BlockMember of, BlockImpulses& impulses) const;
  // M, v_i | v* become v* - v_ref, M | v* - v_i.
  void finish(const NodeStep& step, BlockMember of, const BlockImpulses& impulses,
              NodeBooks& books) const;
  // All three, where no other body is.
  void move(const NodeStep& step, BlockMember of, BlockImpulses& impulses, NodeBooks& books) const;
  // v* = G x, and v likewise: the velocities of particles do not change.
  void prescribe(const std::array<double, 9>& G, BlockMember of) const;

 private:
  Body& body(BlockMember of) const { return (*bodies_)[static_cast<std::size_t>(of.body)]; }
  // Gives the velocity after forces what sides prescribe. True: some component is given.
  bool hold(BlockMember of, IntVec3 at, double mass, Vec3 v, bool booked, Vec3& after,
            NodeBooks& books) const;

  const LevelNodes* nodes_;
  std::vector<Body>* bodies_;
  std::vector<SolidEffect*> effects_;
};

}  // namespace sluice::mpm
