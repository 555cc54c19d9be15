// Sums of the fine faces of each coarse face of a patch, the same bits in mirrored scenes. Of any
// quantity, in its unit; a scale is a factor.
//
// Along one tangential direction neighbours are added, then neighbours of these sums; along two,
// the diagonals of 2 x 2 blocks, then the blocks alike: (a + d) + (b + c). Exchanged axes then give
// the same bits too.
#pragma once
#include <array>
#include <cstddef>

#include "framework/grid/index_box.hpp"

namespace sluice {

class FaceFold {
 public:
  FaceFold() = default;
  // Values lie row by row over `fine_faces`, x fastest; a coarse face holds faces_each of them
  // (1, 2 or 4 a direction; 1 across the face), else std::logic_error.
  FaceFold(const IndexBox& fine_faces, IntVec3 faces_each);

  // Adds scale * (sum of fine values) to the value of each coarse face, x fastest.
  void add(const double* fine, double scale, double* coarse) const;
  int faces_each() const { return count_; }

 private:
  void split(IntVec3 low, IntVec3 size);
  template <int count>
  void add_folded(const double* fine, double scale, double* coarse) const;

  int count_ = 0;                            // fine faces of a coarse one
  std::array<std::ptrdiff_t, 16> offset_{};  // of these, in the order of addition
  std::array<std::ptrdiff_t, 3> stride_{};   // of fine faces
  std::array<std::ptrdiff_t, 3> step_{};     // from one coarse face to the next
  IntVec3 coarse_size_{};
};

}  // namespace sluice
