// Corners, faces and facets of a particle with 2^D corners.
//
// Corner c lies on the high side along axis a where bit a of c is set. Face 2 a + s is the low
// (s = 0) or high (s = 1) side along axis a; its corners are listed in the order in which the area
// vector looks outward. A *facet* is a piece of surface with D nodes: a point, an edge, and in 3-D
// the triangles (m, a, b), (m, b, c), (m, c, d), (m, d, a) of the face a b c d with its centre m:
// bodies tile though faces are not planar, and mirror images are exact, which a diagonal would not
// be.
#pragma once
#include <array>
#include <cstdint>

namespace sluice::mpmice {

template <int D>
inline constexpr int corners_of_particle = 1 << D;
template <int D>
inline constexpr int corners_of_face = 1 << (D - 1);
template <int D>
inline constexpr int faces_of_particle = 2 * D;
template <int D>
inline constexpr int facets_of_face = D == 3 ? 4 : 1;

template <int D>
using FaceCorners = std::array<std::array<std::uint8_t, corners_of_face<D>>, 2 * D>;

template <int D>
constexpr FaceCorners<D> make_face_corners() {
  FaceCorners<D> table{};
  for (int axis = 0; axis < D; ++axis)
    for (int side = 0; side < 2; ++side) {
      auto& to = table[static_cast<std::size_t>(2 * axis + side)];
      const int base = side << axis;
      if constexpr (D == 1) {
        to[0] = static_cast<std::uint8_t>(base);
      } else if constexpr (D == 2) {
        // R(b - a) = (dy, -dx) looks outward: rising along y on the high side of x.
        const int other = 1 << (1 - axis);
        const bool rising = (axis == 0) == (side == 1);
        to[0] = static_cast<std::uint8_t>(rising ? base : base | other);
        to[1] = static_cast<std::uint8_t>(rising ? base | other : base);
      } else {
        const int u = 1 << ((axis + 1) % 3), v = 1 << ((axis + 2) % 3);
        to[0] = static_cast<std::uint8_t>(base);
        to[1] = static_cast<std::uint8_t>(base | (side == 1 ? u : v));
        to[2] = static_cast<std::uint8_t>(base | u | v);
        to[3] = static_cast<std::uint8_t>(base | (side == 1 ? v : u));
      }
    }
  return table;
}

template <int D>
inline constexpr FaceCorners<D> face_corners = make_face_corners<D>();

}  // namespace sluice::mpmice
