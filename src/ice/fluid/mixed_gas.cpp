#include "ice/fluid/mixed_gas.hpp"

#include <cmath>

#include "ice/fluid/species_rows.hpp"

namespace sluice::ice {

using models::MixedGas;

Fluid fluid_of(const MixedGas& gas, const FractionRows& rows, int i) {
  if (gas.species) return fluid_of_species(*gas.species->gas, rows, i);
  const double f = rows.alone()[i];
  return ideal_gas(gas.gamma(f), gas.specific_heat(f));
}

void mixed_primitive_row(const MixedGas& gas, int n, const double* __restrict f,
                         const double* __restrict rho, const double* __restrict E,
                         double* __restrict w, double* __restrict p, double* __restrict c) {
  gas.for_each_in_row(n, f, [=](int i, const MixedGas::Between& at) {
    const double ratio = at.ratio();
    w[i] = 1.0 / rho[i];
    p[i] = ratio * E[i];
    c[i] = std::sqrt((1.0 + ratio) * p[i] * w[i]);
  });
}

void mixed_pressure_row(const MixedGas& gas, int n, const double* __restrict f,
                        const double* __restrict E, double* __restrict p) {
  gas.for_each_in_row(n, f, [=](int i, const MixedGas::Between& at) { p[i] = at.ratio() * E[i]; });
}

void mixed_sound_speed_row(const MixedGas& gas, int n, const double* __restrict f,
                           const double* __restrict rho, const double* __restrict p,
                           double* __restrict c) {
  gas.for_each_in_row(n, f, [=](int i, const MixedGas::Between& at) {
    c[i] = std::sqrt((1.0 + at.ratio()) * p[i] / rho[i]);
  });
}

void mixed_pressure_and_modulus_row(const MixedGas& gas, int n, const double* __restrict f,
                                    const double* __restrict E, double* __restrict p,
                                    double* __restrict K) {
  gas.for_each_in_row(n, f, [=](int i, const MixedGas::Between& at) {
    const double ratio = at.ratio();
    p[i] = ratio * E[i];
    K[i] = (1.0 + ratio) * p[i];
  });
}

void mixed_modulus_row(const MixedGas& gas, int n, const double* __restrict f,
                       const double* __restrict p, double* __restrict K) {
  gas.for_each_in_row(
      n, f, [=](int i, const MixedGas::Between& at) { K[i] = (1.0 + at.ratio()) * p[i]; });
}

void mixed_temperature_row(const MixedGas& gas, int n, const double* __restrict f,
                           const double* __restrict rho, const double* __restrict E,
                           double* __restrict T) {
  gas.for_each_in_row(n, f, [=](int i, const MixedGas::Between& at) {
    T[i] = E[i] / (rho[i] * at(&MixedGas::Node::cv));
  });
}

void property_row(const MixedGas& gas, double MixedGas::Node::*property, int n,
                  const double* __restrict f, double* __restrict values) {
  gas.for_each_in_row(n, f, [=](int i, const MixedGas::Between& at) { values[i] = at(property); });
}

}  // namespace sluice::ice
