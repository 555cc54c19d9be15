// Prepares shocks for the wider cells that they are about to enter, where a level ends.
//
// A captured shock is as wide as the cells let it be. Where these become wider at once it sheds a
// wave that runs back (0.0124 of the jump at Mach 1.5, 0.0175 at 2.5, 0.0264 at 10 where cells
// become four times as wide; 0.0061, 0.0114, 0.0173 at twice). What is shed in all does not depend
// on the way; over a long way it is a long and low wave. Over the last 20 coarse cells before the
// end of the level (12 where the ratio is 2) the slopes of pressure are therefore taken away little
// by little, and at ratio 4 turned, where the pressure falls steeply towards the end,
//   sp *= 1 - A (1 - w^n),  w = (k - 1/2)/K in the k-th of the K cells before the end,
//   A from 0 to A1 for a fall over two cells of 0.07 to 0.21 rho c^2, on to A2 at 1 rho c^2,
//   ratio 2: K = 24, n = 1, A1 = A2 = 0.7;  ratio 4: K = 80, n = 1/2, A1 = 1.5, A2 = 5.5,
// so that the shock widens before it leaves. A wide one falls less over two cells, so that A does
// not widen it for ever. Of all slopes those of pressure alone are damped: where all of them were
// the shock shed as much as undamped. Smooth flow is not touched, nor a shock that comes in or runs
// along the end. The ends of levels that follow the flow go with the shock.
#pragma once
#include "framework/refine/interface_distance.hpp"
#include "framework/task/task.hpp"

namespace sluice::ice {

// How many cells before the end of a level it acts, by direction.
IntVec3 leaving_depth(const Level& level);

struct PressureRows {
  const double *minus, *plus;  // pressure of the two neighbours along the axis, Pa
  const double *rho, *sound;   // kg/m^3, m/s
};

// The slopes of pressure along one axis, one row: changed; Pa per cell.
void damp_leaving_shocks(const Row& row, const InterfaceDistance& ends, int axis,
                         const PressureRows& q, double* slope);

}  // namespace sluice::ice
