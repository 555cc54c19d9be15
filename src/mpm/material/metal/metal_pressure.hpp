// <equation_of_state> of a metal: the pressure p (positive in compression) after a step, where E is
// the work of the stress until then, J per m^3 at the start.
//
//   default_hypo   p -= K ln(J_1/J_0)
//   default_hyper  p = -K/2 (J - 1/J)
//   mie_gruneisen  p = rho_0 C_0^2 eta (1 - Gamma_0 eta/2)/(1 - S_1 eta - S_2 eta^2 - S_3 eta^3)^2
//                      + Gamma_0 E,   eta = 1 - J;   rho_0 C_0^2 eta + Gamma_0 E for eta < 0
// E_1 = E_0 + W_dev - (p_0 + p_1)(J_1 - J_0)/2 is solved with p: one step over a shock gives its
// Hugoniot.
#pragma once
#include "mpm/material/base/parameters.hpp"

namespace sluice::mpm {

struct MetalPressure {
  enum class Form { hypo, hyper, mie_gruneisen } form = Form::hypo;
  double K = 0;                                                  // Pa
  double stiffness = 0, Gamma_0 = 0, S_1 = 0, S_2 = 0, S_3 = 0;  // rho_0 C_0^2, Pa
  double expansion = 0;  // alpha, 1/K: of the first two forms

  struct Step {
    double J_0, J_1, p_0, E_0;  // -, -, Pa, J/m^3
    double work;                // W_dev, J/m^3
    double old_temperature;  // that of the stress at the start, of default_hypo; else that of rest
    double temperature;      // K, both
  };
  struct Result {
    double p, modulus;  // -J dp/dJ without exchange of heat, Pa
    bool good = true;   // not past the pole
  };
  Result operator()(const Step& step) const;
};

TagSpec metal_pressure_tag();
MetalPressure read_metal_pressure(const Parameters& model, double K);

}  // namespace sluice::mpm
