// What turns with a particle in a step, by Hughes and Winget: exact for rotations of any size.
//
//   L_m = L (I + dt/2 L)^-1,   D = sym L_m,   W = skew L_m   at the middle of the step
//   R   = (I - dt/2 W)^-1 (I + dt/2 W)
//
// A stress of rate form is turned by the half of R to the middle of the step, where D is, takes its
// change there, and is turned by the other half: of second order, where R sigma R^T + C : D is of
// first.
#pragma once
#include <array>
#include <cmath>

#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {

// Of one particle (T: double) or of eight (T: Eight).
template <class T>
struct ObjectiveStepOf {
  std::array<T, 6> strain;     // dt D, without unit: xx, yy, zz, yz, xz, xy
  std::array<T, 9> half_turn;  // R^(1/2), row after row
};
using ObjectiveStep = ObjectiveStepOf<double>;

// The step without rotation: dt sym L, for the plain form of rates. L: 1/s, row after row; dt: s.
template <class T>
inline ObjectiveStepOf<T> plain_step(const std::array<T, 9>& L, double dt) {
  const T one = T{} + 1.0, none{};
  return {{dt * L[0], dt * L[4], dt * L[8], 0.5 * dt * (L[5] + L[7]), 0.5 * dt * (L[2] + L[6]),
           0.5 * dt * (L[1] + L[3])},
          {one, none, none, none, one, none, none, none, one}};
}

template <class T>
inline ObjectiveStepOf<T> objective_step(const std::array<T, 9>& L, double dt) {
  const double h = 0.5 * dt;
  const T a = 1.0 + h * L[0], b = h * L[1], c = h * L[2];
  const T d = h * L[3], e = 1.0 + h * L[4], f = h * L[5];
  const T g = h * L[6], k = h * L[7], l = 1.0 + h * L[8];
  // Inverse of I + dt/2 L by its cofactors.
  const T A = e * l - f * k, B = f * g - d * l, C = d * k - e * g;
  const T per = 1.0 / (a * A + b * B + c * C);
  const std::array<T, 9> inverse = {A * per, (c * k - b * l) * per, (b * f - c * e) * per,
                                    B * per, (a * l - c * g) * per, (c * d - a * f) * per,
                                    C * per, (b * g - a * k) * per, (a * e - b * d) * per};
  // dt L_m = 2 (M - I) M^-1 = 2 (I - M^-1),   M = I + dt/2 L
  const T xy = -2.0 * inverse[1], yx = -2.0 * inverse[3];
  const T xz = -2.0 * inverse[2], zx = -2.0 * inverse[6];
  const T yz = -2.0 * inverse[5], zy = -2.0 * inverse[7];
  ObjectiveStepOf<T> step;
  step.strain = {2.0 * (1.0 - inverse[0]), 2.0 * (1.0 - inverse[4]), 2.0 * (1.0 - inverse[8]),
                 0.5 * (yz + zy),          0.5 * (xz + zx),          0.5 * (xy + yx)};
  // W v = w x v; R by w has tan(angle/2) = |w|/2, so the half of it
  //   v = w/(1 + (1 + |w|^2/4)^(1/2)),   R^(1/2) = I + (V + V^2/2)/(1 + |v|^2/4).
  const T wx = 0.5 * (zy - yz), wy = 0.5 * (xz - zx), wz = 0.5 * (yx - xy);
  const T half = 1.0 / (1.0 + square_root(1.0 + 0.25 * (wx * wx + wy * wy + wz * wz)));
  const T x = half * wx, y = half * wy, z = half * wz;
  const T s = 1.0 / (1.0 + 0.25 * (x * x + y * y + z * z)), t = 0.5 * s;
  step.half_turn = {
      1.0 - t * (y * y + z * z), t * x * y - s * z,         t * x * z + s * y,
      t * x * y + s * z,         1.0 - t * (x * x + z * z), t * y * z - s * x,
      t * x * z - s * y,         t * y * z + s * x,         1.0 - t * (x * x + y * y)};
  return step;
}

}  // namespace sluice::mpm
