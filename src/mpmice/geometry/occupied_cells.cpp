#include "mpmice/geometry/occupied_cells.hpp"

#include <cstring>
#include <string>

#include "framework/base/communicator.hpp"

namespace sluice::mpmice {
template <int D>
void OccupiedCells<D>::begin(const CellBox<D>& room) {
  room_ = room;
  directory_.begin(room);
  boxes_.clear();
}

template <int D>
void OccupiedCells<D>::add(const CellBox<D>& cells) {
  using Directory = BlockDirectory<D>;
  const CellBox<D> inside = common<D>(cells, room_);
  for_each_cell_of<D>(Directory::blocks_of(inside), [&](const Cell<D>& b) {
    std::int32_t& entry = directory_.entry(b);
    if (entry == 0) {
      boxes_.emplace_back();
      entry = static_cast<std::int32_t>(boxes_.size());
    }
    boxes_[static_cast<std::size_t>(entry - 1)].include(common<D>(inside, Directory::cells_of(b)));
  });
}

template <int D>
void OccupiedCells<D>::join(Communicator& ranks) {
  if (ranks.size() == 1) return;
  std::string mine(boxes_.size() * sizeof(CellBox<D>), '\0');
  if (!boxes_.empty()) std::memcpy(mine.data(), boxes_.data(), mine.size());
  boxes_.clear();
  for (const std::string& of_rank : ranks.gather_to_all(mine)) {
    const std::size_t before = boxes_.size();
    boxes_.resize(before + of_rank.size() / sizeof(CellBox<D>));
    if (!of_rank.empty()) std::memcpy(boxes_.data() + before, of_rank.data(), of_rank.size());
  }
}

template <int D>
CellBox<D> OccupiedCells<D>::hull() const {
  CellBox<D> all;
  for (const CellBox<D>& box : boxes_) all.include(box);
  return all;
}

template class OccupiedCells<1>;
template class OccupiedCells<2>;
template class OccupiedCells<3>;

}  // namespace sluice::mpmice
