// Where particles lie that are solid in part: near them surfaces are summed over all faces of
// particles, since a neighbour may be solid in another part. Elsewhere the two sides of an inner
// face cancel, and outer faces alone are enough.
#pragma once
#include "mpmice/geometry/cell_sums.hpp"
#include "mpmice/step/solid_sets.hpp"

namespace sluice::mpmice {

template <int D>
class PartlyBurned {
 public:
  // Collective. From what is left of particles (SolidSet::filled), at the start of the step; at
  // both ends where they have `moved`.
  void find(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets, bool moved,
            Communicator& ranks) {
    moved_ = moved;
    marks_.begin(frame.box, 1);
    marks_.reach(frame.box);
    for (const SolidSet<D>& s : sets)
      for (std::size_t p = 0; p < s.filled.size() && s.part >= 0; ++p)
        if (s.filled[p] < 1)
          for_each_corner(frame, s, p, [&](std::size_t, std::size_t i) { marks_.lane(0)[i] += 1; });
    marks_.sum_over_ranks(ranks);
  }
  // Bits of the faces of a set over which surfaces are summed. Whether an inner face is one follows
  // from its corners, so that both particles that share it answer alike.
  std::vector<std::uint8_t> faces_in_sums(const Frame<D>& frame, const SolidSet<D>& s) const {
    std::vector<std::uint8_t> faces = outer_faces_of(s);
    if (s.part < 0) return faces;
    for (std::size_t p = 0; p < faces.size(); ++p) {
      unsigned near = 0;  // bits of corners
      for_each_corner(frame, s, p, [&](std::size_t k, std::size_t i) {
        near |= (marks_.lane(0)[i] > 0 ? 1u : 0u) << k;
      });
      for (std::size_t f = 0; f < faces_of_particle<D> && near != 0; ++f)
        for (const int k : face_corners<D>[f])
          if ((near >> k & 1) != 0) faces[p] |= static_cast<std::uint8_t>(1u << f);
    }
    return faces;
  }

 private:
  // act(corner, its cell's place in the arrays), at both ends where particles have moved.
  template <class F>
  void for_each_corner(const Frame<D>& frame, const SolidSet<D>& s, std::size_t p, F&& act) const {
    for (int end = 0; end < (moved_ ? 2 : 1); ++end) {
      const ParticleSet& set = end == 0 ? *s.set : *s.next;
      const CornerColumns<D> corners = corner_columns<D>(frame, *s.columns, set);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        Cell<D> c;
        for (std::size_t a = 0; a < D; ++a) c[a] = frame.cell_at(corners[k][a][p], a);
        act(k, frame.box.index(frame.wrapped(c)));
      }
    }
  }

  CellSums<D> marks_;  // a lane: corners of particles solid in part
  bool moved_ = false;
};

}  // namespace sluice::mpmice
