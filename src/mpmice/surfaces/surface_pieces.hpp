// Pieces of surfaces in cells: area, velocity, and which of them fluid sees.
#pragma once
#include "mpmice/surfaces/solid_geometry.hpp"
#include "mpmice/surfaces/solid_set.hpp"

namespace sluice::mpmice {

// Of the whole facet of a piece, m^2.
template <int D>
double area_of_facet(const Frame<D>& frame, const Piece<D>& piece) {
  double squares = 0;
  for (std::size_t d = 0; d < D; ++d) {
    const double a = piece.n[d] * frame.face_area(static_cast<int>(d));
    squares += a * a;
  }
  return std::sqrt(squares);
}

// Velocities of the pieces of a set's faces, m/s: that of the particle, which may turn, or, where a
// rule prescribes it, that of the middle of the piece.
template <int D>
class PieceVelocity {
 public:
  PieceVelocity(const Frame<D>& frame, const solids::CoupledSolids& solids, const SolidSet<D>& s)
      : frame_(frame),
        solids_(solids),
        set_(s),
        v_(columns_from<3>(*s.set, s.columns->velocity)),
        spin_(columns_from<3>(*s.set, s.columns->spin)),
        prescribed_(solids.is_prescribed(s.kind)) {}
  Vec3 at(std::size_t face, const Piece<D>& piece) const {
    const std::size_t p = set_.faces.particle[face];
    const Vec3 middle{v_[0][p], v_[1][p], v_[2][p]};
    const bool turns = spin_[0] != nullptr;
    if (!(piece.s > 0) || (!prescribed_ && !turns)) return middle;
    Vec3 place = set_.set->position(p);
    for (std::size_t a = 0; a < D; ++a) {
      const int d = frame_.direction[a];
      place[d] = frame_.anchor[d] + (piece.cell[a] + piece.arm[a] / piece.s) * frame_.spacing[d];
    }
    if (prescribed_) return solids_.prescribed_velocity(set_.kind, place);
    return middle + cross({spin_[0][p], spin_[1][p], spin_[2][p]}, place - set_.set->position(p));
  }

 private:
  const Frame<D>& frame_;
  const solids::CoupledSolids& solids_;
  const SolidSet<D>& set_;
  std::array<const double*, 3> v_, spin_;
  bool prescribed_;
};

// act(particle, face, area vector (outward, m^2), cell, its place): of the outer faces, as they are
// at the start of the step, the pieces that look into cells with fluid.
template <int D, class F>
void for_each_open_piece(const Frame<D>& frame, const SolidGeometry<D>& solid, const SolidSet<D>& s,
                         F&& act) {
  s.pieces.for_each(s.faces, [&](std::size_t i, int, const Piece<D>& piece) {
    const std::size_t p = s.faces.particle[i];
    if ((s.outer[p] >> s.faces.face[i] & 1) == 0 || !(s.filled[p] > 0)) return;
    Cell<D> c = piece.cell;
    for (std::size_t d = 0; d < D; ++d)
      if (!frame.periodic[d] && (c[d] < frame.domain.lower[d] || c[d] >= frame.domain.upper[d]))
        return;  // on a side of the domain
    c = frame.inside(c);
    const std::size_t k = frame.cells.index(c);
    if (!solid.wet(k)) return;
    std::array<double, D> area = piece.area;
    for (int d = 0; d < D; ++d) area[static_cast<std::size_t>(d)] *= frame.face_area(d);
    act(p, s.faces.face[i], area, c, k);
  });
}

// The cell in which the middle of particle p lies.
template <int D>
Cell<D> cell_of_middle(const Frame<D>& frame, const ParticleSet& set, std::size_t p) {
  Cell<D> c;
  for (std::size_t d = 0; d < D; ++d)
    c[d] = frame.cell_at(set.coordinate(frame.direction[d])[p], d);
  return frame.inside(c);
}

}  // namespace sluice::mpmice
