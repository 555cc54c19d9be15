// Elasticity, crush curve and pores of a soil of grains, water and air (Banerjee and Brannon 2017,
// the model Arena; equations of its chapters in the manuals of Vaango). e is the plastic change of
// volume, logarithmic, positive when the soil dilates; pressures are positive and relative to the
// atmosphere.
//
// Grains, water and air all have K = K_0 + n p (Murnaghan; air: n = gamma, K_0 = gamma p_r).
//   pores, of the pressure zeta:  exp(e) = phi_0 (1 - S_0) a + phi_0 S_0 w + (1 - phi_0) s
// with a, w, s the volumes of air, water and grains at zeta over those at the start; zeta >= 0.
// They are functions of e alone, so that no path and no step changes them:
//   S_w = S_0 w/(S_0 w + (1 - S_0) a),   phi = 1 - (1 - phi_0) s exp(-e)
// The rate form d zeta/d(-e) = exp(e)/B of the manuals is the derivative of the first line.
#pragma once

namespace sluice::mpm {

// Grains, water or air.
struct Murnaghan {
  double K0 = 0, n = 0;  // Pa, 1
  double modulus(double p) const { return K0 + n * p; }
  double volume_ratio(double p, double p_0) const;  // V(p)/V(p_0), pressures in Pa
};

struct WetSoil {
  // At the start: share of pores, saturation, zeta in Pa.
  double phi_0 = 0, S_0 = 0, pressure_0 = 0;
  double p0 = 0, p1 = 0, p1_sat = 1, p2 = 1;      // crush curve: Pa, Pa, 1, 1
  double b0 = 0, b1 = 0, b2 = 0, b3 = 0, b4 = 0;  // bulk modulus of the drained soil, without unit
  double G0 = 0, nu1 = 0, nu2 = 0;                // shear modulus, Pa; Poisson's ratio
  // Granite, water and air as the model's authors have them.
  Murnaghan grains{40e9, 4}, water{2.21e9, 6.029}, air{1.4 * 101325, 1.4};

  struct Pores {
    double pressure = 0;    // zeta, Pa
    double share = 0;       // phi
    double saturation = 0;  // S_w
  };
  Pores pores(double e) const;
  double pore_pressure(double e) const;  // zeta, Pa

  struct Moduli {
    double K = 0, G = 0;  // Pa; K is not finite beyond what the law of the drained soil bears
  };
  // I: trace of the stress that grains bear, tr sigma + 3 zeta, Pa.
  Moduli moduli(double I, const Pores& pores) const;
  double drained_modulus(double p) const;  // K_d, Pa

  double p3() const;                // -ln(1 - phi_0): compaction that leaves no pore
  double crush(double e) const;     // X_d, trace of the stress, Pa, positive: of dry soil
  double strength(double e) const;  // X of the stress that grains bear, Pa, positive
};

}  // namespace sluice::mpm
