// One gas whose properties follow from a scalar (models/mixed_gas.hpp), in the step.
//
// The step is that of an ideal gas with the pressure p = (gamma(f) - 1) E of each cell; bounds and
// rates take the largest gamma and the lowest specific heat of all. What is carried is bounded
// alike, so that where pressure, temperature and velocity are uniform, density, energy and rho f
// are linear in each other on every face and stay so: no waves start where the gases meet.
#pragma once
#include <vector>

#include "ice/step/variables.hpp"
#include "models/mixed_gas.hpp"

namespace sluice::ice {
class QuantityList;
struct MolecularViscosity;
}  // namespace sluice::ice

namespace sluice::ice::scalars {

inline Fluid fluid_of(const models::MixedGas& gas, double f) {
  return ideal_gas(gas.gamma(f), gas.specific_heat(f));
}

// Whether material m of a scene is a mixture itself.
inline bool is_mixed(const models::MixedGas* gas, std::size_t m) {
  return gas != nullptr && static_cast<std::size_t>(gas->material) == m;
}
// Likewise of the options of a graph.
inline bool is_mixed(const SchemeOptions& o, std::size_t m) {
  return is_mixed(o.mixed, m);
}

// The law of each material in a cell, that of a mixed gas by its fraction.
struct LawsOfCells {
  std::vector<Fluid> fluids;
  const models::MixedGas* gas = nullptr;
  In fraction;  // with a mixed gas only

  // `room` holds a law that is made for the cell.
  const Fluid& at(const Row& row, std::size_t m, int i, Fluid& room) const {
    if (!is_mixed(gas, m)) return fluids[m];
    return room = fluid_of(*gas, row(fraction)[i]);
  }
};

// Sets what the gas changes in the options of a scene; `o` has the scalars and coefficients of the
// deck.
void take_mixed_gas(const models::MixedGas& gas, SchemeOptions& o);

// The scalar f among those of the scene, and its old state.
const models::TransportedScalar& fraction_of(const SchemeOptions& o);
VariableId old_fraction(TaskList& list, const SchemeOptions& o);

// p and c of the old state.
void mixed_primitive_row(const models::MixedGas& gas, int n, const double* f, const double* rho,
                         const double* E, double* w, double* p, double* c);
// p and rho c^2, and that at another pressure.
void mixed_pressure_and_modulus_row(const models::MixedGas& gas, int n, const double* f,
                                    const double* E, double* p, double* K);
void mixed_modulus_row(const models::MixedGas& gas, int n, const double* f, const double* p,
                       double* K);
// T = E/(rho cv).
void mixed_temperature_row(const models::MixedGas& gas, int n, const double* f, const double* rho,
                           const double* E, double* T);
// As `law` has it at the gas's own temperature, or that of its fraction.
void mixed_viscosity_row(const models::MixedGas& gas, const MolecularViscosity& law, const Row& row,
                         const double* f, const double* rho, const double* E, double* mu);
void property_row(const models::MixedGas& gas, double models::MixedGas::Node::*property, int n,
                  const double* f, double* values);

// Labels that follow from f.
struct MixedQuantities {
  VariableId pressure, temperature, sound_speed, compressibility;
};
MixedQuantities declare_mixed_quantities(QuantityList& q, VariableId rho, VariableId E);

}  // namespace sluice::ice::scalars
