// What the sides of the domain ask of nodes: velocities that are given, and images across sides.
#pragma once
#include <array>
#include <vector>

#include "framework/scene/scene.hpp"
#include "mpm/deck/mpm_scene.hpp"
#include "mpm/nodes/node_blocks.hpp"

namespace sluice::mpm {

// Given components of the velocity of a node.
struct GivenVelocity {
  std::array<bool, 3> given{};
  Vec3 value{};  // m/s
  bool any() const { return given[0] || given[1] || given[2]; }
};

class NodeBoundary {
 public:
  NodeBoundary(const Scene& scene, const MpmScene& solids, const Level& level);

  // Has the block nodes on a side of the domain or beyond it.
  bool meets(IntVec3 lower, IntVec3 edge) const;
  GivenVelocity at(IntVec3 node, int material) const;
  // Is a side normal to this direction a mirror for the material.
  bool mirrored(int d, int material) const {
    const auto& m = mirror_[material];
    return m[2 * d] || m[2 * d + 1];
  }

  // The node in the domain of which this one, beyond a mirror or a periodic side, is the image; and
  // the directions along which it is mirrored.
  struct Image {
    IntVec3 of;
    std::array<bool, 3> flipped{};
  };
  bool is_image(IntVec3 node, int material) const;
  // Is one of the nodes of a block an image.
  bool has_images(IntVec3 lower, IntVec3 edge, int material) const {
    return is_image(lower, material) || is_image(lower + edge - IntVec3{1, 1, 1}, material);
  }
  // Directions along which the node lies on a mirror of the material.
  std::array<bool, 3> on_mirror(IntVec3 node, int material) const;
  Image image(IntVec3 node, int material) const;

  // The sums of images are added to those of their nodes, and nodes' velocities copied to them
  // (lanes v, - | dv, -, counted from a velocity without component along mirrored directions).
  void fold(int material, BlockTable& table, NodeLanes& nodes) const;
  // The same for lanes of which none changes its sign across a mirror.
  void fold_scalars(int material, BlockTable& table, NodeLanes& nodes) const;
  void unfold(int material, const BlockTable& table, NodeLanes& nodes) const;
  void unfold_scalars(int material, const BlockTable& table, NodeLanes& nodes) const;

 private:
  void fold(int material, BlockTable& table, NodeLanes& nodes, bool vectors) const;
  void unfold(int material, const BlockTable& table, NodeLanes& nodes, bool vectors) const;

  const Scene* scene_;
  const MpmScene* solids_;
  Level level_;
  bool gaps_;                                // in the level: walls
  std::vector<std::array<bool, 6>> mirror_;  // by material and side
};

}  // namespace sluice::mpm
