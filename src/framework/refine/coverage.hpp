// Which cells of a level lie under a finer one: they are its averages, and no total counts them.
#pragma once
#include <cstdint>
#include <vector>

#include "framework/grid/level.hpp"

namespace sluice {

class LevelCoverage {
 public:
  // `finer` may be null or without boxes: then nothing is covered. Local boxes are those of `rank`,
  // numbered as a Warehouse does.
  LevelCoverage() = default;
  LevelCoverage(const Level& level, const Level* finer, int rank);

  // Disjoint parts of a local box that no finer level covers.
  const std::vector<IndexBox>& uncovered(int box) const {
    return uncovered_[static_cast<std::size_t>(box)];
  }
  bool is_covered(int box, IntVec3 cell) const;
  bool any() const { return any_; }      // on any rank
  std::int64_t uncovered_cells() const;  // of this rank

 private:
  std::vector<std::vector<IndexBox>> covered_, uncovered_;  // by local box
  bool any_ = false;
};

}  // namespace sluice
