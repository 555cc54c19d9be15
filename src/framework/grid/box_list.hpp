// Sets of cells as lists of boxes: coarsening, refining, subtracting, finding overlaps.
#pragma once
#include <vector>

#include "framework/grid/index_box.hpp"

namespace sluice {

// The coarse cell that holds a fine one: division rounded down.
IntVec3 coarsen(IntVec3 fine_cell, IntVec3 ratio);
// The smallest box of coarse cells that holds all of `fine`; and all fine cells of `coarse`.
IndexBox coarsen(const IndexBox& fine, IntVec3 ratio);
IndexBox refine(const IndexBox& coarse, IntVec3 ratio);

// What is left of `box` without `hole`: at most six disjoint boxes.
std::vector<IndexBox> subtract(const IndexBox& box, const IndexBox& hole);
std::vector<IndexBox> subtract(std::vector<IndexBox> boxes, const std::vector<IndexBox>& holes);

// Finds the boxes that overlap a region without asking all (bins near the average box size).
class BoxFinder {
 public:
  explicit BoxFinder(std::vector<IndexBox> boxes);

  // Positions of the boxes that overlap `region`, ascending.
  std::vector<int> overlapping(const IndexBox& region) const;
  // The same, in place of what `found` held: its memory is kept.
  void find(const IndexBox& region, std::vector<int>& found) const;
  // `region` without all boxes.
  std::vector<IndexBox> uncovered(const IndexBox& region) const;
  bool covers(const IndexBox& region) const { return uncovered(region).empty(); }
  const std::vector<IndexBox>& boxes() const { return boxes_; }

 private:
  IntVec3 bin_of(IntVec3 cell) const;
  IndexBox bins_of(const IndexBox& region) const;
  std::size_t number(IntVec3 bin) const;
  std::vector<IndexBox> boxes_;
  IndexBox bounds_;
  IntVec3 shift_{}, bins_{1, 1, 1};   // a bin has 2^shift cells a direction
  std::vector<int> begin_, members_;  // by bin: its first member; one more at the end
};

}  // namespace sluice
