// Cells of which solids leave little to the fluid share what they hold with their neighbours.
//
// Small are cells with theta' > 0, V' < 1/2 and V' > 0 or any amount left. The neighbourhood of a
// small cell s is s and its face neighbours with V' > V_s' + 1e-9 whose face is not covered at
// both ends of the step, where V_s' > 0 only along the largest component of the smoothed normal
// (both if within 1 %). Without any the condition on the direction falls, then that on the cover;
// a closed cell then goes to the nearest cells that have room.
// All other cells are neighbourhoods of their own. With N_j neighbourhoods that hold cell j,
//
//   Q_s = sum_j (A_j/N_j) / sum_j (V_j'/N_j),   A_j' = (V_j'/N_j) sum_{s holds j} Q_s
//
// for A = mass, momentum, total energy; twice. No order of cells shows, what is uniform stays so,
// V' = 0 leaves exact zeros (mpmice_scheme, step 11).
#pragma once
#include <optional>

#include "mpmice/fields/cell_amounts.hpp"
#include "mpmice/walls/smooth_normals.hpp"

namespace sluice::mpmice {

// `trapped`: the first of this rank's cells which closes while nobody takes what it holds.
// What becomes of a cell follows from those within five cells around it (volumes, normals and
// covered faces: six; farther only where a closed cell looks for room).
template <int D>
void redistribute(const NearCells<D>& near, const SolidGeometry<D>& solid,
                  const SmoothNormals<D>& normals, CellAmounts<D>& amounts,
                  std::optional<Cell<D>>& trapped);

}  // namespace sluice::mpmice
