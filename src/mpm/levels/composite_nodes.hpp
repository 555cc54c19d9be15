// One basis over two levels: nodes of either level that are no unknowns follow those that are.
//
//   - A fine node on the end of the fine level or beyond it hangs: its velocity is interpolated
//     linearly from the coarse nodes around it, v_f = sum_c N_c(x_f) v_c.
//   - A coarse node strictly inside the fine level has the velocity of the fine node at its place.
//
// Sums go the other way, with the same weights: so all shape functions still add up to one, and
// mass and momentum are kept where levels meet.
#pragma once
#include "mpm/levels/fine_region.hpp"
#include "mpm/nodes/node_blocks.hpp"

namespace sluice::mpm {

class CompositeNodes {
 public:
  explicit CompositeNodes(const Level& fine) : region_(fine), ratio_(fine.ratio) {}

  // Sums of coarse nodes inside the fine level to the fine nodes there; exact, so that ranks may do
  // it with what each has.
  void to_fine(BlockTable& coarse, NodeLanes& coarse_nodes, BlockTable& fine,
               NodeLanes& fine_nodes) const;
  // Blocks with the coarse nodes of those that hang, where they are missing.
  void add_parents(const BlockTable& fine, const NodeLanes& fine_nodes, BlockTable& coarse,
                   NodeLanes& coarse_nodes) const;
  // Sums of hanging nodes, complete over ranks, to the coarse ones: of blocks for which `mine`.
  // Both levels count in the same units.
  template <class Mine>
  void to_coarse(const BlockTable& fine, NodeLanes& fine_nodes, const BlockTable& coarse,
                 NodeLanes& coarse_nodes, Mine&& mine) const {
    for (int b = 0; b < fine.count(); ++b)
      hang_block(fine, fine_nodes, coarse, coarse_nodes, b, mine(b));
  }
  // Velocities of hanging nodes; of covered ones (lanes v, . | dv, .).
  void from_coarse(const BlockTable& fine, NodeLanes& fine_nodes, const BlockTable& coarse,
                   const NodeLanes& coarse_nodes) const;
  void from_fine(const BlockTable& coarse, NodeLanes& coarse_nodes, const BlockTable& fine,
                 const NodeLanes& fine_nodes) const;

 private:
  void hang_block(const BlockTable& fine, NodeLanes& fine_nodes, const BlockTable& coarse,
                  NodeLanes& coarse_nodes, int block, bool add) const;

  FineRegion region_;
  IntVec3 ratio_;
};

}  // namespace sluice::mpm
