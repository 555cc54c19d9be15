// The bonds of a rank's points in rows of eight: bond k of eight points side by side.
//
// A chunk has up to eight own points that stand side by side in the columns, and rows. Row k holds
// of each point one neighbour with the length r of the bond (m) and its weight w, 0 where the point
// has none. Where the eight neighbours stand side by side too (on lattices nearly everywhere) a row
// names the first alone; else it names all eight. Each point adds its bonds in the order of the
// columns, which depends on neither boxes nor ranks; a weight of 0 adds nothing to any bit.
//
// A broken bond has the weight -0 from then on: it counts as one that has been.
#pragma once
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "framework/task/thread_team.hpp"
#include "peridynamics/bonds/bond_memory.hpp"
#include "peridynamics/points/point_table.hpp"

namespace sluice::peridynamics {

struct BondChunk {
  int first = 0;                     // entry of its first point
  int lanes = 8;                     // how many points
  std::uint32_t begin = 0, end = 0;  // rows
};

// The piece of work of a thread; its arrays lie in the memory of the families.
struct BondTile {
  std::vector<BondChunk> chunks;
  std::span<const std::int32_t> base;   // of a row: entry of the first neighbour; below 0: index
  std::span<const std::int32_t> index;  // eight entries of row ~base
  std::span<const double> r;
  std::span<float> w;

  std::size_t rows() const { return base.size(); }
  int neighbour(std::size_t row, int lane) const {
    const std::size_t l = static_cast<std::size_t>(lane);
    const std::int32_t b = base[row];
    return b >= 0 ? b + lane : index[8 * static_cast<std::size_t>(~b) + l];
  }
  // Of a lane of a row: is there a bond, intact or broken.
  bool has_bond(std::size_t row, int lane) const {
    const float weight = w[8 * row + static_cast<std::size_t>(lane)];
    return weight > 0 || std::signbit(weight);
  }
  bool intact(std::size_t row, int lane) const {
    return w[8 * row + static_cast<std::size_t>(lane)] > 0;
  }
};

// Sums over families as they were at the start, bonds that pre-cracks cut included.
struct FamilySums {
  Column m;       // sum w r^2 V
  Column s;       // sum w r V
  Column volume;  // sum beta V
  Column intact;  // the same without broken bonds and those that pre-cracks cut
  std::vector<std::int32_t> neighbours;  // intact
};

struct Families {
  std::vector<BondTile> tiles;
  std::vector<BondMemory> memory;  // of each thread
  FamilySums sums;
  std::int64_t bonds = 0;  // directed
  std::int64_t cut = 0;    // by pre-cracks, directed
  int largest = 0;

  std::size_t bytes() const;
};

// InputError names two points at one place.
Families find_families(const PointTable& points, const PeriScene& scene, const ThreadTeam* team);

// Does the bond between two places cross it; `margin` widens it (m).
bool crosses(const PreCrack& crack, Vec3 a, Vec3 b, double margin);

}  // namespace sluice::peridynamics
