#include "mpmice/geometry/occupied_cells.hpp"

#include <algorithm>

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
void OccupiedCells<D>::grow() {
  for (std::size_t n = 0; n < boxes_.size(); ++n) {
    for (int& lower : boxes_[n].lower) lower -= moves_[n];
    for (int& upper : boxes_[n].upper) upper += moves_[n];
  }
  moves_.assign(boxes_.size(), 0);
}

template <int D>
void OccupiedCells<D>::join(const BlockSharers<D>& sharers, int reach) {
  typename BlockSharers<D>::Buffers out(sharers.neighbour_count()), in;
  std::vector<std::uint8_t> wanted(out.size());
  for (const CellBox<D>& box : boxes_) {
    CellBox<D> near = box;
    for (int& lower : near.lower) lower -= reach;
    for (int& upper : near.upper) upper += reach;
    std::fill(wanted.begin(), wanted.end(), 0);
    for_each_cell_of<D>(BlockDirectory<D>::blocks_of(near), [&](const Cell<D>& block) {
      if (!sharers.has(block)) return;
      for (const int n : sharers.others(block)) wanted[static_cast<std::size_t>(n)] = 1;
    });
    for (std::size_t n = 0; n < out.size(); ++n)
      if (wanted[n] != 0)
        for (const Cell<D>& end : {box.lower, box.upper})
          out[n].insert(out[n].end(), end.begin(), end.end());
  }
  sharers.swap(out, in);
  for (const std::vector<double>& from : in)
    for (std::size_t at = 0; at < from.size(); at += 2 * D) {
      CellBox<D> box;
      for (std::size_t d = 0; d < D; ++d) {
        box.lower[d] = static_cast<int>(from[at + d]);
        box.upper[d] = static_cast<int>(from[at + D + d]);
      }
      boxes_.push_back(box);
    }
  moves_.assign(boxes_.size(), 0);
}

template class OccupiedCells<1>;
template class OccupiedCells<2>;
template class OccupiedCells<3>;

}  // namespace sluice::mpmice
