// Cutting boxes.
#include "framework/field/block_lattice.hpp"

namespace sluice {

BlockLattice::BlockLattice(const std::vector<GridBox>& boxes, IntVec3 extents) : extents_(extents) {
  for (const GridBox& b : boxes) {
    Cut cut;
    cut.box = b.cells;
    cut.first = size_;
    for (int d = 0; d < 3; ++d)
      cut.pieces[d] = std::max(1, (b.cells.size()[d] + extents[d] - 1) / extents[d]);
    size_ += cut.pieces.x * cut.pieces.y * cut.pieces.z;
    cuts_.push_back(cut);
  }
}

}  // namespace sluice
