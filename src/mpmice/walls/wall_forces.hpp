// Forces of the fluid on the surfaces of solids, its pressure and its friction; their impulse and
// work for the books.
//
// On corners of the outer faces: (-(p_w - p_ref) n + t |n|) m_k of each piece, t: friction of the
// fluid. Solids are free of stress at the reference pressure of the deck.
// Where bodies overlap, faces are covered once and surfaces are counted twice: what the fluid gives
// to walls, p_w (a_- - a_+), and what surfaces get, p_w n, would differ. What the fluid of a cell
// feels beyond its surface, closed faces that no surface in the cell accounts for, is shared out to
// the surfaces there.
#pragma once
#include "mpmice/fields/coupling_books.hpp"
#include "mpmice/walls/wall_friction.hpp"
#include "mpmice/walls/wall_pressure.hpp"

namespace sluice::mpmice {

template <int D>
class WallForces {
 public:
  // `viscous`: fluids have friction.
  WallForces(const solids::CoupledSolids& solids, const WallPressure<D>& pressure,
             const WallFriction<D>& friction, bool viscous)
      : solids_(solids), pressure_(pressure), friction_(friction), viscous_(viscous) {}

  void find_overlaps(const NearCells<D>& near, const SolidGeometry<D>& solid, bool all_rigid);
  // By kind, on corners of this rank's particles; none on rigid ones.
  std::vector<solids::CornerForces> on_corners(const Frame<D>& frame, const SolidSets<D>& sets,
                                               const OnSurfaces<D>& surface) const;
  // The impulse that comes from outside: of what holds or drives rigid bodies against the fluid;
  // and of sides of the domain that cut other bodies, which push these with the reference pressure,
  // of which their stress is free. (Around a body that no side cuts it sums to none.) And the force
  // on rigid bodies.
  void book(const NearCells<D>& near, const SolidGeometry<D>& solid, const SolidSets<D>& sets,
            double dt, CouplingBooks& books) const;
  // What surfaces that have moved to these fractions work on the fluid of cells that were swept
  // with solids, by pressure and friction; not where a gap waits for fluid. Of rigid solids it
  // comes from outside (that of friction is booked with its force).
  void book_work(const NearCells<D>& near, const SolidGeometry<D>& solid,
                 const OnSurfaces<D>& surface, const SolidSets<D>& sets, const Column& moved,
                 const CellMask& swept_with_solid, double dt, CouplingBooks& books) const;

  static constexpr int columns = D;

 private:
  void add_on(const Frame<D>& frame, const SolidSet<D>& s, const OnSurfaces<D>& surface,
              double reference, solids::CornerForces& forces) const;
  void book_rigid(const Frame<D>& frame, const SolidSet<D>& s, bool all_rigid, double dt,
                  CouplingBooks& books) const;
  void book_reference(const Frame<D>& frame, const SolidSet<D>& s, double reference, double dt,
                      CouplingBooks& books) const;
  void add_impulse_of_walls(const NearCells<D>& near, const SolidGeometry<D>& solid, std::size_t d,
                            double dt, ExactSum& sum) const;

  const solids::CoupledSolids& solids_;
  const WallPressure<D>& pressure_;
  const WallFriction<D>& friction_;
  bool viscous_;
  bool overlap_ = false;  // do bodies overlap somewhere
  std::array<Column, D>
      beyond_;  // area vector of what the fluid of a cell feels beyond its surface
};

}  // namespace sluice::mpmice
