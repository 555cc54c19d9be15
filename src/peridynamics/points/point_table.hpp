// The points of a rank and those near them, side by side: columns in one order.
//
// Points stand in the order of rows of the reference state: bins of the smallest spacing along z,
// then y, then x, then ids. On a lattice the neighbours of points side by side then are side by
// side as well. Own points and images (of other ranks, across periodic sides, mirrored at
// symmetric sides) stand in the same order; `margin` empty entries lie before and behind, so that
// eight numbers may be read beyond the ends. Lengths in m, volumes in m^3.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/base/aligned_vector.hpp"
#include "peridynamics/deck/peri_scene.hpp"
#include "peridynamics/points/bond_rule.hpp"
#include "peridynamics/points/ghosts.hpp"

namespace sluice::peridynamics {

using Column = AlignedVector<double>;
using Columns3 = std::array<Column, 3>;

class PointTable {
 public:
  static constexpr int margin = 8;

  // Of this rank's points. Collective.
  void build(const std::vector<OwnPoint>& own, const Level& level, const PeriScene& scene,
             Communicator& ranks);

  int size() const { return static_cast<int>(id.size()); }  // with margins
  std::size_t own_count() const { return own_count_; }
  bool is_own(int i) const { return own_[static_cast<std::size_t>(i)] != 0; }
  // Entry of each own point, as they were given.
  const std::vector<int>& entries() const { return entries_; }
  Ghosts& ghosts() { return ghosts_; }
  bool has_ghosts() const { return ghosts_.any(); }

  Columns3 X;                 // reference place; 0 along directions that are none of the run
  Column V, spacing;          // volume, dx = (V/h)^(1/d)
  std::vector<int> material;  // -1: none, of the margins
  std::vector<std::int64_t> id;
  double largest_reach = 0;     // of any family, all ranks
  double bin = 0;               // the smallest spacing of all ranks
  std::array<double, 3> low{};  // of all places

  // The bin of a place along a direction.
  int bin_of(double x, int d) const;

 private:
  struct Entry;
  void put(const std::vector<Entry>& entries);

  std::vector<unsigned char> own_;
  std::size_t own_count_ = 0;
  std::vector<int> entries_;
  Ghosts ghosts_;
};

}  // namespace sluice::peridynamics
