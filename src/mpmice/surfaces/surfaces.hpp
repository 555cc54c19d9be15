// The surfaces of all solids of a level in a step: where they lie in cells, and means over them.
#pragma once
#include "mpmice/surfaces/previous_fractions.hpp"
#include "mpmice/surfaces/surface_geometry.hpp"
#include "mpmice/surfaces/surface_means.hpp"

namespace sluice::mpmice {

template <int D>
class Surfaces {
 public:
  // `viscous`: somebody asks for the places of surfaces in cells.
  Surfaces(const solids::CoupledSolids& solids, bool viscous) : means_(solids, viscous) {}

  // At the start of a step, in this order: faces and their pieces, and the fractions that the last
  // step left in a state (`slot`); means, from the largest rho c of the fluid (SurfaceMeans has
  // what comes back); then, once sums() are those of all ranks that share blocks, what follows
  // from them. Each is collective.
  void begin(const NearCells<D>& near, SolidSets<D>& sets, const Warehouse& state, int slot,
             Communicator& ranks);
  double add_means(const NearCells<D>& near, const SolidSets<D>& sets, double impedance,
                   Communicator& ranks);
  std::array<CellSums<D>*, 4> sums() {
    return {&geometry_.free_cells(), &geometry_.surfaces(), &previous_.sums(), &means_.sums()};
  }
  void finish(const NearCells<D>& near, const SolidSets<D>& sets, Communicator& ranks);
  // Of sets that have moved: the end of the step, and what they have swept. Collective.
  void find_moved(const NearCells<D>& near, SolidSets<D>& sets, Communicator& ranks);
  // The end alone, as faces have changed since. Collective.
  void find_at_end(const NearCells<D>& near, SolidSets<D>& sets, Communicator& ranks);
  // Pockets of fluid are kept open at the end of the step, cells at sides of the domain closed.
  void keep_open(const NearCells<D>& near);

  SolidGeometry<D>& solid() { return solid_; }
  const SolidGeometry<D>& solid() const { return solid_; }
  const OnSurfaces<D>& on() const { return on_; }

 private:
  SurfaceGeometry<D> geometry_;
  PreviousFractions<D> previous_;
  SurfaceMeans<D> means_;
  SolidGeometry<D> solid_;
  OnSurfaces<D> on_;
};

}  // namespace sluice::mpmice
