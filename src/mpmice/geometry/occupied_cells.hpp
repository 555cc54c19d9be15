// The cells that something occupies: by block of cells, the smallest box around them, grown by as
// many cells as the fastest in the block may move.
#pragma once
#include <vector>

#include "mpmice/geometry/cell_blocks.hpp"

namespace sluice::mpmice {

template <int D>
class OccupiedCells {
 public:
  // None, and room for these cells: what lies beyond is left out. Keeps its memory.
  void begin(const CellBox<D>& room);
  // `move`: by so many cells it may leave them.
  void add(const CellBox<D>& cells, int move = 0);
  // Once all are added: grows the boxes.
  void grow();
  // Collective among neighbours: then those of others too whose surroundings, so many cells wide,
  // meet blocks that this rank has, in any order.
  void join(const BlockSharers<D>& sharers, int reach);
  // One for each block and rank that has cells there.
  const std::vector<CellBox<D>>& boxes() const { return boxes_; }

 private:
  CellBox<D> room_;
  BlockDirectory<D> directory_;  // of a block: 1 + the number of its box
  std::vector<CellBox<D>> boxes_;
  std::vector<int> moves_;  // of each box
  // The block of the last call: particles that follow each other are in one mostly.
  Cell<D> last_{};
  std::size_t number_of_last_ = 0;  // of its box
};

}  // namespace sluice::mpmice
