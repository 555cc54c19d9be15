// Where solids lie in the cells near them during a step, as the fluid sees it.
#pragma once
#include "mpmice/fields/near_cells.hpp"
#include "mpmice/geometry/solid_in_cells.hpp"
#include "mpmice/geometry/swept_volumes.hpp"

namespace sluice::mpmice {

// Arrays over the cells near solids (solid_in_cells.hpp, swept_volumes.hpp): volume fractions and
// covered parts of faces at the start of the step and at its end; mean over the step; what is swept
// through a face, in volumes of a cell; the area vector of the surface, out of the solid.
template <int D>
struct SolidGeometry {
  Column theta, theta_next;
  std::array<Column, D> covered, covered_next, mean_covered, swept;
  std::array<Column, D> normal;

  static constexpr int columns = 2 + 5 * D;

  // Is there fluid at the start of the step; solid at any time in it.
  bool wet(std::size_t i) const { return theta[i] < 1; }
  bool has_solid(std::size_t i) const { return theta[i] > 0 || theta_next[i] > 0; }

  // As found, which they use up.
  void take_start(SolidInCells<D>& found) {
    normal = std::move(found.n);
    take(found, theta, covered);
  }
  void take_end(SolidInCells<D>& found) { take(found, theta_next, covered_next); }
  void take_swept(SweptVolumes<D>& found) {
    mean_covered = std::move(found.A);
    swept = std::move(found.C);
    for (Column& a : mean_covered) clean_covered_parts(a);
  }

 private:
  static void take(SolidInCells<D>& found, Column& theta, std::array<Column, D>& covered) {
    theta = std::move(found.theta);
    covered = std::move(found.a);
    clean_volume_fractions(theta);
    for (Column& a : covered) clean_covered_parts(a);
  }
};

// A pocket of fluid that solids close by the end of the step, with nobody beside it to take what it
// holds, is kept open by a little.
template <int D>
void keep_pockets(const NearCells<D>& near, SolidGeometry<D>& solid);

// A cell without fluid on a side of the domain that a body covers all step long has no open faces,
// though the side has taken particles that close them.
template <int D>
void close_cells_at_sides(const NearCells<D>& near, SolidGeometry<D>& solid);

}  // namespace sluice::mpmice
