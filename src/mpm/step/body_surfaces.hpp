// Surfaces of bodies at the nodes at which they meet, as rules of contact ask for them: only the
// particles around these nodes give volumes and gradients.
#pragma once
#include <vector>

#include "mpm/contact/surface_sums.hpp"
#include "mpm/step/level_nodes.hpp"
#include "mpm/step/meeting_blocks.hpp"

namespace sluice::mpm {

class BodySurfaces {
 public:
  // Keeps references.
  BodySurfaces(const MpmScene& solids, const Contact& contact, const LevelNodes& nodes);

  // Nothing is gathered yet in this step.
  void clear();
  // Collective; `shared`: what the exchange of masses sent, by body.
  void gather(const MeetingBlocks& where, std::span<Body> bodies, std::span<const BlockWork> work,
              std::span<const SharedBlocks> shared);
  // The sums of a body, mpm/contact/surface_sums.hpp.
  const NodeLanes& sums(int body) const { return sums_[static_cast<std::size_t>(body)]; }
  SurfaceAtNode at(BlockMember of, int node) const;

 private:
  std::vector<char> blocks_of(int m, const Body& body, const std::vector<char>& marks) const;
  bool reaches(const BlockWork& work, const BlockTable& table,
               const std::vector<char>& wanted) const;
  void add(const BlockWork& work, const Body& body, Window& window, bool shared);

  const Contact* contact_;
  const LevelNodes* nodes_;
  SurfaceUnits units_;
  std::vector<NodeLanes> sums_;  // by body
};

}  // namespace sluice::mpm
