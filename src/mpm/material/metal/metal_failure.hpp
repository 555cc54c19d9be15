// Pores, and when a metal becomes unstable. Stresses and moduli in Pa; strains, porosities and the
// constants of pores have no unit.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "mpm/material/base/parameters.hpp"
#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {

// <yield_condition>: vonMises, or gurson (Gurson 1977, Tvergaard and Needleman 1984):
//   sigma_eq^2 = sigma_f^2 [1 + q_3 f*^2 - 2 q_1 f* cosh(q_2 tr sigma/(2 sigma_f))],
//   f* = f, or f_c + k (f - f_c) beyond f_c
struct YieldCondition {
  bool porous = false;
  double q_1 = 0, q_2 = 0, q_3 = 0, k = 0, f_c = 0;

  // sigma_eq at yield over sigma_f > 0.
  double share(double flow, double trace_of_stress, double porosity) const {
    if (!porous) return 1;
    const double f = porosity <= f_c ? porosity : f_c + k * (porosity - f_c);
    const double argument = std::clamp(q_2 * trace_of_stress / (2 * flow), -30.0, 30.0);
    return std::sqrt(std::max(0.0, 1 + q_3 * f * f - 2 * q_1 * f * std::cosh(argument)));
  }
};

// Growth and nucleation (Chu and Needleman 1980):
//   f += (1 - f) max(ln(J_1/J_0), 0) + A d eps_p,
//   A = f_n/(s_n (2 pi)^(1/2)) exp(-((eps_p - eps_n)/s_n)^2/2)
struct Pores {
  bool evolve = true;
  double mean = 0.002, deviation = 0, critical = 0.5;
  double f_n = 0.1, eps_n = 0.3, s_n = 0.1;

  double grown(double f, double dilation, double strain, double more_strain) const {
    const double x = (strain - eps_n) / s_n;
    const double A = f_n / (s_n * 2.5066282746310002) * std::exp(-0.5 * x * x);
    return std::clamp(f + (1 - f) * std::max(dilation, 0.0) + A * more_strain, 0.0, 0.999);
  }
  double at_start(std::int64_t id) const;
};

// <stability_check>.
enum class Stability { none, drucker, becker, drucker_becker };
// While a metal yields along the unit deviator N with d sigma_f/d eps_p = hardening, mu and K:
//   drucker  D : C_ep : D <= 0 for the step's strain D
//   becker   det(n C_ep n) <= 0 for some n in the plane of the largest and least stress
//            (Rudnicki and Rice 1975; Becker 2002): with c = (2 mu)^2/(2 mu + 2/3 hardening),
//            c max_x [(N_1^2 x + N_3^2 (1 - x))/mu - beta (N_1 x + N_3 (1 - x))^2] >= 1,
//            beta = (K + mu/3)/(mu (K + 4 mu/3)), 0 <= x <= 1
bool unstable(Stability check, const Symmetric& strain, const Symmetric& N, double mu, double K,
              double hardening);

TagSpec yield_condition_tag();
TagSpec stability_tag();
Tags pore_tags();
YieldCondition read_yield_condition(const Parameters& model);
Stability read_stability(const Parameters& model);
Pores read_pores(const Parameters& model);

}  // namespace sluice::mpm
