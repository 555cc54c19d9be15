// The pressure of an explosive that is partly burnt: Murnaghan's solid and products of JWL in one
// volume, after their shares by mass.
//
//   p   = (1 - f) p_M + f p_J,   p_M = (J^-n - 1)/(n K)
//   p_J = A e^(-R1 J) + B e^(-R2 J) + C J^-(1 + w)
#pragma once
#include <cmath>

namespace sluice::mpm {

struct ExplosiveMixture {
  double K = 0, n = 0;  // compressibility of the solid, 1/Pa, and dK'/dp
  double A = 0, B = 0, C = 0, R1 = 0, R2 = 0, omega = 0;  // Pa, Pa, Pa; the rest without unit
  // Pressures and modulus in Pa, of J and f without unit.

  double solid(double J) const { return (std::pow(J, -n) - 1) / (n * K); }
  double products(double J) const {
    return A * std::exp(-R1 * J) + B * std::exp(-R2 * J) + C * std::pow(J, -1 - omega);
  }
  double pressure(double J, double f) const { return (1 - f) * solid(J) + f * products(J); }
  // -J dp/dJ
  double modulus(double J, double f) const {
    const double of_solid = std::pow(J, -n) / K;
    const double of_products = J * (A * R1 * std::exp(-R1 * J) + B * R2 * std::exp(-R2 * J)) +
                               (1 + omega) * C * std::pow(J, -1 - omega);
    return (1 - f) * of_solid + f * of_products;
  }
};

}  // namespace sluice::mpm
