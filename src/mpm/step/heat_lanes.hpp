// Nodes while heat moves: what their lanes hold.
#pragma once
#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/body.hpp"

namespace sluice::mpm {

// Lanes of a node while heat moves; at the end the rate stands where the temperature was, among
// those that read_velocities() takes to particles.
inline constexpr int temperature_lane = 0, mass_lane = 3, first_lane = 5, met_lane = 6,
                     rate_lane = 0;

// act(block, number of the node in it, its index, its lanes) for nodes with mass.
template <class Act>
void for_each_full_node(const Body& body, NodeLanes& nodes, Act&& act) {
  const BlockShape& shape = body.table.shape();
  for (int b = 0; b < body.table.count(); ++b) {
    for_each_node(shape, shape.lower(body.table.block(b)), [&](int n, IntVec3 at) {
      std::int64_t* node = nodes.sums(b) + n * lanes;
      if (node[count_lane] != 0) act(b, n, at, node);
    });
  }
}

}  // namespace sluice::mpm
