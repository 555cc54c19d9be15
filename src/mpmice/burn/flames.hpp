// Flames that need time to come to explosive (FlameSpread in models/burn/ddt1.hpp).
//
// A flame sets out to a particle at the surface from hot fluid beside it, to one that is cracked
// from what burns beside it; in a cell that burns it is there at once. Its way is that of the
// nearest so far, from middle to middle of cells.
#pragma once
#include "models/burn/ddt1.hpp"
#include "mpmice/burn/burning_step.hpp"
#include "mpmice/burn/explosive_cells.hpp"

namespace sluice::mpmice {

// In dt, of the n-th set; SolidSet::flame has what comes of it.
template <int D>
void spread_flames(const BurningStep<D>& step, const models::Ddt1& law, const ExplosiveCells& cells,
                   std::size_t n);

// What particles know of flames becomes their own when the step is accepted.
template <int D>
void note_flames(StepJournal& journal, SolidSets<D>& sets);

}  // namespace sluice::mpmice
