// Straight lines down, copies up.
#include "examples/node_transfer.hpp"

#include "framework/grid/box_list.hpp"

namespace sluice::examples {
namespace {

// From the nodes around `fine`, a direction at a time; `c` is the coarse node at or below it.
double between(const RealView& coarse, IntVec3 c, IntVec3 fine, IntVec3 ratio, int direction) {
  if (direction == 3) return coarse(c);
  const double here = between(coarse, c, fine, ratio, direction + 1);
  const int r = ratio[direction];
  const int beyond = fine[direction] - c[direction] * r;
  if (beyond == 0) return here;
  IntVec3 next = c;
  ++next[direction];
  const double there = between(coarse, next, fine, ratio, direction + 1);
  return here + (there - here) * beyond / r;
}

}  // namespace

void NodeTransfer::prolong(const StateViews& coarse, const StateViews& fine, const IndexBox& cells,
                           const TransferGeometry& geometry, int /*order*/) const {
  for (std::size_t v = 0; v < coarse.size(); ++v)
    for_each_cell(cells, [&](IntVec3 f) {
      fine[v](f) = between(coarse[v], coarsen(f, geometry.ratio), f, geometry.ratio, 0);
    });
}

void NodeTransfer::restrict_to(const StateViews& fine, const StateViews& coarse,
                               const IndexBox& coarse_cells,
                               const TransferGeometry& geometry) const {
  for (std::size_t v = 0; v < coarse.size(); ++v)
    for_each_cell(coarse_cells, [&](IntVec3 c) { coarse[v](c) = fine[v](c * geometry.ratio); });
}

}  // namespace sluice::examples
