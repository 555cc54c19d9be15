// Which slices of a window, along its direction 2, each rank computes.
//
// A window lies in memory alike on every rank, so that places and colours of cells do not depend on
// the ranks; a rank fills and computes its own slices, and gets copies of the slices beside them.
// Small windows, and those of one slice, are whole on every rank: all compute the same.
#pragma once
#include <string>
#include <vector>

#include "framework/base/exact_sum.hpp"
#include "framework/solve/dense_shape.hpp"
#include "framework/solve/raw_memory.hpp"

namespace sluice::solve {

class Slabs {
 public:
  // Whole on every rank.
  explicit Slabs(const DenseShape& shape = {}) : bounds_{0, shape.count[2]} {}
  // Dealt out to the ranks of world(), where that pays.
  static Slabs slabs_of_ranks(const DenseShape& shape);
  // Of a coarser window that groups `ratio` slices: dealt out in the same way where the bounds
  // allow, so that a coarse slice has its fine ones on the same rank.
  Slabs coarsened(const DenseShape& coarse, int ratio) const;
  // The bounds of this, halved, whether it pays or not: what each rank has summed into a coarser
  // window that is to be whole.
  Slabs grouped(const DenseShape& coarse, int ratio) const;

  bool shared() const { return bounds_.size() > 2; }
  int begin() const;
  int end() const;
  int begin_of(int rank) const { return bounds_[rank]; }  // if shared

  // Collective, all below; without effect or communication where the window is whole.
  // The slices beside the own ones; in a periodic window that is whole, its ghosts.
  template <class T>
  void exchange(const DenseShape& shape, T* x) const;
  // All slices to all ranks.
  template <class T>
  void gather(const DenseShape& shape, T* x) const;
  // A number, of any unit as all below, for each slice.
  void gather_numbers(double* of_slices) const;
  double total(const ExactSum& own) const;
  double largest(double own) const;  // a NaN wins
  // What the lowest rank that has something to say says.
  std::string first(const std::string& own) const;

 private:
  template <class T>
  void gather_blocks(T* first, std::ptrdiff_t block) const;

  std::vector<int> bounds_;  // of the ranks, one after the other
};

// Collective: over all ranks of world().
double total_of_ranks(const ExactSum& own);

// place(c): the memory of the own slices and of those beside them, ghosts and all.
template <class F>
void for_places(const DenseShape& shape, const Slabs& slabs, F&& place) {
  const std::ptrdiff_t from = shape.deep() ? shape.at(-1, -1, slabs.begin() - 1) : 0;
  const std::ptrdiff_t to = shape.deep() ? shape.at(-1, -1, slabs.end() + 1) : shape.slice();
#pragma GCC ivdep
  for (std::ptrdiff_t c = from; c < to; ++c) place(c);
}

// Zero in these places; the others are not read.
template <class T>
RawVector<T> zeros(const DenseShape& shape, const Slabs& slabs) {
  RawVector<T> v(shape.size());
  for_places(shape, slabs, [&](std::size_t c) { v[c] = T{0}; });
  return v;
}

}  // namespace sluice::solve
