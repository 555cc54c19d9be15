// Where what a task reads and writes lies in memory, and where a row of it begins.
//
// Coordinates are those of windows: axis 0 (unit stride), middle axis (3-D only), swept axis (2-D
// and 3-D).
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "framework/task/row.hpp"

namespace sluice {

// How far the cells are that lie so many cells along an axis.
class Steps {
 public:
  static constexpr int size = 2 * max_reach + 2;  // one more makes it as long as a cache line

  std::ptrdiff_t& at(int shift) { return steps_[shift + max_reach]; }
  const std::ptrdiff_t* centre() const { return steps_.data() + max_reach; }

 private:
  std::array<std::ptrdiff_t, size> steps_{};
};

// One variable as it is bound for one block.
struct BoundArray {
  double* first = nullptr;               // where component 0 of cell (0, 0, 0) would lie
  std::ptrdiff_t component = 0;          // from one component to the next
  std::ptrdiff_t middle = 0, swept = 0;  // strides
  std::ptrdiff_t mask = -1;              // of temporaries: ring of planes, plane & mask
  const Steps *middle_steps = nullptr, *swept_steps = nullptr;

  // Fills `steps`: those of the middle axis (none there: zeros), then those of the swept axis in
  // every phase of the ring, which is one where there is none.
  void find_steps(bool middle_axis, Steps* steps);
  static std::size_t count_of_steps(int planes) { return 1 + planes; }
};

// The accesses of one task side by side, in whole vectors: rows begin by the thousand.
class RowArrays {
 public:
  RowArrays(std::size_t accesses, int axes);
  RowArrays(RowArrays&&) = default;
  void bind(std::size_t access, const BoundArray& array);
  void start_row(int i, int j, int plane);
  const RowStarts& starts() const { return starts_; }

 private:
  template <bool middle_axis>
  void find_starts(int i, int j, int plane);

  std::vector<double*> origin_, first_;
  std::vector<std::ptrdiff_t> component_, middle_, swept_, mask_;
  std::vector<const std::ptrdiff_t*> phase_0_;  // steps along the swept axis
  std::vector<const std::ptrdiff_t*> along_[3];
  std::size_t accesses_;
  int swept_axis_;  // 1 or 2
  RowStarts starts_;
};

}  // namespace sluice
