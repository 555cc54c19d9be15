// Copies of layers, along rows or at their ends.
#include "ice/boundary/layer_copy.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sluice::ice {

IntVec3 source_cell(IntVec3 ghost, int d, bool plus, bool mirrored, const IndexBox& domain) {
  IntVec3 s = ghost;
  if (plus)
    s[d] = mirrored ? 2 * domain.upper[d] - 1 - ghost[d] : domain.upper[d] - 1;
  else
    s[d] = mirrored ? 2 * domain.lower[d] - 1 - ghost[d] : domain.lower[d];
  // A domain narrower than the ghost layers is mirrored once more.
  s[d] = std::clamp(s[d], domain.lower[d], domain.upper[d] - 1);
  return s;
}

namespace {

// A few ghosts at the end of each row, all layers together: they share a cache line. Nearly every
// row is another line and every few rows another page, so they are fetched ahead of their use.
void copy_row_ends(double* row, std::ptrdiff_t stride, int rows, std::span<const int> source,
                   int low, double sign) {
  constexpr std::ptrdiff_t ahead = 32;  // rows, measured best
  const auto [first, last] = std::minmax_element(source.begin(), source.end());
  const std::ptrdiff_t layers = static_cast<std::ptrdiff_t>(source.size());
  const std::ptrdiff_t begin = std::min<std::ptrdiff_t>(0, *first - low);
  const std::ptrdiff_t end = std::max<std::ptrdiff_t>(layers - 1, *last - low);
  for (int n = 0; n < rows; ++n, row += stride) {
    // As numbers: past the last row there is no such pointer.
    const auto here = reinterpret_cast<std::uintptr_t>(row);
    const auto to = [&](std::ptrdiff_t x) {
      return reinterpret_cast<const void*>(
          here +
          static_cast<std::uintptr_t>((ahead * stride + x) * std::ptrdiff_t{sizeof(double)}));
    };
    __builtin_prefetch(to(begin), 1);
    __builtin_prefetch(to(end), 1);
    for (std::ptrdiff_t layer = 0; layer < layers; ++layer)
      row[layer] = sign * row[source[layer] - low];
  }
}

}  // namespace

void copy_layers(const RealView& v, const IndexBox& ghosts, int d, std::span<const int> source,
                 double sign) {
  int a = d == 0 ? 1 : 0, b = d == 2 ? 1 : 2;  // inner and outer of the other directions
  if (v.stride[b] == 1) std::swap(a, b);
  const IntVec3 n = ghosts.size();
  for (int outer = 0; outer < n[b]; ++outer) {
    double* row = v.data + v.offset(ghosts.lower) + outer * v.stride[b];
    if (v.stride[d] == 1) {
      copy_row_ends(row, v.stride[a], n[a], source, ghosts.lower[d], sign);
      continue;
    }
    for (int layer = 0; layer < n[d]; ++layer) {
      double* to = row + layer * v.stride[d];
      const double* from = row + (source[layer] - ghosts.lower[d]) * v.stride[d];
      // Along unit stride, or a single cell of a direction that is not active.
      for (int inner = 0; inner < n[a]; ++inner) to[inner] = sign * from[inner];
    }
  }
}

}  // namespace sluice::ice
