// Which ranks have which blocks of cells: those near their own boxes. A block near boxes of several
// ranks is shared: what one adds there goes to the others.
#pragma once
#include <vector>

#include "mpmice/geometry/block_directory.hpp"
#include "mpmice/geometry/periodic_sides.hpp"

namespace sluice {
class Communicator;
}

namespace sluice::mpmice {

template <int D>
struct RankBox {
  CellBox<D> cells;
  int rank = 0;

  friend bool operator==(const RankBox&, const RankBox&) = default;
};

template <int D>
class BlockSharers {
 public:
  // A rank has the blocks that lie within so many cells of its boxes, also across periodic sides:
  // what its own cells, its particles and the ghost layers of its boxes ask for in a step follows
  // from these (docs/developer_guide.md, "Coupled runs on ranks").
  static constexpr int surroundings = 12;

  // The boxes of a level, of all ranks; `sides`: its periodic ones; `room`: cells that may have
  // blocks at all.
  BlockSharers(std::vector<RankBox<D>> boxes, const PeriodicSides<D>& sides, const CellBox<D>& room,
               const Communicator& ranks);
  bool fits(const std::vector<RankBox<D>>& boxes) const { return boxes == boxes_; }

  // Has this rank a block.
  bool has(const Cell<D>& block) const { return directory_.find(block) != 0; }
  // The neighbours that have it too, by their number, of one that this rank has.
  const std::vector<int>& others(const Cell<D>& block) const {
    return sets_[static_cast<std::size_t>(directory_.find(block) - 1)];
  }
  // The cells of all blocks that this rank has, block by block.
  std::vector<CellBox<D>> cells() const;
  std::size_t neighbour_count() const { return neighbours_.size(); }

  // Collective among neighbours: what goes to each and comes from each. Keeps the memory of both.
  using Buffers = std::vector<std::vector<double>>;
  void swap(const Buffers& out, Buffers& in) const;
  // The same where both sides know the sizes: as many numbers come as `in` has room for. Nothing
  // goes to or comes from those for whom there is nothing.
  void swap_alike(const Buffers& out, Buffers& in) const;

 private:
  std::vector<CellBox<D>> surroundings_of(const CellBox<D>& box) const;

  std::vector<RankBox<D>> boxes_;
  PeriodicSides<D> sides_;
  CellBox<D> room_;
  int own_ = 0;                         // this rank
  BlockDirectory<D> directory_;         // of a block: 1 + the number of its set
  std::vector<std::vector<int>> sets_;  // of numbers of neighbours
  std::vector<int> neighbours_;         // ranks
};

}  // namespace sluice::mpmice
