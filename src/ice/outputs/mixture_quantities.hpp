// Cell variables of several materials that are functions of a state alone.
#pragma once
#include "ice/outputs/quantity_list.hpp"

namespace sluice::ice::mixture {

// Where a material is absent, its own values are zero; pressure and velocity are those of the
// mixture, for every material alike, but for velocities of their own.
void declare_quantities(QuantityList& quantities);

}  // namespace sluice::ice::mixture
