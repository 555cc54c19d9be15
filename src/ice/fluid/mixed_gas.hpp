// One gas whose properties follow from scalars (models/gases/mixed_gas.hpp): rows of its law.
//
// Two streams: the step is that of an ideal gas with the pressure p = (gamma(f) - 1) E of each
// cell. Species: p = rho R(Y) T with T from e(T, Y), in species_rows.hpp. Bounds and rates take the
// largest gamma and the lowest specific heat of all. What is carried is bounded alike, so that
// where pressure, temperature and velocity are uniform, density, energy and rho f are linear in
// each other on every face and stay so: no waves start where the gases meet.
//
// Rows: f mixture fraction, rho kg/m^3, w = 1/rho m^3/kg, E internal energy per
// volume J/m^3, p and K = rho c^2 Pa, c m/s, T K.
#pragma once
#include <cstddef>

#include "ice/fluid/fluid.hpp"
#include "ice/fluid/fractions.hpp"
#include "models/gases/mixed_gas.hpp"

namespace sluice::ice {

// The law in cell i of a row.
Fluid fluid_of(const models::MixedGas& gas, const FractionRows& rows, int i = 0);

// Whether material m of a scene is a mixture itself.
inline bool is_mixed(const models::MixedGas* gas, std::size_t m) {
  return gas != nullptr && static_cast<std::size_t>(gas->material) == m;
}
// Of two streams: p and c of the old state.
void mixed_primitive_row(const models::MixedGas& gas, int n, const double* f, const double* rho,
                         const double* E, double* w, double* p, double* c);
void mixed_pressure_row(const models::MixedGas& gas, int n, const double* f, const double* E,
                        double* p);
void mixed_sound_speed_row(const models::MixedGas& gas, int n, const double* f, const double* rho,
                           const double* p, double* c);
// p and rho c^2, and that at another pressure.
void mixed_pressure_and_modulus_row(const models::MixedGas& gas, int n, const double* f,
                                    const double* E, double* p, double* K);
void mixed_modulus_row(const models::MixedGas& gas, int n, const double* f, const double* p,
                       double* K);
// T = E/(rho cv).
void mixed_temperature_row(const models::MixedGas& gas, int n, const double* f, const double* rho,
                           const double* E, double* T);
// A number of the table (MixedGas::Node, in its unit) in each cell.
void property_row(const models::MixedGas& gas, double models::MixedGas::Node::*property, int n,
                  const double* f, double* values);

}  // namespace sluice::ice
