// Heat that passes faces of a mixed gas, beside what its temperature gradient does.
//
// What spreads of the fraction f carries the enthalpy by which its two streams differ:
//   q = D rho_f T_f (cp_a - cp_b)/dx
// with rho_f the harmonic and T_f the arithmetic mean: at one pressure a uniform temperature stays
// so. The gas's own conductivity acts beside it; where k = D rho cp, heat and mass spread alike.
#pragma once
#include "ice/step/variables.hpp"

namespace sluice::ice::scalars {

// k of each cell.
void add_conductivity(TaskList&, VariableId conductivity, const SchemeOptions&, int effect);

struct SpreadingHandles {
  In fraction, mass;
};
SpreadingHandles read_spreading(TaskBuilder& task, TaskList& list, VariableId rho,
                                const SchemeOptions& o, int axis);
// Adds to q, W/m^2.
void add_carried_enthalpy(const Row& row, const SpreadingHandles& h, In temperature,
                          const SchemeOptions& o, int axis, double* q);

}  // namespace sluice::ice::scalars
