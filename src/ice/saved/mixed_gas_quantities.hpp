// Labels of a gas whose properties follow from a scalar f.
#pragma once
#include "ice/saved/quantity_list.hpp"

namespace sluice::ice {

struct MixedQuantities {
  VariableId pressure, temperature, sound_speed, compressibility;
};
// From density and internal energy per volume of the old state, and f.
MixedQuantities declare_mixed_quantities(QuantityList& q, VariableId rho, VariableId E);

}  // namespace sluice::ice
