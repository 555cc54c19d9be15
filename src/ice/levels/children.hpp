// The fine cells of a coarse one: how many, in which order they are summed, and lines of cells.
//
// Sums are taken in halves: the two halves of a cell along one axis, the four along two axes
// crosswise, the eight along three axes corner to opposite corner, and these in halves again.
// Mirrored children give the same bits, in 2-D also children with their axes exchanged.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "framework/refine/transfer_operators.hpp"
#include "framework/task/row.hpp"

namespace sluice::ice {

// to[i] = from[i * step], of any quantity.
inline void copy_strided(const double* __restrict from, std::ptrdiff_t step, int n,
                         double* __restrict to) {
  // Known when it is compiled: vectors are loaded and sorted.
  if (step == 2)
    for (int i = 0; i < n; ++i) to[i] = from[2 * i];
  else if (step == 4)
    for (int i = 0; i < n; ++i) to[i] = from[4 * i];
  else
    for (int i = 0; i < n; ++i) to[i] = from[i * step];
}

// Between two states in time, as blend_state does.
inline double blended(double a, double b, double share) {
  return (1 - share) * a + share * b;
}

// to[i] = a[i * step] and b[i * step], blended.
inline void blend_strided(const double* a, const double* b, double share, std::ptrdiff_t step,
                          int n, double* __restrict to) {
  if (step == 1)
    for (int i = 0; i < n; ++i) to[i] = blended(a[i], b[i], share);
  else
    for (int i = 0; i < n; ++i) to[i] = blended(a[i * step], b[i * step], share);
}

class Children {
 public:
  static constexpr int most = 64;
  static constexpr int max_in(int axes) { return 1 << 2 * axes; }

  // std::logic_error for a ratio other than 1, 2 or 4.
  explicit Children(const TransferGeometry& geometry);

  const Axes& axes() const { return axes_; }
  int count() const { return ratio_[0] * ratio_[1] * ratio_[2]; }
  int ratio(int axis) const { return ratio_[axis]; }
  // Position of a child along an axis: 0 .. ratio - 1.
  int place(int child, int axis) const {
    if (axis == 0) return child % ratio_[0];
    return axis == 1 ? child / ratio_[0] % ratio_[1] : child / (ratio_[0] * ratio_[1]);
  }
  // The child at a position.
  int number(int x, int y, int z) const { return x + ratio_[0] * (y + ratio_[1] * z); }
  // Of its centre from the coarse cell's, in coarse cells.
  double offset(int child, int axis) const {
    const int r = ratio_[axis];
    return (2 * place(child, axis) + 1 - r) / (2.0 * r);
  }

  // rows[child] = that child of each of n coarse cells from `first` on along level direction
  // `along`.
  template <int D, int Width>
  void gather(const RealView& fine, int along, IntVec3 first, int n, double (*rows)[Width],
              int place_in_rows = 0) const {
    std::ptrdiff_t step = 0;
    IntVec3 corner = first;
    for (int a = 0; a < D; ++a) {
      const int d = axes_.direction[a];
      corner[d] = first[d] * ratio_[a];
      if (d == along) step = fine.stride[d] * ratio_[a];
    }
    for (int child = 0; child < count(); ++child) {
      IntVec3 cell = corner;
      for (int a = 0; a < D; ++a) cell[axes_.direction[a]] += place(child, a);
      copy_strided(fine.data + fine.offset(cell), step, n, rows[child] + place_in_rows);
    }
  }

  // rows[0] = mean of the rows of all children, over n cells; the other rows are lost.
  template <int Width>
  void mean(double (*rows)[Width], int n) const {
    for (int s = 0; s < sums_; ++s) {
      double* __restrict to = rows[sum_[s].to];
      const double* __restrict from = rows[sum_[s].from];
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) to[i] += from[i];
    }
    const double share = 1.0 / count();
    double* to = rows[0];
    for (int i = 0; i < n; ++i) to[i] *= share;
  }

 private:
  struct Sum {
    std::uint8_t to, from;
  };
  void add_block(std::array<int, 3> low, std::array<int, 3> size);
  void add(int to, int from);

  Axes axes_;
  int ratio_[3] = {1, 1, 1};  // by axis
  int sums_ = 0;
  std::array<Sum, most - 1> sum_{};
};

// Part of a line of cells of some region: `count` from `first` on, as numbers place, place + 1, ...
// of a batch.
struct LinePart {
  std::size_t region = 0;
  int along = 0;  // level direction of the line
  IntVec3 first;
  int count = 0, place = 0;
};

// Cells of several lines that are computed together: boxes, and still more the strips around them,
// may be too narrow to fill vectors line by line.
template <int Width>
class Batch {
 public:
  // Adds the cells of a box in lines along level direction `along`; calls f(batch) whenever the
  // batch is full.
  template <class F>
  void add(std::size_t region, const IndexBox& cells, int along, F&& f) {
    IndexBox starts = cells;
    starts.upper[along] = starts.lower[along] + 1;
    for_each_cell(starts, [&](IntVec3 first) {
      while (first[along] < cells.upper[along]) {
        const int left = cells.upper[along] - first[along];
        const int taken = left < Width - size_ ? left : Width - size_;
        parts_[count_++] = {region, along, first, taken, size_};
        first[along] += taken;
        size_ += taken;
        if (size_ == Width) flush(f);
      }
    });
  }
  template <class F>
  void flush(F&& f) {
    if (size_ > 0) f(*this);
    count_ = size_ = 0;
  }

  std::span<const LinePart> parts() const {
    return {parts_.data(), static_cast<std::size_t>(count_)};
  }
  // Whole vectors: loops over so many cells have no remainder. repeat_last() fills what is beyond.
  int padded() const { return (size_ + vector - 1) / vector * vector; }
  void repeat_last(double* row) const {
    for (int i = size_; i < padded(); ++i) row[i] = row[size_ - 1];
  }

 private:
  static constexpr int vector = 8;
  static_assert(Width % vector == 0);
  int count_ = 0, size_ = 0;
  std::array<LinePart, Width> parts_;
};

// Calls f(first cell, count) for pieces of at most `width` cells of the lines along level direction
// `along` that fill the box.
template <class F>
void for_each_line(const IndexBox& cells, int along, int width, F&& f) {
  IndexBox starts = cells;
  starts.upper[along] = starts.lower[along] + 1;
  for_each_cell(starts, [&](IntVec3 start) {
    for (IntVec3 first = start; first[along] < cells.upper[along]; first[along] += width) {
      const int left = cells.upper[along] - first[along];
      f(first, left < width ? left : width);
    }
  });
}

// The level direction along which a box is longest; the first active one of equals.
int longest_direction(const IndexBox& cells, const Axes& axes);

}  // namespace sluice::ice
