// Viscosity and conductivity of one gas as cell fields, from its state.
//
// The functions declare tasks, in a step's graph or in that of the diagnostics.
#pragma once
#include <string>

#include "ice/fluid/law_row.hpp"
#include "ice/step/variables.hpp"
#include "ice/transport/species_transport.hpp"

namespace sluice::ice {

// A state to take them from.
struct StateVariables {
  VariableId rho, energy, velocity;
  bool by_direction = false;  // components of the velocity: of the level, or those of the scheme
};

// Names of the tasks begin with `name`.
struct TransportTask {
  TaskList& list;
  const SchemeOptions& options;
  int effect = 0;
  std::string name;
};

// Molecular viscosity mu (Pa s) of a row of cells that one material fills or shares; rho (kg/m^3),
// rho e (J/m^3): its own.
struct MolecularViscosity {
  TransportModels models;
  double constant = 0;  // <dynamic_viscosity>, Pa s
  int along = 0;        // direction of rows

  // By Sutherland's law, else as the material's law has it; at least that of the layers.
  void operator()(const Row& row, const LawRow& law, const double* rho, const double* energy,
                  double* mu) const;
};

// <dynamic_viscosity> or Sutherland's law, at least that of the layers.
void add_molecular_viscosity(const TransportTask& task, const StateVariables& state,
                             VariableId viscosity);
// mu_t of the turbulence model.
void add_eddy_viscosity(const TransportTask& task, const StateVariables& state, VariableId eddy);
// The dynamic model's part of it (dynamic_smagorinsky.cpp).
void add_dynamic_eddy_viscosity(const TransportTask& task, const StateVariables& state,
                                VariableId eddy);

// All fields that the step of the scheme needs: viscosity, conductivity, what they are made of.
void add_transport(TaskList& list, const TransportInput& v, const SchemeOptions& o,
                   int viscosity_effect, int turbulence_effect);

// Delta, m.
double filter_width(const SchemeOptions& o, Vec3 spacing);

}  // namespace sluice::ice
