// Which cells of a level lie under a finer one: they are its averages, and no total counts them.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "framework/grid/level.hpp"

namespace sluice {

class LevelCoverage {
 public:
  // Cells first, first + 1, ... of a row (index along the row's direction).
  struct Segment {
    int first = 0, count = 0;
  };

  // `finer` may be null or without boxes: then nothing is covered. Local boxes are those of `rank`,
  // numbered as a Warehouse does.
  LevelCoverage() = default;
  LevelCoverage(const Level& level, const Level* finer, int rank);

  // Disjoint parts of a local box that no finer level covers.
  const std::vector<IndexBox>& uncovered(int box) const { return boxes_[box].uncovered; }
  // The same of the row through `cell`, along the first active direction, ascending: no search.
  std::span<const Segment> uncovered_in_row(int box, IntVec3 cell) const;
  // Cells outside the box are not.
  bool is_covered(int box, IntVec3 cell) const;
  // The same of cells around the box too, one layer, through periodic sides as well: whoever asks
  // about a cell, it has one answer.
  bool is_covered_around(int box, IntVec3 cell) const;
  bool any() const { return any_; }      // on any rank
  std::int64_t uncovered_cells() const;  // of this rank

 private:
  struct Box {
    IndexBox cells;
    std::vector<IndexBox> uncovered;
    std::vector<IndexBox> around;     // what is covered of the layer around, and some of the box
    Segment whole_row;                // of all rows where nothing of the box is covered
    std::vector<std::int32_t> begin;  // else, by row: its first segment; one more at the end
    std::vector<Segment> segments;
  };
  std::size_t row_number(const Box& box, IntVec3 cell) const;
  void list_rows(Box& box, std::vector<IndexBox>& pieces) const;  // `pieces`: room to work

  std::vector<Box> boxes_;  // local ones
  int along_ = 0;           // the direction of rows
  bool any_ = false;
};

}  // namespace sluice
