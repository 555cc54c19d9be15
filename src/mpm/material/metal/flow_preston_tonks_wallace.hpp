// preston_tonks_wallace (Preston, Tonks and Wallace 2003): sigma_f = 2 tau mu,
//
//   tau = tau_s + a ln[1 - phi exp(-delta - theta eps_p/(a phi))],   a = (s_0 - tau_y)/p,
//   delta = (tau_s - tau_y)/a,   phi = exp delta - 1
//   tau_s = max{s_0 - (s_0 - s_inf) erf[kappa T^ ln(gamma xi/rate)], s_0 (rate/(gamma xi))^beta}
//   tau_y = max{y_0 - (y_0 - y_inf) erf[...], min{y_1 (rate/(gamma xi))^y_2, the same as above}}
//   xi = 1/2 (4 pi rho/(3 M))^(1/3) (mu/rho)^(1/2),   T^ = T/T_m
// tau and the s, y relative to mu: all numbers without unit but mu, Pa, and the rates xi, 1/s.
#pragma once
#include <algorithm>
#include <cmath>

#include "mpm/material/base/parameters.hpp"
#include "mpm/material/metal/metal_state.hpp"

namespace sluice::mpm {

struct PrestonTonksWallace {
  double theta, p, s_0, s_inf, kappa, gamma, y_0, y_inf, y_1, y_2, beta;
  double atom;  // M, kg

  struct Here {
    double mu, kappa_T, gamma_xi;
  };
  Here at(const MetalState& s) const {
    const double xi = 0.5 * std::cbrt(4 * 3.14159265358979323846 * s.density / (3 * atom)) *
                      std::sqrt(s.shear / s.density);
    return {s.shear, kappa * s.temperature / s.melt, gamma * xi};
  }
  double stress(const Here& here, double strain, double rate_) const {
    const double rate = std::max(rate_, min_rate), share = rate / here.gamma_xi;
    const double glide = std::erf(std::max(-here.kappa_T * std::log(share), 0.0));
    const double driven = s_0 * std::pow(share, beta);
    const double tau_s = std::max(s_0 - (s_0 - s_inf) * glide, driven);
    const double tau_y =
        std::max(y_0 - (y_0 - y_inf) * glide, std::min(y_1 * std::pow(share, y_2), driven));
    return 2 * here.mu * hardened(tau_s, tau_y, strain);
  }

  static Tags tags() {
    return {number("theta", "rate of hardening"),
            number("p", "deviation from linear hardening"),
            number("s0", "largest saturation stress, relative to mu"),
            number("sinf", "smallest saturation stress, relative to mu"),
            number("kappa", "dependence on temperature"),
            positive("gamma", "dependence on the rate"),
            number("y0", "largest yield stress, relative to mu"),
            number("yinf", "smallest yield stress, relative to mu"),
            number("y1", "coefficient of the yield stress at high rates"),
            number("y2", "exponent of the yield stress at high rates"),
            number("beta", "exponent of overdriven shocks"),
            positive("M", "mass of an atom, u"),
            number("G0", "coefficient of the shear modulus, used by <shear_modulus_model>", 0),
            number("alpha", "coefficient of the shear modulus, used by <shear_modulus_model>", 0),
            number("alphap", "coefficient of the shear modulus, used by <shear_modulus_model>", 0)};
  }
  static PrestonTonksWallace read(const Parameters& q) {
    return {q.real("theta"), q.real("p"),     q.real("s0"),   q.real("sinf"),
            q.real("kappa"), q.real("gamma"), q.real("y0"),   q.real("yinf"),
            q.real("y1"),    q.real("y2"),    q.real("beta"), q.real("M") * 1.66053906660e-27};
  }

 private:
  double hardened(double tau_s, double tau_y, double strain) const {
    const double reach = tau_s - tau_y;
    if (!(reach > 1e-14 * tau_s)) return tau_s;
    const double a = p == 0 ? 0 : (s_0 - tau_y) / p;
    if (!(a > 0)) return tau_s - reach * std::exp(-theta * strain / reach);  // Voce
    const double delta = reach / a, phi = std::expm1(delta);
    return tau_s + a * std::log1p(-phi * std::exp(-delta - theta * strain / (a * phi)));
  }
};

}  // namespace sluice::mpm
