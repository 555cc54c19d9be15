// Which cells beside solids give the remap what the step makes of them; the others, where little
// fluid is left, or its volume changes much, or its energy is spent, give their old state: what
// happens in such a cell in one step says nothing about what passes its faces.
#pragma once

namespace sluice::ice {

// V, V_L: volume of the fluid before and after the Lagrangian phase, as a fraction of the cell;
// E_L: its energy per volume of the cell, J/m^3; H: what flows out, as V. What old states give
// beyond what the cell has its neighbours lend; on a side of the domain it might have none.
inline bool gives_new_state(double V, double V_L, double E_L, double H, bool on_side) {
  // threshold: share of a cell that fluid fills, from which on it gives the remap its new state;
  //   unit: 1; test: none
  constexpr double min_fluid = 0.5;
  // threshold: share of its volume to which the Lagrangian phase may press it for that; unit: 1;
  //   test: none
  constexpr double max_squeeze = 0.3;
  // threshold: multiple of its volume to which the Lagrangian phase may stretch it for that;
  //   unit: 1; test: none
  constexpr double max_stretch = 3.0;
  const bool whole = (V >= min_fluid) & (V_L > max_squeeze * V) & (V_L < max_stretch * V);
  return (E_L > 0) & (whole | (on_side & (H > V) & (V_L > V)));
}

}  // namespace sluice::ice
