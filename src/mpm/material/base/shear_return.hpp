// Elastic shear of a neo-Hookean solid with a von Mises yield surface and linear hardening
// (Simo and Hughes 1998, box 9.1; alpha and H of their equation 9.3.21).
//
//   f_bar = J_f^(-1/3) f;   b_tr = f_bar b_e f_bar^T;   s = G dev b_tr
//   phi = |s| - sqrt(2/3) (sigma_Y + H alpha);   where phi > 0, with mu_bar = G tr b_tr/3:
//   dgamma = (phi/(2 mu_bar))/(1 + H/(3 mu_bar)),   s -= 2 mu_bar dgamma s/|s|,
//   alpha += sqrt(2/3) dgamma,   b_e = s/G + m I
//
// m keeps det b_e = 1: m^3 - |d|^2/2 m + det d = 1 with d = s/G. The book takes m = tr b_tr/3,
// which leaves the trial's stored energy in the body: plastic work would be counted twice. Stored:
// 3/2 G (m - 1) per reference volume.
#pragma once
#include <cmath>

#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {

struct ShearState {
  std::array<double, 6> s;  // J times the deviatoric stress, Pa
  std::array<double, 6> b;  // b_e
  double m, alpha;
};

// G > 0. One step f = I + dt L. G, yield and H in Pa; b, f and alpha without unit.
[[gnu::always_inline]] inline ShearState shear_return(const std::array<double, 6>& old_b,
                                                      const std::array<double, 9>& f, double G,
                                                      double yield, double H, double old_alpha) {
  const double root_2_3 = std::sqrt(2.0 / 3), per_G = 1 / G;
  const std::array<double, 6> trial = pushed(old_b, f);
  const double root = inverse_cube_root(determinant(f)), scale = root * root;
  const double mean = scale * (trial[0] + trial[1] + trial[2]) * (1.0 / 3);
  std::array<double, 6> s = {G * (scale * trial[0] - mean), G * (scale * trial[1] - mean),
                             G * (scale * trial[2] - mean), G * scale * trial[3],
                             G * scale * trial[4],          G * scale * trial[5]};
  const double size = std::sqrt(double_dot(s, s));
  const double phi = size - root_2_3 * (yield + H * old_alpha);
  const double excess = phi > 0 ? phi : 0, mu2 = 2 * G * mean;
  const double dgamma = excess / (mu2 + 2.0 / 3 * H);
  const double keep = 1 - mu2 * dgamma / (size + 1e-300);
  for (double& x : s) x *= keep;

  std::array<double, 6> b = s;
  for (double& x : b) x *= per_G;
  const double square = 0.5 * double_dot(b, b);
  const double rest = b[0] * (b[1] * b[2] - b[3] * b[3]) - b[5] * (b[5] * b[2] - b[3] * b[4]) +
                      b[4] * (b[5] * b[3] - b[1] * b[4]) - 1;
  // Newton's method from the trial's m, which is no less: it comes down to the root.
  double m = mean;
  for (int k = 0; k < 4; ++k) m -= (m * (m * m - square) + rest) / (3 * m * m - square);
  b[0] += m;
  b[1] += m;
  b[2] += m;
  return {s, b, m, old_alpha + root_2_3 * dgamma};
}

}  // namespace sluice::mpm
