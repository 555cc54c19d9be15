// Stiffness, crush curve and pore pressure.
#include "mpm/material/geologic/porous_rock.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpm {

double PorousRock::drained_modulus(double I, double e) const {
  double K = B0;
  if (I < 0 && B1 != 0) K += B1 * std::exp(B2 / I);
  if (e < 0 && B3 != 0) K -= B3 * std::exp(B4 / e);
  return K;
}

double PorousRock::porosity(double e) const {
  return std::max(-std::expm1(-(p3 + e)), 0.0);
}

double PorousRock::modulus(double I, double e) const {
  const double K_d = drained_modulus(I, e);
  if (fluid == 0) return K_d;
  const double K_m = B0 + B1, phi = porosity(e), gap = 1 - K_d / K_m;
  const double soft = phi / fluid + (1 - phi) / K_m - K_d / (K_m * K_m);
  return soft > 0 ? K_d + gap * gap / soft : K_d;
}

double PorousRock::crush(double e) const {
  double X;
  if (e > 0) {
    X = p0 * std::pow(1 + e, 1 / (p0 * p1 * p3));
  } else if (e > -p3) {
    X = p0 + std::log1p(e / p3) / p1;
  } else {
    return 1e12 * p0;  // no pore is left
  }
  return fluid == 0 ? X : X * modulus(X, e) / drained_modulus(X, e);
}

double PorousRock::back_stress(double e) const {
  if (fluid == 0) return 0;
  const double K_m = B0 + B1, soft = 1 / fluid - 1 / K_m, phi_0 = porosity(0);
  const double phi = std::max(porosity(e), 1e-12);
  const auto log_odds = [](double x) { return std::log(x / (1 - x)); };
  const double first = log_odds(phi_0) - log_odds(phi);
  const double second = first - (1 / phi_0 - 1 / phi);
  const double p = first / soft + (1 - B0 / K_m) / (B0 * soft * soft) * second;
  return -3 * std::max(p + fluid_pressure, 0.0);
}

}  // namespace sluice::mpm
