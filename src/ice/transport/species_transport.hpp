// Molecular transport of a gas whose species spread: mu, lambda and D_k of each cell.
//
// From its temperature, pressure and mass fractions at the start of the step
// (kinetics/transport.hpp). Absent unless the model's <doDiffusion> asks for it.
#pragma once
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Into v.viscosity, v.conductivity and v.scalars.diffusivity.
void add_species_transport(TaskList&, const SchemeVariables&, const SchemeOptions&, int effect);

// The largest of mu/rho, lambda/(rho cv) and D_k, m^2/s, of one state; Y: the fractions carried.
double species_diffusivity(const kinetics::SpeciesGas& gas, double rho, double rho_e,
                           const FractionRows& Y);

}  // namespace sluice::ice
