// Rows of the law of a gas of species (kinetics/species_gas.hpp): p = rho R(Y) T, T from e(T, Y).
//
// Each cell has a caloric law of its own, the blend of its species; its temperature is searched
// once a cell and call. Units and shapes as in law_row.hpp.
#pragma once
#include "ice/fluid/fluid.hpp"
#include "ice/fluid/fractions.hpp"
#include "kinetics/species_gas.hpp"

namespace sluice::ice {

// The blend in cell i of the row.
inline eos::Nasa7Heat blend(const kinetics::SpeciesGas& gas, const FractionRows& Y, int i) {
  return gas.heat([&](std::size_t k) { return Y.of[k][i]; });
}

Fluid fluid_of_species(const kinetics::SpeciesGas& gas, const FractionRows& Y, int i);

void species_pressure_row(const kinetics::SpeciesGas& gas, int n, const FractionRows& Y,
                          const double* rho, const double* E, double* p);
// p and K = rho c^2.
void species_pressure_and_modulus_row(const kinetics::SpeciesGas& gas, int n, const FractionRows& Y,
                                      const double* rho, const double* E, double* p, double* K);
void species_modulus_row(const kinetics::SpeciesGas& gas, int n, const FractionRows& Y,
                         const double* rho, const double* p, double* K);
void species_temperature_row(const kinetics::SpeciesGas& gas, int n, const FractionRows& Y,
                             const double* rho, const double* E, double* T);
void species_heat_capacity_row(const kinetics::SpeciesGas& gas, int n, const FractionRows& Y,
                               const double* rho, const double* E, double* cv);

}  // namespace sluice::ice
