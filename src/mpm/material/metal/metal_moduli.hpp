// Shear modulus, melting temperature and specific heat of a metal, each in several forms.
#pragma once
#include <string>

#include "mpm/material/base/parameters.hpp"
#include "mpm/material/metal/metal_state.hpp"

namespace sluice::mpm {

// <shear_modulus_model>, Pa:
//   constant_shear  mu_0
//   mts_shear       mu_0 - D/(exp(T_0/T) - 1)
//   scg_shear       mu_0 [1 + A p/eta^(1/3) - B (T - 300 K)]
//   np_shear        [(mu_0 + mu_p p/eta^(1/3))(1 - T^) + rho k T/(C m)]/J,   T^ = T/T_m < 1 + zeta,
//                   J = 1 + exp[-(1 + 1/zeta)/(1 + zeta/(1 - T^))]   (Nadal and Le Poac 2003)
//   ptw_shear       mu_0 (1 + A' p/eta^(1/3))(1 - alpha_p T^)
// Never below 1e-6 mu_0. The state's own `shear` is not read.
struct ShearModulus {
  enum class Form { constant, mts, scg, np, ptw } form = Form::constant;
  // mu_0 Pa; A (or mu_p/mu_0, A') 1/Pa; B 1/K (or alpha_p, no unit); D Pa; T_0 K; zeta and C no
  // unit; atom: m, kg.
  double mu_0 = 0, A = 0, B = 0, D = 0, T_0 = 0, zeta = 0, C = 0, atom = 0;

  double operator()(const MetalState& s) const;
};

// <melting_temp_model>, K:
//   constant_Tm  T_m of the material
//   linear_Tm    T_m0 + b p
//   scg_Tm       T_m0 exp[2 a (1 - 1/eta)] eta^(2 (Gamma_0 - a - 1/3))
struct MeltingTemperature {
  enum class Form { constant, linear, scg } form = Form::constant;
  double T_m0 = 0, a = 0, b = 0, Gamma_0 = 0;  // K, -, K/Pa, -

  double operator()(const MetalState& s) const;
};

// <specific_heat_model>, J/kg/K:
//   constant_Cp  of the material
//   copper_Cp    4.16e-5 T^3 - .027 T^2 + 6.21 T - 142.6 below 270 K, .1009 T + 358.4 above
//   steel_Cp     A + B t + C |t|^-n on either side of T_c, t = T/T_c - 1   (Banerjee 2007)
struct SpecificHeat {
  enum class Form { constant, copper, steel } form = Form::constant;
  double value = 0, T_c = 0;         // J/(kg K), K
  double low[4] = {}, high[4] = {};  // A, B, C in J/(kg K), n

  double operator()(double temperature) const;
};

TagSpec shear_modulus_tag();
TagSpec melting_tag();
TagSpec specific_heat_tag();
// Of the children of `model`, or the constant form.
ShearModulus read_shear_modulus(const Parameters& model, double constant);
MeltingTemperature read_melting(const Parameters& model);
SpecificHeat read_specific_heat(const Parameters& model);

}  // namespace sluice::mpm
