// Surfaces that burn: what particles lose over their outer faces, by the fluid that these look
// into, and what their surfaces remember.
#pragma once
#include "models/burn/burn_law.hpp"
#include "mpmice/burn/burning_step.hpp"

namespace sluice::mpmice {

// Shares of the particles' masses, by set and particle, that their surfaces lose. Collective where
// the deck saves fields of the law.
template <int D>
void burn_surfaces(const BurningStep<D>& step, const models::SolidBurn& burn,
                   const models::SurfaceLaw& law, std::vector<Column>& shares);

// Of what burns everywhere: the share that burns in each cell, by the state there. Collective where
// the law asks for that.
template <int D>
void burn_cells(const BurningStep<D>& step, const models::SolidBurn& burn,
                const models::CellLaw& law, Column& shares);

// The mean over the cells in which the parts of a particle lie, of the particles of what burns.
template <int D>
void share_by_cells(const BurningStep<D>& step, const models::SolidBurn& burn,
                    const Column& in_cells, std::vector<Column>& shares);

}  // namespace sluice::mpmice
