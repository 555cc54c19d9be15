// Fluids of tests.
#pragma once
#include "ice/fluid/fluid.hpp"

namespace sluice::ice {

inline Fluid stiffened_gas(double gamma, double pinf, double cv = 1000) {
  eos::StiffenedGas law;
  law.gamma = gamma;
  law.pinf = pinf;
  law.specific_heat = cv;
  return {law, std::nullopt, gamma, cv};
}

// Products of a high explosive.
inline Fluid jwl() {
  eos::Jwl law;
  law.A = 6.3e11;
  law.B = 8e9;
  law.R1 = 4.3;
  law.R2 = 1.2;
  law.om = .35;
  law.rho0 = 1840;
  law.specific_heat = 1000;
  return {law, std::nullopt, 1.35, 1000};
}

}  // namespace sluice::ice
