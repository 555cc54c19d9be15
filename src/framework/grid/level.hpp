// Levels, the boxes that tile them, and the hierarchy of levels.
//
// A *box* is the unit of storage (one array with ghost cells, owned by one rank). Results never
// depend on how a level is cut into boxes. Cell i of direction d has its centre at
// anchor[d] + (i + 1/2) spacing[d] on every level; the anchor is the low corner of level 0. Lengths
// are in m, volumes in m^3.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/grid/index_box.hpp"

namespace sluice {

struct GridBox {
  IndexBox cells;  // interior cells, without ghosts
  int owner = 0;   // rank
  int id = 0;      // position in Level::boxes
};

struct Level {
  int index = 0;
  Vec3 anchor{};                                 // length
  Vec3 spacing{1, 1, 1};                         // length
  IndexBox domain;                               // all cells of the physical domain
  std::array<bool, 3> periodic{};                // per direction
  std::array<bool, 3> active{true, true, true};  // false: not a dimension of this run
  IntVec3 ratio{1, 1, 1};                        // refinement against the coarser level
  std::vector<GridBox> boxes;

  Vec3 centre(IntVec3 c) const {
    return {anchor.x + (c.x + 0.5) * spacing.x, anchor.y + (c.y + 0.5) * spacing.y,
            anchor.z + (c.z + 0.5) * spacing.z};
  }
  double cell_volume() const { return spacing.x * spacing.y * spacing.z; }
  std::int64_t cell_count() const {
    std::int64_t n = 0;
    for (const GridBox& b : boxes) n += b.cells.volume();
    return n;
  }
  int active_count() const { return active[0] + active[1] + active[2]; }
  // Ghost layers of width `width`: none in a direction that is not active.
  IntVec3 ghosts(int width) const {
    return {active[0] ? width : 0, active[1] ? width : 0, active[2] ? width : 0};
  }
};

struct Grid {
  std::vector<Level> levels;  // coarse to fine

  std::int64_t cell_count() const {
    std::int64_t n = 0;
    for (const Level& l : levels) n += l.cell_count();
    return n;
  }
};

// Cuts `domain` into pieces[d] boxes a direction, cell ranges [N i / P, N (i+1) / P) with z
// fastest, as the peer numbers its patches.
std::vector<IndexBox> split(const IndexBox& domain, IntVec3 pieces);

// Deals boxes out to ranks along a Morton curve so that every rank gets a like number of cells, and
// at least one box where there are as many boxes as ranks.
void assign_owners(std::vector<GridBox>& boxes, int ranks);
// The same by cost, one number a box in any unit (measured seconds, say). Costs that are not
// positive count as nothing; without any, cells decide. Every rank must pass the same costs.
void assign_owners(std::vector<GridBox>& boxes, const std::vector<double>& costs, int ranks);
// Cost of the busiest rank over the mean of all: 1 is perfect.
double imbalance(const std::vector<GridBox>& boxes, const std::vector<double>& costs, int ranks);

}  // namespace sluice
