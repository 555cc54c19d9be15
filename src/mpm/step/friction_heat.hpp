// Heat of friction: what contact takes at a node from the kinetic energy of bodies (mpm_scheme,
// section 6), shared by mass, goes to the particles around, dT_p = sum D_i/(c_v sum_m M_m) S_ip.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "mpm/step/level_nodes.hpp"
#include "mpm/step/solid_effect.hpp"

namespace sluice::mpm {

class FrictionHeat final : public SolidEffect {
 public:
  // Keeps references.
  FrictionHeat(const MpmScene& solids, const LevelNodes& nodes, const std::vector<Body>& bodies);

  void begin(const StageScope& scope) override;
  // Before nodes move. `acts`: there may be some in this step.
  void make_room(bool acts);
  // Of the blocks of a group, which are finished: impulses of contact by member, and the work from
  // outside, by node.
  void keep(std::span<const BlockMember> group, std::span<const BlockImpulses> impulses,
            const std::array<double, block_nodes>& work);
  // To images, once more where levels have passed it on.
  void unfold();
  // Rise of temperature at nodes, K, in lane 0; no blocks: none in this step.
  NodeLanes& rise(int body) { return rise_[static_cast<std::size_t>(body)]; }

  // To images.
  void after_nodes(const NodeStep& step, NodeBooks& books) override;
  // The nodes around a block of particles.
  void load(const BlockWork& work, int thread) override;
  // The rise of temperature of particles. Where lost energy heats it is part of that.
  void to_particles(const Chunk& chunk) override;

 private:
  struct Reads {
    explicit Reads(const BlockShape& shape) : window(shape, 1) {}
    Window window;
    bool warms = false;  // some node of it
  };
  bool warms(const Body& body) const { return body.material->warms_by_contact(*solids_); }

  const MpmScene* solids_;
  const LevelNodes* nodes_;
  const std::vector<Body>* bodies_;
  std::vector<NodeLanes> rise_;  // by body
  std::vector<Reads> reads_;     // by thread
};

}  // namespace sluice::mpm
