// Rows of a region in two arrays: most regions are strips of ghost cells, a few numbers a row.
#pragma once
#include <cstring>

#include "framework/field/array_view.hpp"

namespace sluice {

// Calls f(first number in `to`, first number in `from`, length) for every row of `region`, in the
// indices of `to`; `shift` leads to the cells of `from`.
template <class F>
void for_each_row(const RealView& to, const IndexBox& region, const RealView& from, IntVec3 shift,
                  F&& f) {
  if (region.empty()) return;
  const int along = to.stride[0] == 1 ? 0 : to.stride[1] == 1 ? 1 : 2;
  const int d = along == 0 ? 1 : 0, e = along == 2 ? 1 : 2;
  const IntVec3 n = region.size();
  double* const first_to = to.data + to.offset(region.lower);
  double* const first_from = from.data + from.offset(region.lower + shift);
  for (int k = 0; k < n[e]; ++k)
    for (int j = 0; j < n[d]; ++j)
      f(first_to + j * to.stride[d] + k * to.stride[e],
        first_from + j * from.stride[d] + k * from.stride[e], n[along]);
}

// Lengths that are known when this is compiled need no call.
inline void copy_row(double* to, const double* from, int n) {
  constexpr std::size_t one = sizeof(double);
  switch (n) {
    case 1:
      std::memcpy(to, from, one);
      return;
    case 2:
      std::memcpy(to, from, 2 * one);
      return;
    case 3:
      std::memcpy(to, from, 3 * one);
      return;
    case 4:
      std::memcpy(to, from, 4 * one);
      return;
    default:
      std::memcpy(to, from, n * one);
  }
}

// to = from at the cells of `region`.
inline void copy_region(const RealView& to, const IndexBox& region, const RealView& from,
                        IntVec3 shift) {
  for_each_row(to, region, from, shift, copy_row);
}

}  // namespace sluice
