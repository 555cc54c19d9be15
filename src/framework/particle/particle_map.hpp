// Where on the levels a position (m) lives: in the box of the finest level that holds its cell.
#pragma once
#include <vector>

#include "framework/grid/box_list.hpp"
#include "framework/grid/level.hpp"

namespace sluice {

// The cell of a level that holds a point; a direction that is not active has one cell.
IntVec3 cell_at(const Level& level, Vec3 point);

class ParticleMap {
 public:
  struct Home {
    int level = -1;  // none: outside every box
    int box = -1;    // its id
    int owner = -1;
  };

  ParticleMap() = default;
  // Of levels coarse to fine, as they are now.
  explicit ParticleMap(std::vector<Level> levels);

  const std::vector<Level>& levels() const { return levels_; }
  Home find(Vec3 point) const;
  // Is this box the home of a point: without a search, unless a finer level begins in the box.
  bool is_home(int level, int box, Vec3 point) const;
  // The other ranks, rising, that own boxes within `reach` cells of the coarsest level from boxes
  // of a rank, on any level and across periodic sides: each is near those that are near to it.
  std::vector<int> ranks_near(int rank, int reach) const;

 private:
  void add_ranks_near(std::size_t level, const IndexBox& grown, std::vector<int>& ranks) const;

  std::vector<Level> levels_;
  std::vector<BoxFinder> finders_;
  // By level and box: finer boxes that overlie a part of it.
  std::vector<std::vector<std::vector<IndexBox>>> finer_;
};

}  // namespace sluice
