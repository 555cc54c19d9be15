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
  moves_.clear();
}

template <int D>
void OccupiedCells<D>::add(const CellBox<D>& cells, int move) {
  using Directory = BlockDirectory<D>;
  const CellBox<D> inside = common<D>(cells, room_), blocks = Directory::blocks_of(inside);
  for_each_cell_of<D>(blocks, [&](const Cell<D>& b) {
    if (boxes_.empty() || b != last_) {
      std::int32_t& entry = directory_.entry(b);
      if (entry == 0) {
        boxes_.emplace_back();
        moves_.push_back(0);
        entry = static_cast<std::int32_t>(boxes_.size());
      }
      last_ = b;
      number_of_last_ = static_cast<std::size_t>(entry - 1);
    }
    boxes_[number_of_last_].include(common<D>(inside, Directory::cells_of(b)));
    moves_[number_of_last_] = std::max(moves_[number_of_last_], move);
  });
}

template <int D>
void OccupiedCells<D>::join(Communicator& ranks) {
  for (std::size_t n = 0; n < boxes_.size(); ++n) {
    for (int& lower : boxes_[n].lower) lower -= moves_[n];
    for (int& upper : boxes_[n].upper) upper += moves_[n];
  }
  moves_.assign(boxes_.size(), 0);
  if (ranks.size() == 1) return;
  std::string mine(boxes_.size() * sizeof(CellBox<D>), '\0');
  if (!boxes_.empty()) std::memcpy(mine.data(), boxes_.data(), mine.size());
  boxes_.clear();
  for (const std::string& of_rank : ranks.gather_to_all(mine)) {
    const std::size_t before = boxes_.size();
    boxes_.resize(before + of_rank.size() / sizeof(CellBox<D>));
    if (!of_rank.empty()) std::memcpy(boxes_.data() + before, of_rank.data(), of_rank.size());
  }
  moves_.assign(boxes_.size(), 0);
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
