// The work pressure X of a semi-implicit step in the cells of solids (docs/theory/ice_pressure.md):
// what the next step takes of it, Y' = X - p' where the state was settled behind the sweep. Where
// there was no fluid, X is the mean of what is around.
#pragma once
#include "mpmice/fields/cell_amounts.hpp"
#include "mpmice/fields/fluid_cells.hpp"
#include "mpmice/walls/wall_pressure.hpp"

namespace sluice::mpmice {

// `X`: by cell with fluid, Pa, as the pressure on walls was found from it.
template <int D>
void keep_work_pressure(const NearCells<D>& near, const SolidGeometry<D>& solid,
                        const CellAmounts<D>& amounts, const ice::FluidPart& fluid, Column X,
                        Warehouse& next);

}  // namespace sluice::mpmice
