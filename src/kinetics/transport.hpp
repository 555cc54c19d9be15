// Molecular transport of a mixture, averaged over its species.
//
//   viscosity (Wilke):  mu = sum_k X_k mu_k/sum_j X_j P_kj,
//     P_kj = (1 + (mu_k/mu_j)^(1/2) (W_j/W_k)^(1/4))^2/(8 (1 + W_k/W_j))^(1/2)
//   conductivity (Mathur et al.):  lambda = (sum_k X_k lambda_k + 1/sum_k (X_k/lambda_k))/2
//   diffusion of k into the rest, along the gradient of Y_k:
//     1/D_km = sum_{j != k} X_j/D_jk + X_k/(1 - Y_k) sum_{j != k} Y_j/D_jk
// with the fits of mechanism.hpp in ln T. Beyond the temperatures of the gas the polynomials keep
// their value at the end, and the powers of T beside them go on. Mole fractions below 0 count as
// 0, and to each a trifle is added: so D_km of a pure species is a number, that for traces of all
// others in equal parts.
// References: Wilke, J. Chem. Phys. 18 (1950) 517; Mathur, Tondon, Saxena, Mol. Phys. 12 (1967)
// 569; Kee, Coltrin, Glarborg, Chemically Reacting Flow (2003), section 12.7.
#pragma once
#include <cstddef>
#include <vector>

#include "kinetics/species_gas.hpp"

namespace sluice::kinetics {

// Holds workspaces: one object per thread. Nothing is allocated after construction.
class Transport {
 public:
  explicit Transport(const SpeciesGas& gas);

  // Whether the mechanism has all fits; nothing else may be asked where it has not.
  bool available() const { return available_; }

  // State of a cell for what follows: T > 0, K; Y: mass fractions of all species, in the
  // mechanism's order.
  void set(double T, const double* Y);
  double viscosity() const;     // Pa s
  double conductivity() const;  // W/(m K)
  // D[k] of all species at the pressure p > 0, Pa; m^2/s.
  void diffusion(double p, double* D) const;

 private:
  void fits_at(double T);

  std::size_t count_;
  bool available_;
  double T_min_, T_max_, T_ = 0;
  std::vector<double> molar_mass_;               // kg/mol
  std::vector<Fit> viscosity_, conductivity_;    // by species
  std::vector<Fit> diffusion_;                   // by j * count + k
  std::vector<double> weight_;                   // (W_j/W_k)^(1/4) at k * count + j
  std::vector<double> scale_;                    // 1/(8 (1 + W_k/W_j))^(1/2), likewise
  std::vector<double> root_viscosity_, lambda_;  // of species, at T
  std::vector<double> resistance_;               // 1/(p D_jk), at T
  std::vector<double> X_, Y_;
};

}  // namespace sluice::kinetics
