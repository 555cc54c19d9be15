// What holds two materials together at a point between them: traction against separation.
//
// X.-P. Xu, A. Needleman, Modelling Simul. Mater. Sci. Eng. 1 (1993) 111, with r = 0:
//
//   t_n = phi_n/d_n e^{-D_n/d_n} D_n/d_n (E + (1 - q)(1 - E)),     E = e^{-(D_t/d_t)^2}
//   t_t = 2 q phi_n/d_t D_t/d_t (1 + D_n/d_n) e^{-D_n/d_n} E,      for each of two tangents
//   phi_n = e sig_max d_n, phi_t = sqrt(e/2) tau_max d_t, q = phi_t/phi_n
//
// D = D_n n + D_t1 t_1 + D_t2 t_2 is what the material above has moved against the one below. In
// t_n the format takes E of the first tangent alone.
#pragma once
#include "framework/base/vec3.hpp"
#include "mpm/deck/mpm_scene.hpp"

namespace sluice::mpm {

// Normal and two tangents, of length 1.
struct CohesiveFrame {
  Vec3 normal{}, first{}, second{};
};
CohesiveFrame cohesive_frame(Vec3 normal, Vec3 tangent);

// On the material below, per area, Pa; the material above has the opposite. Separations in m.
Vec3 cohesive_traction(const CohesiveZone& zone, const CohesiveFrame& frame, Vec3 separation);

// Has a sound point come so far apart that it begins to fail.
bool cohesive_failure(const CohesiveZone& zone, const CohesiveFrame& frame, Vec3 separation);
// A failed point loses a thousandth of its traction in every step that opens it.
inline constexpr double failure_steps = 1000;

// The largest slope of the traction, that of a closed point, Pa/m.
double cohesive_stiffness(const CohesiveZone& zone);

}  // namespace sluice::mpm
