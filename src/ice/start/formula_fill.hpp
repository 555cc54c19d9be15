// The initial state as formulas of x, y, z: at the centre of each cell, or as means over it.
#pragma once
#include "ice/start/initial_state.hpp"

namespace sluice::ice {

// Replaces values of a material that is filled already. As means over cells: of density, momentum
// and energy, by Gauss's rule with 4 points along each direction (exact to degree 7); temperature
// and pressure are those of the means.
void apply_formula(const FormulaFill& formula, const IceMaterial& m, const Level& level,
                   PrimitiveFill& fill);

}  // namespace sluice::ice
