// A phenomenon of a scene of solids, as the stages of a step meet it.
//
// A scene has an entry in the list of effects for each phenomenon that it asks for, and none
// else (solid_effects.cpp). Hooks are called per stage, or per block of nodes or chunk of
// particles: never in a loop over these.
#pragma once
#include "framework/run/component/step_shape.hpp"
#include "mpm/step/chunk.hpp"
#include "mpm/step/node_step.hpp"
#include "mpm/step/step_sums.hpp"
#include "mpm/transfer/to_grid.hpp"

namespace sluice::mpm {

class SolidEffect {
 public:
  virtual ~SolidEffect() = default;

  // A step begins. Collective.
  virtual void begin(const StageScope& /*scope*/) {}
  // Then, bounds of what this rank's particles of a body give to nodes: a force, any component (N);
  // and V p of what acts beside the stress (J), of all ranks.
  virtual double most_force(int /*body*/) const { return 0; }
  virtual double tension(int /*body*/) const { return 0; }

  // Particles to grid. Nodes that are wanted beside those around particles (collective); further
  // columns of a block of particles, from several threads; sums beside those of particles.
  virtual void add_nodes() {}
  virtual void give(const BlockWork& /*work*/, ParticlesToGrid& /*columns*/) const {}
  virtual void give_beside() {}
  // All ranks agree on the sums. Collective.
  virtual void on_sums() {}

  // Before nodes move. Collective.
  virtual void before_nodes() {}
  // On a block of nodes of a body, from several threads. After its sums have become M, v_i | f,
  // where the block has sides of the domain; in place of the kick by f/M (true: it has moved
  // them); after velocities are final. `side`: nodes may be on sides; `booked`: by this rank.
  virtual void start_block(BlockMember /*of*/) {}
  virtual bool kick_block(const NodeStep& /*step*/, BlockMember /*of*/, BlockImpulses& /*to*/) {
    return false;
  }
  virtual void finish_block(const NodeStep& /*step*/, BlockMember /*of*/, bool /*side*/,
                            bool /*booked*/, NodeBooks& /*books*/) {}
  // Nodes and their images have moved.
  virtual void after_nodes(const NodeStep& /*step*/, NodeBooks& /*books*/) {}

  // Grid to particles: before any particle. Collective.
  virtual void before_particles(const StageScope& /*scope*/, NodeBooks& /*books*/) {}
  // From several threads: a block of particles; a chunk of those that deform, which have new
  // velocities and places, and what they read of nodes at the start of the step; a chunk that has
  // its new stress.
  virtual void load(const BlockWork& /*work*/, int /*thread*/) {}
  virtual void moved(const Chunk& /*chunk*/) {}
  virtual void to_particles(const Chunk& /*chunk*/) {}
  // What limits the next step: this rank's part.
  virtual void limit(StepReport& /*report*/) const {}
};

// In the order in which they act.
using SolidEffectList = std::vector<SolidEffect*>;

}  // namespace sluice::mpm
