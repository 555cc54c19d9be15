// The cells near solids on a level, over which the coupling has its arrays: whose they are, how far
// the others lie from this rank's, and loops over them.
#pragma once
#include <memory>

#include "mpmice/fields/cell_masks.hpp"
#include "mpmice/fields/thread_ranges.hpp"
#include "mpmice/geometry/block_sharers.hpp"

namespace sluice::mpmice {

template <int D>
class NearCells {
 public:
  // From a rank's boxes cells are asked for: the pressure on walls in ghost layers of boxes (4) and
  // two layers of cells without fluid before them; states and amounts where the parts of own
  // particles lie and two layers before (both checked on ranks by every golden case).
  static constexpr int pressure_reach = 7, state_reach = 4, farthest_asked = pressure_reach + 1;

  explicit NearCells(const Level& level) : frame_(level) {}
  NearCells(const NearCells&) = delete;  // arrays refer to its blocks
  NearCells& operator=(const NearCells&) = delete;

  // Of a step: the cells in which solids lie are added to these, then arrays are laid around them.
  // `team`: the threads of this rank, which must live as long; null: one. `own`: this rank's boxes
  // of the level. Collective.
  OccupiedCells<D>& begin(const ThreadTeam* team = nullptr);
  void finish(const Level& level, const std::vector<GridBox>& own, Communicator& ranks);

  const Frame<D>& frame() const { return frame_; }
  const ThreadTeam& team() const { return *team_; }
  const OccupiedCells<D>& occupied() const { return occupied_; }
  // Null: this is the only rank.
  const BlockSharers<D>* sharers() const { return sharers_.get(); }
  std::size_t size() const { return frame_.cells.size(); }
  const CellMask& own() const { return own_; }
  bool owns(std::size_t i) const { return own_[i] != 0; }

  // act(cell, place in the arrays) for the cells of the domain near solids.
  template <class F>
  void for_each(F&& act) const {
    frame_.cells.for_each_cell(frame_.domain, act);
  }
  // Does a cell lie at most so many cells from this rank's boxes; the same as for_each() for these.
  bool within(std::size_t i, int reach) const { return distance_.empty() || distance_[i] <= reach; }
  template <class F>
  void for_each_within(int reach, F&& act) const {
    for_each([&](const Cell<D>& c, std::size_t i) {
      if (within(i, reach)) act(c, i);
    });
  }
  // The same as for_each(), by all threads: cells do not depend on each other.
  template <class F>
  void for_each_at_once(F&& act) const;
  // The same for those of this rank.
  template <class F>
  void for_each_own(F&& act) const {
    for_each([&](const Cell<D>& c, std::size_t i) {
      if (own_[i] != 0) act(c, i);
    });
  }
  // act(place): of the cells of the domain beside one; up to so many cells around it.
  template <class F>
  void for_each_neighbour(const Cell<D>& c, F&& act) const;
  template <class F>
  void for_each_around(const Cell<D>& c, int reach, F&& act) const {
    for_each_offset(c, reach, [&](std::size_t i, const std::array<int, D>&) { act(i); });
  }
  // act(place, cells from c, by direction): likewise.
  template <class F>
  void for_each_offset(const Cell<D>& c, int reach, F&& act) const;

 private:
  void share_blocks(const Level& level, Communicator& ranks);
  void mark_own(const std::vector<GridBox>& own, bool alone);

  Frame<D> frame_;
  const ThreadTeam* team_ = nullptr;
  std::unique_ptr<BlockSharers<D>> sharers_;
  OccupiedCells<D> occupied_;  // cells in which solids lie, or gaps that they keep
  CellMask own_;               // 1: cells of this rank's boxes
  // Of each cell from these, up to farthest_asked; 255: farther. Empty: this is the only rank.
  CellMask distance_;
};

template <int D>
template <class F>
void NearCells<D>::for_each_at_once(F&& act) const {
  const CellBlocks<D>& cells = frame_.cells;
  for_each_range(team(), cells.block_count(),
                 [&](std::size_t begin, std::size_t end, std::size_t, int) {
                   for (std::size_t b = begin + 1; b <= end; ++b)
                     cells.for_each_cell_of_block(b, frame_.domain, act);
                 });
}

template <int D>
template <class F>
void NearCells<D>::for_each_neighbour(const Cell<D>& c, F&& act) const {
  for (std::size_t d = 0; d < D; ++d)
    for (const int side : {-1, 1}) {
      Cell<D> other = c;
      other[d] += side;
      if (!frame_.in_domain(other)) {
        if (!frame_.periodic[d]) continue;
        other = frame_.inside(other);
      }
      act(frame_.cells.index(other));
    }
}

template <int D>
template <class F>
void NearCells<D>::for_each_offset(const Cell<D>& c, int reach, F&& act) const {
  const int width = 2 * reach + 1;
  int count = 1;
  for (int d = 0; d < D; ++d) count *= width;
  for (int n = 0; n < count; ++n) {
    Cell<D> other = c;
    std::array<int, D> offset{};
    for (int d = 0, rest = n; d < D; ++d, rest /= width) {
      offset[static_cast<std::size_t>(d)] = rest % width - reach;
      other[static_cast<std::size_t>(d)] += offset[static_cast<std::size_t>(d)];
    }
    bool there = true;
    for (std::size_t d = 0; d < D; ++d)
      there &= frame_.periodic[d] ||
               (other[d] >= frame_.domain.lower[d] && other[d] < frame_.domain.upper[d]);
    if (there) act(frame_.cells.index(frame_.inside(other)), offset);
  }
}

}  // namespace sluice::mpmice
