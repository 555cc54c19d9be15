// Molecular transport of a gas whose species spread: mu, lambda and D_k of each cell.
//
// From its temperature, pressure and mass fractions at the start of the step
// (kinetics/transport.hpp). What spreads carries enthalpy:
//   q = sum_k rho_f D_k (Y_k,a - Y_k,b)/dx (h_k(T_f) - h_N(T_f)),  N the closure
// with rho_f the harmonic mean, D_k and T_f the arithmetic ones; enthalpies from 0 K on, as what is
// released by forming a species stands in its mass fraction. Absent unless the model's
// <doDiffusion> asks for it.
#pragma once
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Into v.viscosity, v.conductivity and v.scalars.diffusivity.
void add_species_transport(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);

struct SpeciesFluxHandles {
  std::vector<In> fractions;
  In mass, diffusivity;
};
SpeciesFluxHandles read_species_flux(TaskBuilder& task, TaskList& list, const SchemeVariables& v,
                                     const SchemeOptions& o, int axis);
// Adds to q, W/m^2.
void add_species_enthalpy(const Row& row, const SpeciesFluxHandles& h, In temperature,
                          const SchemeOptions& o, int axis, double* q);

}  // namespace sluice::ice
