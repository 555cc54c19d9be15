// The outer faces of particles: their corners at the start and at the end of a step.
//
// Faces between particles of a body cancel in every sum over its surface: none of them is here.
// Places are counted in cells of the level: cell i is [i, i + 1).
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mpmice/geometry/cell_box.hpp"
#include "mpmice/geometry/corner_table.hpp"

namespace sluice::mpmice {

enum class When { start, end };

// A place in cells. What is meant to lie in a grid plane lies in it, whatever rounding has made of
// it: a face of a solid a hair inside of its cell would leave that cell's face open.
inline double on_planes(double x) {
  constexpr double round_off = 1e-12;  // cells
  const double plane = std::nearbyint(x);
  return std::fabs(x - plane) < round_off ? plane : x;
}

// Columns of corners of particles, [corner][direction].
template <int D>
using CornerColumns = std::array<std::array<const double*, D>, corners_of_particle<D>>;

// From lengths to cells: (x - origin) * inverse. Equal corners get equal bits.
template <int D>
struct CellUnits {
  std::array<double, D> origin{};   // where cell 0 begins
  std::array<double, D> inverse{};  // cells per length
  static CellUnits none() {
    CellUnits u;
    u.inverse.fill(1);
    return u;
  }
};

// Columns over the outer faces.
template <int D>
struct OuterFaces {
  using Places = std::array<std::array<KeptArray<double>, D>, corners_of_face<D>>;
  Places start, end;                  // [corner of the face][direction], cells
  KeptArray<std::uint32_t> particle;  // whose face it is
  KeptArray<std::uint8_t> face;       // which of its faces: 2 axis + side
  // The part of the particle's volume that is solid, by face; empty: all of it. Sums over surfaces
  // count a face by it: of particles that are solid in part all faces must be here.
  KeptArray<double> weight;
  // 1: another particle shares the face, which is here for the two may be solid in different parts;
  // empty: none is.
  KeptArray<std::uint8_t> inner;

  std::size_t size() const { return face.size(); }
  double weight_of(std::size_t i) const { return weight.empty() ? 1.0 : weight[i]; }
  bool is_inner(std::size_t i) const { return !inner.empty() && inner[i] != 0; }
  void clear();  // keeps its memory
  // The same faces, of particles counted from 0, end at other corners.
  void move(const CornerColumns<D>& to, const CellUnits<D>& units);
  // Faces of particles 0 to n - 1 whose bit 2 axis + side is set in `outer`; they are numbered from
  // `first` on. Without `to` the corners do not move.
  void add(const CornerColumns<D>& from, const CornerColumns<D>* to, const std::uint8_t* outer,
           std::size_t n, const CellUnits<D>& units = CellUnits<D>::none(),
           std::uint32_t first = 0);
  // The corner of the particle that is corner k of face i.
  int corner(std::size_t i, int k) const {
    return face_corners<D>[face[i]][static_cast<std::size_t>(k)];
  }
};

}  // namespace sluice::mpmice
