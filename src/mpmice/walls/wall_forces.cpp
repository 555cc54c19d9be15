#include "mpmice/walls/wall_forces.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpmice {

template <int D>
void WallForces<D>::find_overlaps(const NearCells<D>& near, const SolidGeometry<D>& solid,
                                  bool all_rigid) {
  constexpr double cleaned = 1e-6;  // well above what cleaning volume fractions and faces changes
  overlap_ = false;
  if (all_rigid) return;
  for (std::size_t d = 0; d < D; ++d) {
    const Column& covered = solid.covered[d];
    beyond_[d].assign(near.size(), 0.0);
    near.for_each([&](const Cell<D>& c, std::size_t i) {
      Cell<D> above = c;
      ++above[d];
      const double more =
          covered[i] - covered[near.frame().cells.index(above)] - solid.normal[d][i];
      if (!(std::fabs(more) > cleaned)) return;
      beyond_[d][i] = more;
      overlap_ = true;
    });
  }
}

template <int D>
void WallForces<D>::add_on(const Frame<D>& frame, const SolidSet<D>& s,
                           const OnSurfaces<D>& surface, double reference,
                           solids::CornerForces& forces) const {
  const Column& wall_pressure = pressure_.values();
  std::array<double, D> per_largest;  // face area over the largest, in which areas are counted
  for (std::size_t d = 0; d < D; ++d)
    per_largest[d] = frame.face_area(static_cast<int>(d)) / frame.largest_face();
  KeptArray<std::array<std::array<double, corners_of_face<D>>, D>> sums(s.faces.size());
  s.pieces.for_each(s.faces, [&](std::size_t i, int t, const Piece<D>& piece) {
    // A body that a side of the domain cuts has no surface there.
    if (!frame.in_domain(frame.wrapped(piece.cell))) return;
    const std::size_t c = frame.cells.index(frame.inside(piece.cell));
    const double p = (wall_pressure[c] - reference) * s.faces.weight_of(i);
    const double size = viscous_ ? area_of_facet(frame, piece) * s.faces.weight_of(i) : 0.0;
    const double share =
        overlap_ && surface.area[c] > 0 ? area_of_facet(frame, piece) / surface.area[c] : 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      double force = -p * piece.n[d] * frame.face_area(static_cast<int>(d));
      if (overlap_) force -= p * share * beyond_[d][c] * per_largest[d];
      if (viscous_) force += friction_.along(d)[c] * size;
      std::array<double, D> moments = piece.m;
      for (double& m : moments) m *= force;
      add_to_corners<D>(t, moments, sums[i][d]);
    }
  });
  for (std::size_t i = 0; i < sums.size(); ++i)
    for (std::size_t k = 0; k < corners_of_face<D>; ++k) {
      solids::CornerForce f;
      const std::size_t p = s.faces.particle[i];
      const int corner = s.faces.corner(i, static_cast<int>(k));
      for (int d = 0; d < 3; ++d)
        f.place[d] =
            s.set->column(static_cast<std::size_t>(s.columns->corners + 3 * corner + d))[p];
      for (std::size_t a = 0; a < D; ++a) f.force[frame.direction[a]] = sums[i][a][k];
      forces.push_back(f);
    }
}

template <int D>
std::vector<solids::CornerForces> WallForces<D>::on_corners(const Frame<D>& frame,
                                                            const SolidSets<D>& sets,
                                                            const OnSurfaces<D>& surface) const {
  std::vector<solids::CornerForces> forces(sets.kinds().size());
  for (const SolidSet<D>& s : sets.all())
    if (!sets.kind_of(s).rigid)
      add_on(frame, s, surface, sets.reference_pressure(),
             forces[static_cast<std::size_t>(s.kind)]);
  return forces;
}

// The impulse of all walls on the fluid, N s: dt sum p_w (a_- - a_+) over its cells, also where
// bodies overlap and a face to a cell without fluid is not covered. Of this rank's cells.
template <int D>
void WallForces<D>::add_impulse_of_walls(const NearCells<D>& near, const SolidGeometry<D>& solid,
                                         std::size_t d, double dt, ExactSum& sum) const {
  const Frame<D>& frame = near.frame();
  const double impulse = dt * frame.face_area(static_cast<int>(d));
  near.for_each_own([&](const Cell<D>& c, std::size_t i) {
    if (!solid.wet(i)) return;
    const auto closed = [&](const Cell<D>& face, Cell<D> beyond) {
      const bool side = !frame.in_domain(beyond) && !frame.periodic[d];
      beyond = frame.inside(beyond);
      return side || solid.wet(frame.cells.index(beyond))
                 ? solid.covered[d][frame.cells.index(face)]
                 : 1.0;
    };
    Cell<D> below = c, above = c;
    --below[d];
    ++above[d];
    sum.add(pressure_.values()[i] * (closed(c, below) - closed(above, above)) * impulse);
  });
}

template <int D>
void WallForces<D>::book_rigid(const Frame<D>& frame, const SolidSet<D>& s, bool all_rigid,
                               double dt, CouplingBooks& books) const {
  const double reference = solids::reference_pressure(solids_.kinds());
  const PieceVelocity<D> velocities(frame, solids_, s);
  s.pieces.for_each(s.faces, [&](std::size_t i, int, const Piece<D>& piece) {
    const Cell<D> c = frame.wrapped(piece.cell);
    if (!frame.in_domain(c)) return;
    const std::size_t n = frame.cells.index(c);
    const double p = pressure_.values()[n], weight = s.faces.weight_of(i);
    const double size = viscous_ ? area_of_facet(frame, piece) * piece.s * weight : 0.0;
    const Vec3 v = viscous_ ? velocities.at(i, piece) : Vec3{};
    for (std::size_t d = 0; d < D; ++d) {
      const int along = frame.direction[d];
      const double area = piece.area[d] * frame.face_area(static_cast<int>(d));
      // Where all are rigid the impulse is that of the walls on the fluid, without friction.
      if (!all_rigid) books.of_forces(Booked::impulse, along).add(p * (dt * area));
      books.of_forces(Booked::reaction, along).add(-(p - reference) * area);
      if (!viscous_) continue;
      const double force = size * friction_.along(d)[n];
      books.of_forces(Booked::reaction, along).add(force);
      books.of_forces(Booked::impulse, along).add(-force * dt);
      books.of_forces(Booked::work).add(-force * dt * v[along]);
    }
  });
}

template <int D>
void WallForces<D>::book_reference(const Frame<D>& frame, const SolidSet<D>& s, double reference,
                                   double dt, CouplingBooks& books) const {
  s.pieces.for_each(s.faces, [&](std::size_t i, int, const Piece<D>& piece) {
    if (!frame.in_domain(frame.wrapped(piece.cell))) return;
    const double weight = s.faces.weight_of(i);
    for (std::size_t d = 0; d < D; ++d) {
      const double area = piece.area[d] * frame.face_area(static_cast<int>(d));
      books.of_forces(Booked::impulse, frame.direction[d]).add(reference * weight * (dt * area));
    }
  });
}

template <int D>
void WallForces<D>::book(const NearCells<D>& near, const SolidGeometry<D>& solid,
                         const SolidSets<D>& sets, double dt, CouplingBooks& books) const {
  const bool all_rigid = sets.all_rigid();
  books.clear_forces();
  for (const SolidSet<D>& s : sets.all()) {
    if (sets.kind_of(s).rigid)
      book_rigid(near.frame(), s, all_rigid, dt, books);
    else
      book_reference(near.frame(), s, sets.reference_pressure(), dt, books);
  }
  for (std::size_t d = 0; d < D && all_rigid; ++d)
    add_impulse_of_walls(near, solid, d, dt,
                         books.of_forces(Booked::impulse, near.frame().direction[d]));
}

// Less what the reference pressure works on solids as they grow: what the totals count, also where
// bodies overlap.
template <int D>
void add_growth(const SolidSets<D>& sets, ExactSum& work) {
  const double reference = sets.reference_pressure();
  for (const SolidSet<D>& s : sets.all()) {
    const auto column = static_cast<std::size_t>(s.columns->volume);
    const double *before = s.set->column(column), *after = s.next->column(column);
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      work.add(-reference * after[p]);
      work.add(reference * before[p]);
    }
  }
}

template <int D>
void WallForces<D>::book_work(const NearCells<D>& near, const SolidGeometry<D>& solid,
                              const OnSurfaces<D>& surface, const SolidSets<D>& sets,
                              const Column& moved, const CellMask& swept_with_solid, double dt,
                              CouplingBooks& books) const {
  const Frame<D>& frame = near.frame();
  const bool rigid = sets.all_rigid();
  books.clear_work();
  ExactSum& work = books.of_work(rigid ? Booked::work : Booked::surface_work);
  near.for_each_own([&](const Cell<D>&, std::size_t i) {
    const bool waits = solid.theta[i] >= 1 && solid.theta_next[i] >= 1;
    if (!waits && swept_with_solid[i] != 0)
      work.add(pressure_.values()[i] * (moved[i] - solid.theta[i]) * frame.cell_volume);
    for (std::size_t d = 0; d < D && viscous_ && !rigid; ++d)
      work.add(-friction_.along(d)[i] * surface.area[i] * surface.velocity[d][i] *
               (dt * frame.largest_face()));
  });
  if (!rigid) add_growth(sets, work);
}

template class WallForces<1>;
template class WallForces<2>;
template class WallForces<3>;

}  // namespace sluice::mpmice
