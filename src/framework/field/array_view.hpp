// A three-dimensional view of numbers, of any unit, that belong to someone else: pointer and
// strides.
//
// Indices are the level's cell indices. A direction that is not active has stride 0, so that a
// stencil reaching across it finds the one layer that exists. The first active direction has unit
// stride: rows run along it.
#pragma once
#include <cstddef>
#include <type_traits>

#include "framework/grid/index_box.hpp"

namespace sluice {

template <class T>
struct ArrayView {
  T* data = nullptr;  // element at `box.lower`
  IndexBox box;       // what may be addressed
  std::ptrdiff_t stride[3] = {1, 0, 0};

  bool valid() const { return data != nullptr; }
  std::ptrdiff_t offset(IntVec3 c) const {
    return (c.x - box.lower.x) * stride[0] + (c.y - box.lower.y) * stride[1] +
           (c.z - box.lower.z) * stride[2];
  }
  T& operator()(IntVec3 c) const { return data[offset(c)]; }
  T& operator()(int i, int j, int k) const { return data[offset({i, j, k})]; }
  operator ArrayView<const T>() const
    requires(!std::is_const_v<T>)
  {
    ArrayView<const T> v;
    v.data = data;
    v.box = box;
    for (int d = 0; d < 3; ++d) v.stride[d] = stride[d];
    return v;
  }
};

using RealView = ArrayView<double>;
using ConstRealView = ArrayView<const double>;

// Does a region hold anything but `value` (a NaN is another). Row by row, up to the first that is.
bool any_other(const ConstRealView& v, const IndexBox& region, double value);
void fill(const RealView& v, const IndexBox& region, double value);
// Writes `value` where it is not yet: memory that was never written stays unwritten.
void fill_where_different(const RealView& v, const IndexBox& region, double value);

}  // namespace sluice
