// The tangent of the compressible neo-Hookean solid of neo_hook.hpp in closed form.
//
//   W = K/2 ((J^2 - 1)/2 - ln J) + G/2 (J^(-2/3) I_1 - 3),   F = Phi F_0,   T = V_0 dW/dF F_0^T
//   A_ijkm = dT_ij/dPhi_km = V_0 [ (K J^2 + 2/9 g I_1) h_ij h_km + (g I_1/3 - K/2 (J^2 - 1)) h_im
//   h_kj
//                                  + g (d_ik b_jm - 2/3 (f_ij h_km + h_ij f_km)) ]
//   h = Phi^-T, f = F F_0^T, b = F_0 F_0^T, g = G J^(-2/3), I_1 = |F|^2
#pragma once
#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {

struct NeoHookPoint {
  double bulk, shear;  // K, G, Pa
  double volume_0;     // V_0, m^3
  Matrix before, phi;  // F_0, Phi; det(Phi F_0) > 0
};

// A[9 (3 i + j) + 3 k + m], J.
void neo_hook_tangent(const NeoHookPoint& point, double* A);

}  // namespace sluice::mpm
