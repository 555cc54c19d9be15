// How far a body's surface lies from a node, told from the mean place of its particles there.
//
// The distance between the mean places of two bodies at a node is no gap: at touch it is 0.75 to
// 1.2 cells, by where the surfaces lie. So the mean is inverted: of a half space u > s
//
//   mean(s) = int_s w u du / int_s w du,   w: the GIMP weight of particles of half width l
//
// rises with s, and s(mean) gives each surface from its own mean (docs/theory/mpm_contact.md).
#pragma once
#include <array>

namespace sluice::mpm {

class SurfaceTable {
 public:
  // Half width of the particles in cells, above 0 and at most 1/2.
  explicit SurfaceTable(double half);

  // Place of the surface in cells from the node, of a body on the upper side of it; `mean`: of its
  // particles there, in cells too. A body all
  // around the node (mean <= 0) has its surface one reach, 1 + l, below.
  double surface(double mean) const;

 private:
  static constexpr int intervals = 256;
  double reach_;
  std::array<double, intervals + 1> mean_{};  // at s = -reach ... reach
};

}  // namespace sluice::mpm
