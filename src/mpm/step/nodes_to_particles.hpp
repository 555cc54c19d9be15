// Grid to particles on one level: places and velocities, deformation gradient, stress, and what
// effects change; a chunk of particles at a time.
#pragma once
#include <memory>
#include <vector>

#include "mpm/step/midpoint_motion.hpp"
#include "mpm/step/shared_dilatation.hpp"
#include "mpm/step/solid_effects.hpp"

namespace sluice::mpm {

class NodesToParticles {
 public:
  // Keeps references. Null: `contact`, no rule acts; `mapped`, no velocities are mapped back.
  NodesToParticles(const MpmScene& solids, const LevelNodes& nodes, const std::vector<Body>& bodies,
                   const SolidEffects& effects, const ContactStage* contact,
                   const MappedBack* mapped);

  // The first of two passes: bounds of new velocities, by body; fault: why the step cannot go on.
  std::vector<KindRates> first_pass(const StageScope& scope, std::vector<BlockWork>& work,
                                    std::string& fault);
  // The last: what particles came to, of both passes.
  StepReport last_pass(const StageScope& scope, std::span<const BlockWork> work);

  // Of the start of the midpoint transfer: particles as they are, with their spins or without,
  // where new ones will stand (bounds of them); spins from the velocities that they mapped.
  std::vector<KindRates> hold_start(const StageScope& scope, std::vector<BlockWork>& work,
                                    bool spins);
  void take_spins(const StageScope& scope, std::span<const BlockWork> work);

 private:
  void make_room();
  Chunk chunk_of(const StageScope& scope, const BlockWork& work, int thread);
  const ParticleMotion& motion_of(const Body& body) const {
    return body.material->rigid ? *rigid_ : *deforming_;
  }
  bool in_one_pass(const Body& body) const {
    return !solids_->maps_back() && !body.material->rigid;
  }
  void advance_block(const Chunk& block);
  void advance(const Chunk& chunk, const std::vector<double>* shared);
  bool update(const Chunk& chunk, const std::vector<double>* shared);
  void carry_affine(const Chunk& chunk) const;
  void report_limits(const Chunk& chunk) const;

  const MpmScene* solids_;
  const LevelNodes* nodes_;
  const std::vector<Body>* bodies_;
  std::unique_ptr<ParticleMotion> deforming_, rigid_;  // how bodies move
  const MidpointMotion* midpoint_ = nullptr;           // deforming_, where it is this transfer
  std::vector<SolidEffect*> effects_;
  std::unique_ptr<SharedDilatation> dilatation_;  // null: the scene does not ask for it
  int order_of_F_;                                // deform()
  std::vector<ChunkBuffers> buffers_;             // by thread
  std::vector<StepReport> reports_;               // by thread
  StepReport first_;                              // of the first pass
};

}  // namespace sluice::mpm
