// The cells that something occupies: by block of cells, the smallest box around them.
#pragma once
#include <vector>

#include "mpmice/geometry/cell_blocks.hpp"

namespace sluice::mpmice {

template <int D>
class OccupiedCells {
 public:
  // None, and room for these cells: what lies beyond is left out. Keeps its memory.
  void begin(const CellBox<D>& room);
  void add(const CellBox<D>& cells);
  // Collective: those of all ranks, in any order.
  void join(Communicator& ranks);
  // Each lies in one block; a block has one for every rank that has cells there.
  const std::vector<CellBox<D>>& boxes() const { return boxes_; }
  // Around all of them.
  CellBox<D> hull() const;

 private:
  CellBox<D> room_;
  BlockDirectory<D> directory_;  // of a block: 1 + the number of its box
  std::vector<CellBox<D>> boxes_;
};

}  // namespace sluice::mpmice
