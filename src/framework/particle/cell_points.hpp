// Where new particles stand in a cell, and how many of them.
//
// Numbers k^D (D: active directions) stand on a lattice of k sub-points a direction; others on a
// sequence that fills the cell evenly whatever its length: point n is frac(1/2 + (n + 1) a_d) along
// the d-th active direction, a_d = g^-(d + 1), g the positive root of g^(D+1) = g + 1 (Roberts'
// generalisation of the golden section). What a number has beyond its whole part is the share of
// cells, chosen by a hash of their index, that get one more. Points in m.
#pragma once
#include <cstdint>

#include "framework/grid/level.hpp"

namespace sluice {

// Position of a cell among all of its level's domain, x fastest.
std::int64_t cell_number(const Level& level, IntVec3 cell);
std::int64_t cell_count_of_domain(const Level& level);

class CellPoints {
 public:
  CellPoints(const Level& level, double per_cell);

  int most() const { return whole_ + (share_ > 0 ? 1 : 0); }
  int count(IntVec3 cell) const;
  Vec3 point(IntVec3 cell, int n) const;

 private:
  const Level* level_;
  int whole_ = 0;
  double share_ = 0;
  int lattice_ = 0;  // sub-points a direction; 0: the sequence
};

// Point n of the sequence in a cell.
Vec3 spread_point(const Level& level, IntVec3 cell, std::int64_t n);

}  // namespace sluice
