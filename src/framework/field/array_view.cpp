// Regions of views, row by row.
#include "framework/field/array_view.hpp"

#include <algorithm>
#include <cstdint>

namespace sluice {
namespace {

// Calls f(offset of the first number of a row) until it returns true.
template <class F>
bool any_row(const ConstRealView& v, const IndexBox& region, int along, F&& f) {
  if (region.empty()) return false;
  IndexBox starts = region;
  starts.upper[along] = starts.lower[along] + 1;
  for (int k = starts.lower.z; k < starts.upper.z; ++k)
    for (int j = starts.lower.y; j < starts.upper.y; ++j)
      for (int i = starts.lower.x; i < starts.upper.x; ++i)
        if (f(v.offset({i, j, k}))) return true;
  return false;
}

int row_direction(const ConstRealView& v) {
  return v.stride[0] == 1 ? 0 : v.stride[1] == 1 ? 1 : 2;
}

bool row_differs(const double* row, int n, double value) {
  std::int64_t others = 0;
  for (int x = 0; x < n; ++x) others += row[x] != value;
  return others != 0;
}

}  // namespace

bool any_other(const ConstRealView& v, const IndexBox& region, double value) {
  const int along = row_direction(v);
  const int n = region.size()[along];
  return any_row(v, region, along,
                 [&](std::ptrdiff_t row) { return row_differs(v.data + row, n, value); });
}

void fill(const RealView& v, const IndexBox& region, double value) {
  const int along = row_direction(v);
  const int n = region.size()[along];
  any_row(v, region, along, [&](std::ptrdiff_t offset) {
    std::fill_n(v.data + offset, n, value);
    return false;
  });
}

void fill_where_different(const RealView& v, const IndexBox& region, double value) {
  const int along = row_direction(v);
  const int n = region.size()[along];
  any_row(v, region, along, [&](std::ptrdiff_t offset) {
    double* row = v.data + offset;
    if (row_differs(row, n, value)) std::fill_n(row, n, value);
    return false;
  });
}

}  // namespace sluice
