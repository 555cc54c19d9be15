// What burning sees of a step, behind the sweep of the fluid and the motion of the solids.
#pragma once
#include "ice/fluid_part.hpp"
#include "mpmice/fields/cell_amounts.hpp"
#include "mpmice/surfaces/solid_geometry.hpp"
#include "mpmice/surfaces/solid_sets.hpp"

namespace sluice::mpmice {

template <int D>
struct BurningStep {
  const StageScope& scope;
  const NearCells<D>& near;
  const SolidGeometry<D>& solid;
  SolidSets<D>& sets;
  CellAmounts<D>& amounts;
  const Column& pressure;  // of the fluid, by cell at the start of the step, Pa
  const ice::FluidPart& fluid;

  const Frame<D>& frame() const { return near.frame(); }
  bool wet(std::size_t i) const { return solid.wet(i); }
};

// Temperature and M c_v of the fluids of a cell: what they have together; K, J/(m^3 K).
struct FluidHeat {
  double temperature = 0, capacity = 0;
};
template <int D>
FluidHeat heat_of(const BurningStep<D>& step, std::size_t i);

// Temperature of the hottest fluid in a cell, or around it where asked or where the cell has
// little; 0: none. K.
template <int D>
double hottest_fluid(const BurningStep<D>& step, const Cell<D>& c, bool around);

// Mass per cell volume of a kind of solid at the start of the step (kg/m^3), and its mean pressure
// at its end (Pa). Collective.
template <int D>
void mean_in_cells(const BurningStep<D>& step, int kind, Column& mass, Column& pressure);

// The largest number of the first lane on any rank. Collective.
template <int D>
double most_of(const CellSums<D>& counts, Communicator& ranks);

}  // namespace sluice::mpmice
