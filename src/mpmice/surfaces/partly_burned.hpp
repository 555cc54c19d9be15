// Where particles meet of which different parts are solid: there surfaces are summed over all faces
// of particles, as the two sides of a face that two such particles share differ by what is left of
// them. Elsewhere both sides cancel, and outer faces alone are enough.
//
// In each cell, over the corners there of the particles that can burn: their number c, and the sum
// h of a hash H of what is left of each particle, modulo 2^64. Where all are alike, h = c H.
#pragma once
#include <bit>

#include "mpmice/geometry/cell_sums.hpp"
#include "mpmice/surfaces/solid_set.hpp"

namespace sluice::mpmice {

template <int D>
class PartlyBurned {
 public:
  // Collective. From what is left of particles (SolidSet::filled), at the start of the step; at
  // both ends where they have `moved`.
  void find(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets, bool moved,
            Communicator& ranks) {
    moved_ = moved;
    sums_.begin(frame.cells, 2);
    for (const SolidSet<D>& s : sets)
      for (std::size_t p = 0; p < s.filled.size() && s.burns(); ++p) {
        const std::uint64_t own = hash(s.filled[p]);
        for_each_corner(frame, s, p, [&](std::size_t, std::size_t i) {
          sums_.lane(number)[i] += 1;
          sums_.lane(hashes)[i] += own;
        });
      }
    sums_.sum_over_ranks(ranks);
  }
  // Bits of the faces of a set over which surfaces are summed. Whether an inner face is one follows
  // from its corners, so that both particles that share it answer alike.
  KeptArray<std::uint8_t> faces_in_sums(const Frame<D>& frame, const SolidSet<D>& s) const {
    KeptArray<std::uint8_t> faces = outer_faces_of(s);
    if (!s.burns()) return faces;
    for (std::size_t p = 0; p < faces.size(); ++p) {
      unsigned near = 0;  // bits of the corners in whose cells particles differ
      const std::uint64_t own = hash(s.filled[p]);
      for_each_corner(frame, s, p, [&](std::size_t k, std::size_t i) {
        near |= (sums_.lane(hashes)[i] != sums_.lane(number)[i] * own ? 1u : 0u) << k;
      });
      for (std::size_t f = 0; f < faces_of_particle<D> && near != 0; ++f)
        for (const int k : face_corners<D>[f])
          if ((near >> k & 1) != 0) faces[p] |= static_cast<std::uint8_t>(1u << f);
    }
    return faces;
  }

 private:
  static constexpr int number = 0, hashes = 1;

  // An odd number, equal for equal bits.
  static std::uint64_t hash(double x) {
    auto h = std::bit_cast<std::uint64_t>(x);
    h = (h ^ (h >> 31)) * 0x9e3779b97f4a7c15ULL;
    return (h ^ (h >> 29)) | 1;
  }
  // act(corner, its cell's place in the arrays), at both ends where particles have moved.
  template <class F>
  void for_each_corner(const Frame<D>& frame, const SolidSet<D>& s, std::size_t p, F&& act) const {
    for (int end = 0; end < (moved_ ? 2 : 1); ++end) {
      const ParticleSet& set = end == 0 ? *s.set : *s.next;
      const CornerColumns<D> corners = corner_columns<D>(frame, *s.columns, set);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        Cell<D> c;
        for (std::size_t a = 0; a < D; ++a) c[a] = frame.cell_at(corners[k][a][p], a);
        act(k, frame.cells.index(frame.wrapped(c)));
      }
    }
  }

  CellSums<D> sums_;
  bool moved_ = false;
};

}  // namespace sluice::mpmice
