// Sums over facets in the cells of blocks as exact integers: no bit depends on the order of facets,
// on threads or on ranks.
//
// A contribution c enters as round(c 2^56), finer than its own round-off, and sums are taken
// modulo 2^64. That is exact as long as the final sums are below 2^7, whatever passes between: a
// sum of N_d is a difference of the covered parts of two faces, one of T_d of theta and such a
// part, one of C a volume that solid sweeps, and all count no more than the bodies that overlap in
// a cell (times the cells that they move). A contribution is itself below 2^7: areas and
// moments of a piece in a cell are at most 1, and what corners may move in a step is limited
// (most_move).
#pragma once
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "mpmice/geometry/cell_blocks.hpp"
#include "mpmice/geometry/periodic_sides.hpp"

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

// Lanes of integers over the cells of blocks.
template <int D>
class CellSums {
 public:
  // All zero. Keeps its memory, and a reference to the blocks.
  void begin(const CellBlocks<D>& cells, int lanes);
  // Adds sums over the same blocks: of another thread.
  void merge(const CellSums& other);
  // Collective among the ranks that share blocks: each gets the sums of all in its own. Throws
  // std::logic_error where blocks have no sharers on several ranks.
  void sum_over_ranks(Communicator& ranks);
  // The sums of cells beyond periodic sides join those of their images, and end as 0. Of one lane.
  void fold(const PeriodicSides<D>& sides, int lane);
  // Values of a lane into an array over the cells.
  void values(int lane, KeptArray<double>& to) const;

  int lanes() const { return lanes_; }
  const CellBlocks<D>& cells() const { return *cells_; }
  std::uint64_t* lane(int i) { return sums_.data() + static_cast<std::size_t>(i) * count_; }
  const std::uint64_t* lane(int i) const {
    return sums_.data() + static_cast<std::size_t>(i) * count_;
  }

 private:
  const CellBlocks<D>* cells_ = nullptr;
  std::size_t count_ = 0;
  int lanes_ = 0;
  KeptArray<std::uint64_t> sums_;
};

// The same of several sums over the same blocks, in one round of messages.
template <int D>
void share_sums(std::initializer_list<CellSums<D>*> all, Communicator& ranks);

}  // namespace sluice::mpmice
