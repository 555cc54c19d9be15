// Prepares shocks for the wider cells that they are about to enter: where a level ends whose cells
// are four times as fine as those beyond.
//
// A captured shock is as wide as the cells let it be. Where these become four times as wide at once
// it sheds a wave that runs back, 0.0124 of the jump at Mach 1.5. Over the last four coarse cells
// before the end of the level the slopes of pressure are therefore taken away little by little
// where the pressure falls steeply towards the end,
//   sp *= 1 - s (1 - w),  w = (k - 1/2)/16 in the k-th cell before the end,
//   s = 0 for a fall over two cells below 0.07 rho c^2, 1 above 0.21 rho c^2, linear between,
// so that the shock widens before it leaves. Of all slopes those of pressure alone are damped: a
// shock that they widen sheds 0.0054, one that all of them widen 0.0105. Smooth flow is not
// touched, nor a shock that comes in or runs along the end. Towards cells twice as wide a shock
// sheds less than a hundredth by itself, and levels that a regridder makes follow it.
#pragma once
#include "framework/refine/interface_distance.hpp"
#include "framework/task/task.hpp"

namespace sluice::ice {

// How many cells before the end of a level it acts, by direction.
IntVec3 leaving_depth(const Level& level);

struct PressureRows {
  const double *minus, *plus;  // pressure of the two neighbours along the axis
  const double *rho, *sound;
};

// The slopes of pressure along one axis, one row.
void damp_leaving_shocks(const Row& row, const InterfaceDistance& ends, int axis,
                         const PressureRows& q, double* slope);

}  // namespace sluice::ice
