// Sums over facets in the cells of a box as exact integers: no bit depends on the order of facets,
// on threads or on ranks.
//
// A contribution c enters as round(c 2^56), finer than its own round-off, and sums are taken
// modulo 2^64. That is exact as long as the final sums are below 2^7, whatever passes between: a
// sum of N_d is a difference of the covered parts of two faces, one of T_d of theta and such a
// part, one of q or C a volume that solid sweeps, and all count no more than the bodies that
// overlap in a cell (times the cells that they move). A contribution is itself below 2^7: areas and
// moments of a piece in a cell are at most 1, and what corners may move in a step is limited
// (most_move).
#pragma once
#include <cstdint>
#include <vector>

#include "mpmice/geometry/periodic_sides.hpp"

namespace sluice {
class Communicator;
}

namespace sluice::mpmice {

inline constexpr double sum_unit = 0x1p56;
inline constexpr int most_move = 32;  // cells that a facet may reach in a step, along a direction
// Corners of particles of the domain lie at most so many cells beyond its sides.
inline constexpr int layers_beyond = 3;

inline std::uint64_t to_sum(double c) {
  return static_cast<std::uint64_t>(__builtin_llrint(c * sum_unit));
}
inline double from_sum(std::uint64_t sum) {
  return static_cast<double>(static_cast<std::int64_t>(sum)) * (1 / sum_unit);
}

// Collective: the smallest box around those of all ranks; empty ones count for nothing.
template <int D>
CellBox<D> box_of_all(const CellBox<D>& mine, Communicator& ranks);

// Lanes of integers over the cells of a box.
template <int D>
class CellSums {
 public:
  // All zero. Keeps its memory.
  void begin(const CellBox<D>& box, int lanes);
  // Cells that facets reach: must lie in the box (std::out_of_range).
  void reach(const CellBox<D>& cells);
  // Adds sums over the same box: of another thread.
  void merge(const CellSums& other);
  // Collective: all ranks have the same box and get the sums of all.
  void sum_over_ranks(Communicator& ranks);
  // The sums of cells beyond periodic sides join those of their images, and end as 0. Of one lane;
  // all of the box is reached then.
  void fold(const PeriodicSides<D>& sides, int lane);
  // Each cell gets the sum of itself and all cells above it along d: what is 0 beyond the high end
  // of every row follows from its differences.
  void add_from_above(int lane, int d);
  // Values of a lane into an array over the box, zero outside of reached().
  void values(int lane, std::vector<double>& to) const;

  int lanes() const { return cells_ > 0 ? static_cast<int>(sums_.size() / cells_) : 0; }
  const CellBox<D>& box() const { return box_; }
  const CellBox<D>& reached() const { return reached_; }
  std::uint64_t* lane(int i) { return sums_.data() + static_cast<std::size_t>(i) * cells_; }
  const std::uint64_t* lane(int i) const {
    return sums_.data() + static_cast<std::size_t>(i) * cells_;
  }

 private:
  CellBox<D> box_, reached_;
  std::size_t cells_ = 0;
  std::vector<std::uint64_t> sums_;
};

}  // namespace sluice::mpmice
