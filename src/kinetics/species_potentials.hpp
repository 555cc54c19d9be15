// Enthalpy, entropy and potential of pure species at one temperature, consistent with SpeciesGas.
//
//   h_k = e_k + R_k T + e0_k (SpeciesGas),   ds_k = cp_k dT/T,   g_k = h_k - T s_k
// s_k is that of the polynomials of the low range within it; above, and where cp keeps its value
// beyond the ranges, it goes on as the integral, as h does. So dg = -s dT everywhere, and where
// reactions are at rest by these g_k the entropy of the same gas is highest. All are of moles,
// divided by R T or R; s and g at reference_pressure.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "kinetics/species_gas.hpp"

namespace sluice::kinetics {

class SpeciesPotentials {
 public:
  explicit SpeciesPotentials(const SpeciesGas& gas);

  // Sets what follows for T > 0, K.
  void at(double T);
  // Of all species, in the mechanism's order.
  const double* heat() const { return heat_.data(); }          // cp/R
  const double* enthalpy() const { return enthalpy_.data(); }  // h/(R T)
  const double* gibbs() const { return gibbs_.data(); }        // g/(R T)

 private:
  // Coefficients a1 to a7 as in mechanism.hpp.
  using Row = std::array<double, 7>;
  // Below the lowest temperature of the fits, in the two ranges, above the highest.
  std::array<std::vector<Row>, 4> rows_;
  std::array<double, 3> bounds_{};
  std::vector<double> heat_, enthalpy_, gibbs_;
};

}  // namespace sluice::kinetics
