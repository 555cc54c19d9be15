// How far ahead of a cell its level ends, for what is done to a flow before it leaves.
//
// Counted in cells along an axis, either way: 1 for the last cell before the first one that the
// level lacks, 0 for what lies beyond (ghost cells), `depth` + 1 where the level goes on for more
// than `depth` cells. The edge of the domain is no end, except across a periodic side. Found from
// the boxes of all ranks, so that neither boxes nor ranks show; rows without an end ahead take no
// room.
#pragma once
#include <cstdint>
#include <vector>

#include "framework/grid/box_list.hpp"
#include "framework/grid/level.hpp"
#include "framework/task/row.hpp"

namespace sluice {

class InterfaceDistance {
 public:
  InterfaceDistance() = default;  // no ends anywhere
  // depth: by direction, below 255; 0: ends in that direction do not matter. Cells up to `ghosts`
  // layers around the boxes of `rank` can be asked for.
  InterfaceDistance(const Level& level, int rank, IntVec3 depth, int ghosts);

  bool empty() const { return bytes_.empty(); }
  int depth(int axis) const { return depth_[axes_.direction[axis]]; }
  // Of the cells of the row through `cell`, from `cell` on; null: none has an end ahead.
  const std::uint8_t* ahead(int box, int axis, bool high, IntVec3 cell) const;

 private:
  struct Rows {
    std::vector<std::int32_t> begin;  // by row: where in bytes_; -1: nowhere
  };
  void add_box(const Level& level, const BoxFinder& all, IndexBox box, IntVec3 depth, int ghosts);
  void add_side(const std::vector<IndexBox>& lacking, const IndexBox& cells, int axis, bool high,
                int depth);
  std::size_t row_of(const IndexBox& cells, IntVec3 cell) const;
  std::size_t row_count(const IndexBox& cells) const;

  Axes axes_;
  IntVec3 depth_;
  std::vector<IndexBox> boxes_;  // with ghosts
  std::vector<Rows> rows_;       // by box, axis, side
  std::vector<std::uint8_t> bytes_;
};

inline std::size_t InterfaceDistance::row_of(const IndexBox& cells, IntVec3 cell) const {
  std::size_t row = 0;
  for (int a = axes_.count - 1; a > 0; --a) {
    const int d = axes_.direction[a];
    row = row * cells.size()[d] + (cell[d] - cells.lower[d]);
  }
  return row;
}

inline const std::uint8_t* InterfaceDistance::ahead(int box, int axis, bool high,
                                                    IntVec3 cell) const {
  if (empty()) return nullptr;
  const Rows& r = rows_[(box * axes_.count + axis) * 2 + (high ? 1 : 0)];
  if (r.begin.empty()) return nullptr;
  const IndexBox& cells = boxes_[box];
  const std::int32_t begin = r.begin[row_of(cells, cell)];
  const int along = axes_.direction[0];
  return begin < 0 ? nullptr : bytes_.data() + begin + (cell[along] - cells.lower[along]);
}

}  // namespace sluice
