// One gas whose properties follow from a scalar (models/binary_properties.hpp), in the step.
//
// The step is that of an ideal gas with the pressure p = (gamma(f) - 1) E of each cell; bounds and
// rates take the larger gamma of the two. What is carried is bounded alike, so that where pressure,
// temperature and velocity are uniform, density, energy and rho f are linear in each other on every
// face and stay so: no waves start where the gases meet.
#pragma once
#include "ice/quantity_list.hpp"
#include "models/binary_properties.hpp"

namespace sluice::ice::scalars {

inline Fluid fluid_of(const models::BinaryGas& gas, double f) {
  return ideal_gas(gas.gamma(f), gas.specific_heat(f));
}

// The scalar f among those of the scene.
const models::TransportedScalar& binary_scalar(const SchemeOptions& o);

// p and c of the old state.
void binary_primitive_row(const models::BinaryGas& gas, int n, const double* f, const double* rho,
                          const double* E, double* w, double* p, double* c);

// Labels that follow from f.
struct BinaryQuantities {
  VariableId pressure, temperature, sound_speed;
};
BinaryQuantities declare_binary_quantities(QuantityList& q, VariableId rho, VariableId E);

}  // namespace sluice::ice::scalars
