// A step as nodes take it, and what moves them in it.
#pragma once
#include <array>

#include "mpm/nodes/node_blocks.hpp"

namespace sluice::mpm {

struct NodeStep {
  double kick = 0;  // from the middle of the step before to the middle of this one
  double dt = 0;
  Vec3 gravity{};
  double damping = 0;  // 1/s
};

// The same block of nodes of a body, among all bodies that have it.
struct BlockMember {
  int body = 0, block = 0;
};

// What moves a node: its change of velocity by contact A, the impulse of its forces, and that of
// both hooks of contact.
struct NodeImpulses {
  Vec3 change{}, push{}, met{};
  bool held = false;  // by a master, or as one with another body
};
// Of a node behind its step, in its lane of counts: it moved by the forces of particles alone, or
// contact or a given velocity gave it an impulse too.
inline constexpr std::int64_t node_moved = 1, node_met = 2;
using BlockImpulses = std::array<NodeImpulses, block_nodes>;

}  // namespace sluice::mpm
