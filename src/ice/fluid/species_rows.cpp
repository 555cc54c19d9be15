#include "ice/fluid/species_rows.hpp"

namespace sluice::ice {

using kinetics::SpeciesGas;

namespace {

// Calls use(i, blend, T) with the temperature of each cell.
template <class Use>
void for_temperatures(const SpeciesGas& gas, int n, const FractionRows& Y, const double* rho,
                      const double* E, Use&& use) {
  for (int i = 0; i < n; ++i) {
    const eos::Nasa7Heat heat = blend(gas, Y, i);
    use(i, heat, heat.temperature(E[i] / rho[i]));
  }
}

}  // namespace

Fluid fluid_of_species(const SpeciesGas& gas, const FractionRows& Y, int i) {
  const eos::Nasa7Heat heat = blend(gas, Y, i);
  Fluid fluid;
  fluid.law = eos::PerfectGas<eos::Nasa7Heat>{heat.gas_constant, heat};
  fluid.specific_heat = heat.specific_heat(heat.T_min);
  fluid.gamma = heat.ratio(heat.T_min);
  return fluid;
}

void species_pressure_row(const SpeciesGas& gas, int n, const FractionRows& Y, const double* rho,
                          const double* E, double* p) {
  for_temperatures(gas, n, Y, rho, E, [=](int i, const eos::Nasa7Heat& heat, double T) {
    p[i] = rho[i] * heat.gas_constant * T;
  });
}

void species_pressure_and_modulus_row(const SpeciesGas& gas, int n, const FractionRows& Y,
                                      const double* rho, const double* E, double* p, double* K) {
  for_temperatures(gas, n, Y, rho, E, [=](int i, const eos::Nasa7Heat& heat, double T) {
    p[i] = rho[i] * heat.gas_constant * T;
    K[i] = heat.ratio(T) * p[i];
  });
}

void species_modulus_row(const SpeciesGas& gas, int n, const FractionRows& Y, const double* rho,
                         const double* p, double* K) {
  for (int i = 0; i < n; ++i) {
    const eos::Nasa7Heat heat = blend(gas, Y, i);
    K[i] = heat.ratio(p[i] / (rho[i] * heat.gas_constant)) * p[i];
  }
}

void species_temperature_row(const SpeciesGas& gas, int n, const FractionRows& Y, const double* rho,
                             const double* E, double* T) {
  for_temperatures(gas, n, Y, rho, E,
                   [=](int i, const eos::Nasa7Heat&, double found) { T[i] = found; });
}

void species_heat_capacity_row(const SpeciesGas& gas, int n, const FractionRows& Y,
                               const double* rho, const double* E, double* cv) {
  for_temperatures(gas, n, Y, rho, E, [=](int i, const eos::Nasa7Heat& heat, double T) {
    cv[i] = heat.specific_heat(T);
  });
}

}  // namespace sluice::ice
