// Nodes of a level: node i is the low corner of cell i, so that fields on nodes are kept by cell.
//
// A box of cells owns the nodes at the low corners of its cells. Those on its high sides are nodes
// of the next box, and lie in its first ghost layer; on the high sides of the domain nobody owns
// them, and a component's boundary fills them (the nodes that close the domain). In a direction
// that is not active there is one layer of nodes. Positions in m.
#pragma once
#include <algorithm>

#include "framework/grid/level.hpp"
#include "framework/grid/side.hpp"

namespace sluice {

inline Vec3 node_position(const Level& level, IntVec3 node) {
  Vec3 p;
  for (int d = 0; d < 3; ++d) p[d] = level.anchor[d] + node[d] * level.spacing[d];
  return p;
}

// Does the domain end at this side: neither periodic nor out of the run.
inline bool ends_at(const Level& level, Side side) {
  const int d = direction_of(side);
  return level.active[d] && !level.periodic[d];
}

// The nodes that lie on no side where the domain ends; directions without such a side are endless.
inline IndexBox inner_nodes(const Level& level) {
  constexpr int endless = 1 << 29;
  IndexBox nodes{IntVec3::all(-endless), IntVec3::all(endless)};
  for (int d = 0; d < 3; ++d) {
    if (!ends_at(level, side_of(d, false))) continue;
    nodes.lower[d] = level.domain.lower[d] + 1;
    nodes.upper[d] = level.domain.upper[d];
  }
  return nodes;
}

// The nodes of `within` on one side of the domain.
inline IndexBox side_nodes(const Level& level, Side side, const IndexBox& within) {
  const int d = direction_of(side);
  const int at = is_plus(side) ? level.domain.upper[d] : level.domain.lower[d];
  IndexBox plane = within;
  plane.lower[d] = std::max(plane.lower[d], at);
  plane.upper[d] = std::min(plane.upper[d], at + 1);
  return plane;
}

}  // namespace sluice
