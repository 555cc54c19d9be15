// The order in which fine faces are added, as a list whose neighbours are added in turn.
#include "framework/refine/face_fold.hpp"

#include <stdexcept>

namespace sluice {
namespace {

// Neighbours of the list, then neighbours of the sums.
template <int count>
double folded(const double* face, const std::ptrdiff_t* offset) {
  if constexpr (count == 1)
    return face[offset[0]];
  else
    return folded<count / 2>(face, offset) + folded<count / 2>(face, offset + count / 2);
}

}  // namespace

FaceFold::FaceFold(const IndexBox& fine_faces, IntVec3 faces_each) {
  const IntVec3 n = fine_faces.size();
  stride_ = {1, n.x, static_cast<std::ptrdiff_t>(n.x) * n.y};
  for (int d = 0; d < 3; ++d) {
    const int each = faces_each[d];
    if (each != 1 && each != 2 && each != 4)
      throw std::logic_error("a level refines by 1, 2 or 4 per direction");
    step_[d] = stride_[d] * each;
    coarse_size_[d] = n[d] / each;
  }
  if (faces_each.x > 1 && faces_each.y > 1 && faces_each.z > 1)
    throw std::logic_error("faces lie in a plane");
  split({}, faces_each);
}

void FaceFold::split(IntVec3 low, IntVec3 size) {
  int d = 0;
  for (int other = 1; other < 3; ++other)
    if (size[other] > size[d]) d = other;
  if (size[d] == 1) {
    offset_[count_++] = low.x * stride_[0] + low.y * stride_[1] + low.z * stride_[2];
    return;
  }
  IntVec3 half = size, along{}, other{};
  for (int e = 0; e < 3; ++e)
    if (e != d && size[e] == size[d]) other[e] = half[e] = size[e] / 2;
  along[d] = half[d] = size[d] / 2;
  if (other == IntVec3{}) {
    split(low, half);
    split(low + along, half);
    return;
  }
  split(low, half);
  split(low + along + other, half);
  split(low + along, half);
  split(low + other, half);
}

template <int count>
void FaceFold::add_folded(const double* fine, double scale, double* coarse) const {
  for (int k = 0; k < coarse_size_.z; ++k)
    for (int j = 0; j < coarse_size_.y; ++j) {
      const double* face = fine + j * step_[1] + k * step_[2];
      for (int i = 0; i < coarse_size_.x; ++i, face += step_[0])
        *coarse++ += scale * folded<count>(face, offset_.data());
    }
}

void FaceFold::add(const double* fine, double scale, double* coarse) const {
  switch (count_) {
    case 1:
      return add_folded<1>(fine, scale, coarse);
    case 2:
      return add_folded<2>(fine, scale, coarse);
    case 4:
      return add_folded<4>(fine, scale, coarse);
    case 8:
      return add_folded<8>(fine, scale, coarse);
    default:
      return add_folded<16>(fine, scale, coarse);
  }
}

}  // namespace sluice
