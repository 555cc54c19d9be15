// Steps, and the starts of a row.
#include "framework/task/row_arrays.hpp"

namespace sluice {
namespace {

constexpr std::array<std::ptrdiff_t, Steps::size> unit_steps{-3, -2, -1, 0, 1, 2, 3};
static_assert(unit_steps[2 * max_reach] == max_reach);
constexpr std::array<std::ptrdiff_t, Steps::size> no_steps{};

std::size_t whole_vectors(std::size_t n) {
  constexpr std::size_t vector = 8;
  return (n + vector - 1) / vector * vector;
}

}  // namespace

void BoundArray::find_steps(bool middle_axis, Steps* steps) {
  middle_steps = steps;
  swept_steps = steps + 1;
  for (int shift = -max_reach; shift <= max_reach; ++shift) {
    steps[0].at(shift) = middle_axis ? shift * middle : 0;
    for (std::ptrdiff_t phase = 0; phase <= (mask < 0 ? 0 : mask); ++phase)
      steps[1 + phase].at(shift) = (((phase + shift) & mask) - phase) * swept;
  }
}

RowArrays::RowArrays(std::size_t accesses, int axes)
    : accesses_(accesses), swept_axis_(axes == 3 ? 2 : 1) {
  const std::size_t n = whole_vectors(accesses);
  origin_.resize(n);
  first_.resize(n);
  for (auto* v : {&component_, &middle_, &swept_, &mask_}) v->resize(n);
  phase_0_.resize(n);
  along_[0].assign(n, unit_steps.data() + max_reach);
  along_[1].assign(n, no_steps.data() + max_reach);
  along_[2].assign(n, no_steps.data() + max_reach);
  starts_ = {
      first_.data(), component_.data(), {along_[0].data(), along_[1].data(), along_[2].data()}};
}

// What fills up the last vector is as the last access.
void RowArrays::bind(std::size_t access, const BoundArray& array) {
  const std::size_t end = access + 1 < accesses_ ? access + 1 : first_.size();
  for (std::size_t n = access; n < end; ++n) {
    origin_[n] = array.first;
    component_[n] = array.component;
    middle_[n] = array.middle;
    swept_[n] = array.swept;
    mask_[n] = array.mask;
    phase_0_[n] = array.swept_steps->centre();
    if (swept_axis_ == 2) along_[1][n] = array.middle_steps->centre();
  }
}

template <bool middle_axis>
void RowArrays::find_starts(int i, int j, int plane) {
  const std::size_t count = first_.size();
  double* const* origin = origin_.data();
  const std::ptrdiff_t *middle = middle_.data(), *swept = swept_.data(), *mask = mask_.data();
  const std::ptrdiff_t* const* phase_0 = phase_0_.data();
  double** first = first_.data();
  const std::ptrdiff_t** steps = along_[swept_axis_].data();
#pragma GCC ivdep
  for (std::size_t n = 0; n < count; ++n) {
    const std::ptrdiff_t ring = plane & mask[n], phase = mask[n] < 0 ? 0 : ring;
    first[n] = origin[n] + (i + (middle_axis ? j * middle[n] : 0) + ring * swept[n]);
    steps[n] = phase_0[n] + phase * Steps::size;
  }
}

void RowArrays::start_row(int i, int j, int plane) {
  swept_axis_ == 2 ? find_starts<true>(i, j, plane) : find_starts<false>(i, j, plane);
}

}  // namespace sluice
