// Elasticity and pores of rock: stiffness, the curve along which pores are crushed, and the fluid
// that fills them (Homel, Guilkey and Brannon 2015, Acta Mechanica 227).
//
//   K_d = B0 + B1 exp(B2/I) [I < 0] - B3 exp(B4/e) [e < 0],   e: plastic change of volume
//   X_d = p0 + ln(1 + e/p3)/p1 for e <= 0,   p0 (1 + e)^(1/(p0 p1 p3)) for e > 0
// Pores of share phi = 1 - exp(-(p3 + e)) that are full of a fluid of bulk modulus K_f, in a matrix
// of bulk modulus K_m = B0 + B1 (Gassmann 1951):
//   K = K_d + (1 - K_d/K_m)^2/(phi/K_f + (1 - phi)/K_m - K_d/K_m^2),   X = X_d K/K_d
// zeta = -3 p_f: the trace of the stress at which the frame bears nothing. Where the frame yields
// at its stress, matrix and fluid bear all further pressure, side by side: the body's modulus is
// 1/K_R = phi/K_f + (1 - phi)/K_m. With K as elastic modulus that asks for
//   dp_f/de = -1/(1/K_R - 1/K) = -(1/w + g/(K_0 w^2)),  w = phi (1/K_f - 1/K_m),  g = 1 - K_0/K_m
// (K_0 = B0, of the frame at rest), which is integrated by d phi/de = 1 - phi; p_f >= 0.
#pragma once

namespace sluice::mpm {

struct PorousRock {
  double B0 = 0, B1 = 0, B2 = 0, B3 = 0, B4 = 0;  // Pa, Pa, Pa, Pa, 1
  double p0 = 0, p1 = 0, p3 = 0;                  // Pa, 1/Pa, 1
  double fluid = 0, fluid_pressure = 0;           // K_f < K_m and p_0, Pa; dry where K_f is 0

  // I in Pa, e without unit.
  double drained_modulus(double I, double e) const;  // K_d, Pa
  double modulus(double I, double e) const;          // K, Pa
  double porosity(double e) const;                   // phi
  double crush(double e) const;                      // X, Pa, with the share of the fluid
  double back_stress(double e) const;                // zeta, Pa
};

}  // namespace sluice::mpm
