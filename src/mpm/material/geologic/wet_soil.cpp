// Moduli, crush curve and pore pressure of soil.
#include "mpm/material/geologic/wet_soil.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sluice::mpm {

double Murnaghan::volume_ratio(double p, double p_0) const {
  if (n == 0) return std::exp(-(p - p_0) / K0);
  return std::pow(modulus(p) / modulus(p_0), -1 / n);  // d ln V = -dp/K
}

// Newton's method from zeta = 0: the volume of all three falls with zeta and is convex, so that no
// step goes beyond the root.
double WetSoil::pore_pressure(double e) const {
  const double share[] = {phi_0 * (1 - S_0), phi_0 * S_0, 1 - phi_0};
  const Murnaghan* phase[] = {&air, &water, &grains};
  const double volume = std::exp(e);
  double zeta = 0;
  for (int step = 0; step < 200; ++step) {
    double over = -volume, slope = 0;
    for (int k = 0; k < 3; ++k) {
      if (share[k] == 0) continue;
      const double part = share[k] * phase[k]->volume_ratio(zeta, pressure_0);
      over += part;
      slope += part / phase[k]->modulus(zeta);
    }
    if (!(over > 0)) return zeta;  // at 0: the pores give way, and fluid does not pull
    const double next = zeta + over / slope;
    if (!(next > zeta * (1 + 1e-15))) return next;
    zeta = next;
  }
  return zeta;
}

WetSoil::Pores WetSoil::pores(double e) const {
  Pores pores;
  pores.pressure = pore_pressure(e);
  const double w = S_0 == 0 ? 0 : S_0 * water.volume_ratio(pores.pressure, pressure_0);
  const double a = S_0 == 1 ? 0 : (1 - S_0) * air.volume_ratio(pores.pressure, pressure_0);
  pores.saturation = w / (w + a);
  const double s = grains.volume_ratio(pores.pressure, pressure_0);
  pores.share = std::max(1 - (1 - phi_0) * s * std::exp(-e), 0.0);
  return pores;
}

// p = K_s(p) (b0 x + b1 x^b4/(b2 x^b4 + b3)) of the elastic strain x; with the term of b0 left out
// where x is sought, as the model's authors do:
//   x^b4 = b3 p/(b1 K_s - b2 p)
//   K_d = dp/dx = K_s/(1 - n_s p/K_s) (b0 + b1 b3 b4 x^(b4 - 1)/(b2 x^b4 + b3)^2)
double WetSoil::drained_modulus(double p) const {
  if (p <= 0) return b0 * grains.K0;
  const double K_s = grains.modulus(p), outer = K_s * K_s / (K_s - grains.n * p);
  if (b1 == 0) return outer * b0;
  const double left = b1 * K_s - b2 * p;
  if (!(left > 0)) return std::numeric_limits<double>::infinity();
  const double y = b3 * p / left, z = b2 * y + b3;
  return outer * (b0 + b1 * b3 * b4 * std::pow(y, 1 - 1 / b4) / (z * z));
}

WetSoil::Moduli WetSoil::moduli(double I, const Pores& pores) const {
  const double p = -I / 3, K_s = grains.modulus(std::max(p, 0.0)), K_d = drained_modulus(p);
  // nu = nu1 + nu2 exp(-K_d/K_s), G = 3 K_d (1 - 2 nu)/(2 (1 + nu))
  const double nu = nu1 + nu2 * std::exp(-K_d / K_s);
  const double G = nu > 0 ? 1.5 * K_d * (1 - 2 * nu) / (1 + nu) : G0;
  if (p <= 0 || pores.saturation == 0) return {K_d, G};
  // Biot and Gassmann, 1/K_f = S_w/K_w + (1 - S_w)/K_a:
  //   K = K_d + (1 - K_d/K_s)^2/((1 - K_d/K_s)/K_s + phi (1/K_f - 1/K_s))
  const double per_K_f = pores.saturation / water.modulus(pores.pressure) +
                         (1 - pores.saturation) / air.modulus(pores.pressure);
  const double gap = 1 - K_d / K_s;
  const double soft = gap / K_s + pores.share * (per_K_f - 1 / K_s);
  return {gap > 0 && soft > 0 ? K_d + gap * gap / soft : K_d, G};
}

double WetSoil::p3() const {
  return -std::log1p(-phi_0);
}

// X_d = p0 + p1 (phi_0/phi - 1)^(1/p2), phi = 1 - exp(-p3 - e), of compacted soil; p0 of other.
// A billionth of the pores is kept: the strength stays a number, far beyond all others.
double WetSoil::crush(double e) const {
  if (e >= 0) return p0;
  const double phi = std::max(-std::expm1(-p3() - e), 1e-9 * phi_0);
  return p0 + p1 * std::pow(std::max(phi_0 / phi - 1, 0.0), 1 / p2);
}

// X = p0 + (1 - S_0 + p1_sat S_0) (X_d - p0)
double WetSoil::strength(double e) const {
  return p0 + (1 - S_0 + p1_sat * S_0) * (crush(e) - p0);
}

}  // namespace sluice::mpm
