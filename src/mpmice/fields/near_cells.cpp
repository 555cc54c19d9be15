#include "mpmice/fields/near_cells.hpp"

#include "framework/base/communicator.hpp"

namespace sluice::mpmice {

template <int D>
OccupiedCells<D>& NearCells<D>::begin(const ThreadTeam* team) {
  static const ThreadTeam alone;
  team_ = team != nullptr ? team : &alone;
  occupied_.begin(frame_.room());
  return occupied_;
}

template <int D>
void NearCells<D>::finish(const Level& level, const std::vector<GridBox>& own,
                          Communicator& ranks) {
  occupied_.grow();
  const bool alone = ranks.size() == 1;
  if (!alone) {
    share_blocks(level, ranks);
    occupied_.join(*sharers_, Frame<D>::reach);
  }
  frame_.look_at(occupied_, sharers_.get());
  mark_own(own, alone);
}

// Who shares blocks follows from the boxes of the level.
template <int D>
void NearCells<D>::share_blocks(const Level& level, Communicator& ranks) {
  std::vector<RankBox<D>> boxes = boxes_of_ranks<D>(frame_, level);
  if (sharers_ == nullptr || !sharers_->fits(boxes))
    sharers_ = std::make_unique<BlockSharers<D>>(std::move(boxes), frame_.all_sides(),
                                                 frame_.room(), ranks);
}

// Cells of this rank's boxes: books count no others. And how far all others lie from these, as far
// as any stage asks.
template <int D>
void NearCells<D>::mark_own(const std::vector<GridBox>& own, bool alone) {
  own_.assign(size(), 0);
  for (const GridBox& box : own)
    frame_.for_each_held(box.cells, [&](IntVec3, std::size_t i) { own_[i] = 1; });
  distance_.clear();
  if (alone) return;
  constexpr std::uint8_t beyond = 255;
  distance_.assign(size(), beyond);
  CellMask within = own_;
  for (std::uint8_t reach = 0; reach <= farthest_asked; ++reach) {
    if (reach > 0) dilate(frame_, 1, within);
    for (std::size_t i = 0; i < within.size(); ++i)
      if (within[i] != 0 && distance_[i] == beyond) distance_[i] = reach;
  }
}

template class NearCells<1>;
template class NearCells<2>;
template class NearCells<3>;

}  // namespace sluice::mpmice
