// Boxes cut into blocks by a lattice each, and the blocks that a region meets, without a search.
#pragma once
#include <algorithm>
#include <vector>

#include "framework/grid/level.hpp"

namespace sluice {

class BlockLattice {
 public:
  BlockLattice() = default;
  // Blocks no larger than `extents`, numbered box by box in the order of split().
  BlockLattice(const std::vector<GridBox>& boxes, IntVec3 extents);

  int size() const { return size_; }
  IntVec3 extents() const { return extents_; }  // as given; 0 without a lattice

  // Calls f(block number, its cells) for the blocks of box `b` that overlap `region` until it
  // returns true; whether it did.
  template <class F>
  bool any_block(int b, const IndexBox& region, F&& f) const {
    const Cut& cut = cuts_[b];
    const IndexBox inside = intersection(region, cut.box);
    if (inside.empty()) return false;
    IntVec3 first, last;
    for (int d = 0; d < 3; ++d) {
      first[d] = cut.part(d, inside.lower[d]);
      last[d] = cut.part(d, inside.upper[d] - 1);
    }
    for (int i = first.x; i <= last.x; ++i)
      for (int j = first.y; j <= last.y; ++j)
        for (int k = first.z; k <= last.z; ++k)
          if (f(cut.first + (i * cut.pieces.y + j) * cut.pieces.z + k, cut.block({i, j, k})))
            return true;
    return false;
  }

 private:
  struct Cut {
    IndexBox box;
    IntVec3 pieces{};
    int first = 0;  // number of its first block

    int edge(int d, int part) const {
      return box.lower[d] +
             static_cast<int>(static_cast<std::int64_t>(box.size()[d]) * part / pieces[d]);
    }
    // The last part that begins at cell i or before it.
    int part(int d, int i) const {
      const std::int64_t cells = i - box.lower[d] + 1;
      return static_cast<int>((cells * pieces[d] - 1) / box.size()[d]);
    }
    IndexBox block(IntVec3 n) const {
      return {{edge(0, n.x), edge(1, n.y), edge(2, n.z)},
              {edge(0, n.x + 1), edge(1, n.y + 1), edge(2, n.z + 1)}};
    }
  };
  std::vector<Cut> cuts_;  // by box
  IntVec3 extents_{};
  int size_ = 0;
};

}  // namespace sluice
