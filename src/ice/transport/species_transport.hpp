// Molecular transport of a gas whose species spread: mu, lambda and D_k of each cell.
//
// From its temperature, pressure and mass fractions at the start of the step
// (kinetics/transport.hpp). What spreads carries enthalpy:
//   q = sum_k rho_f D_k (Y_k,a - Y_k,b)/dx (h_k(T_f) - h_N(T_f)),  N the closure
// with rho_f the harmonic mean, D_k and T_f the arithmetic ones; enthalpies from 0 K on, as what is
// released by forming a species stands in its mass fraction. Absent unless the model's
// <doDiffusion> asks for it.
#pragma once
#include <optional>
#include <vector>

#include "ice/fluid/fractions.hpp"
#include "ice/step/variables.hpp"

namespace sluice::kinetics {
class Transport;
}

namespace sluice::ice {

struct SpeciesCoefficients {
  VariableId rho, energy, viscosity, conductivity;
  std::optional<VariableId> diffusivity;  // by carried species; none: not asked for
};
// A task that fills them.
void add_species_coefficients(TaskBuilder task, TaskList& list, const SchemeOptions& o,
                              const SpeciesCoefficients& v);

// The coefficients of a step, and the state from which they follow.
struct TransportInput {
  VariableId rho, energy, velocity;
  VariableId viscosity, conductivity;              // written
  VariableId molecular_viscosity, eddy_viscosity;  // written, with turbulence
  VariableId diffusivity;                          // written, of species that spread

  static TransportInput of(const SchemeVariables& v) {
    return {.rho = v.rho,
            .energy = v.energy,
            .velocity = v.velocity,
            .viscosity = v.viscosity,
            .conductivity = v.conductivity,
            .molecular_viscosity = v.molecular_viscosity,
            .eddy_viscosity = v.eddy_viscosity,
            .diffusivity = v.scalars.diffusivity};
  }
};
void add_species_transport(TaskList&, const TransportInput&, const SchemeOptions&, int effect);

// The largest of mu, lambda/cv and rho D_k of one state (kg/m^3, J/m^3), Pa s: what bounds the
// first step.
double species_coefficient(const kinetics::SpeciesGas& gas, kinetics::Transport& transport,
                           double rho, double rho_e, const FractionRows& Y);

struct SpeciesFluxHandles {
  std::vector<In> fractions;
  In mass, diffusivity;
};
struct SpeciesFluxInput {
  VariableId rho, diffusivity;
};
SpeciesFluxHandles read_species_flux(TaskBuilder& task, TaskList& list, const SpeciesFluxInput& v,
                                     const SchemeOptions& o, int axis);
// Adds to q, W/m^2.
void add_species_enthalpy(const Row& row, const SpeciesFluxHandles& h, In temperature,
                          const SchemeOptions& o, int axis, double* q);

}  // namespace sluice::ice
