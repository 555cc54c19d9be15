// Means of what particles carry around nodes, for outputs.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "framework/base/communicator.hpp"
#include "mpm/step/body.hpp"
#include "mpm/step/level_nodes.hpp"

namespace sluice::mpm {

struct NodeMean {
  IntVec3 node;
  double weight = 0;
  std::array<double, 6> mean{};
};

// Which columns: a weight w, and up to six q from `first` on.
struct MeanColumns {
  int weight = 0, first = 0, count = 0;
};

// Weighted means around nodes of one body, sum w q S / sum w S, once its particles have given to
// nodes. Collective.
std::vector<NodeMean> mean_on_nodes(const MpmScene& solids, const LevelNodes& nodes, Body& body,
                                    int number, std::span<const BlockWork> work,
                                    Communicator& ranks, const MeanColumns& columns);

}  // namespace sluice::mpm
