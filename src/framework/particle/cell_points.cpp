// Lattice, sequence and hash.
#include "framework/particle/cell_points.hpp"

#include <array>
#include <cmath>

#include "framework/geometry/sampling.hpp"

namespace sluice {
namespace {

// The mixing of SplitMix64 (Steele, Lea and Flood, 2014): a number in [0, 1).
double hashed_share(std::int64_t number) {
  std::uint64_t z = static_cast<std::uint64_t>(number) + 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-53;
}

// 1/g, 1/g^2, 1/g^3 for one, two and three directions.
std::array<double, 3> strides(int directions) {
  double g = 1.5;
  for (int n = 0; n < 64; ++n) g = std::pow(1 + g, 1.0 / (directions + 1));
  return {1 / g, 1 / (g * g), 1 / (g * g * g)};
}

// k where k^directions is the number; else 0.
int lattice_of(int number, int directions) {
  for (int k = 1; k <= number; ++k) {
    int power = 1;
    for (int d = 0; d < directions; ++d) power *= k;
    if (power == number) return k;
    if (power > number) return 0;
  }
  return 0;
}

}  // namespace

std::int64_t cell_number(const Level& level, IntVec3 cell) {
  const IntVec3 n = level.domain.size(), c = cell - level.domain.lower;
  return c.x + n.x * (c.y + static_cast<std::int64_t>(n.y) * c.z);
}

std::int64_t cell_count_of_domain(const Level& level) {
  return level.domain.volume();
}

CellPoints::CellPoints(const Level& level, double per_cell)
    : level_(&level),
      whole_(static_cast<int>(std::floor(per_cell))),
      share_(per_cell - std::floor(per_cell)) {
  if (share_ == 0) lattice_ = lattice_of(whole_, level.active_count());
}

int CellPoints::count(IntVec3 cell) const {
  return whole_ + (share_ > 0 && hashed_share(cell_number(*level_, cell)) < share_ ? 1 : 0);
}

Vec3 CellPoints::point(IntVec3 cell, int n) const {
  if (lattice_ == 0) return spread_point(*level_, cell, n);
  const CellLattice cells{level_->anchor, level_->spacing};
  Vec3 p = level_->centre(cell);
  for (int d = 0; d < 3; ++d) {
    if (!level_->active[d]) continue;
    p[d] = cells.sub_point(d, cell[d], n % lattice_, lattice_);
    n /= lattice_;
  }
  return p;
}

Vec3 spread_point(const Level& level, IntVec3 cell, std::int64_t n) {
  static const std::array<std::array<double, 3>, 3> by_directions = {strides(1), strides(2),
                                                                     strides(3)};
  if (level.active_count() == 0) return level.centre(cell);
  const auto& stride = by_directions[level.active_count() - 1];
  Vec3 p = level.centre(cell);
  std::size_t s = 0;
  for (int d = 0; d < 3; ++d) {
    if (!level.active[d]) continue;
    const double at = 0.5 + static_cast<double>(n + 1) * stride[s++];
    p[d] += (at - std::floor(at) - 0.5) * level.spacing[d];
  }
  return p;
}

}  // namespace sluice
