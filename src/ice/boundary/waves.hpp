// Faces that waves leave without coming back (LODI): normal derivatives from waves.
//
// Along the outward normal, with U the velocity along it and ' a one-sided difference (of pressure:
// less the hydrostatic one):
//   outgoing  G+ = (p' + rho c U')/2                            as it is in the domain
//   incoming  G- = T/(c - U + U0) - sigma (1 + U/c)(p - p_inf)/(2 L)
//   entropy and shear: as they are where the flow leaves; 0 where it enters
//   p' = G+ + G-,  rho c U' = G+ - G-
// T: what the flow along the face does to the incoming wave, ((u_t - V0).d_t p + rho c^2 d_t.u_t -
// rho c (u_t - V0).d_t U)/2: a vortex that is carried through the face at (U0, V0) then needs no
// incoming wave (Yoo and Im, with their weight 1 - U/c of T). That velocity is the one far away, if
// given, otherwise means over open faces (open_faces.cpp); without either U0 = U and V0 = 0. Faster
// than sound nothing comes in, or everything does.
// The local Mach number takes the place of the largest one on the face.
// References: Poinsot and Lele, J. Comput. Phys. 101 (1992) 104; Sutherland and Kennedy, J. Comput.
// Phys. 191 (2003) 502; Yoo and Im, Combust. Theory Model. 11 (2007) 259.
#pragma once
#include "ice/boundary/flow_conditions.hpp"

namespace sluice::ice {

// A cell in the frame of the face: component 0 along the outward normal, then tangents.
struct WaveState {
  double rho = 0, p = 0, u[3] = {0, 0, 0};
};

struct WaveCell {
  WaveState here, normal, along[2];  // the state; its derivatives outward and along two tangents
  double sound_speed = 1;
  double spacing = 1, domain_size = 1;  // along the normal, m
  // The flow far away, where it is given: what inflow is drawn to, and what carries vortices.
  bool far_known = false;
  WaveState far;
  // What carries vortices where it is not (its velocity alone).
  bool carrier_known = false;
  WaveState carrier;
};

// What the flow along the face adds to G-.
double transverse_part(const WaveCell& cell);

// Derivatives along the outward normal with which ghosts continue the cell; `transverse`: that part
// on the way to them.
WaveState outward_slopes(const WaveCell& cell, double transverse, const LodiSettings& settings);

}  // namespace sluice::ice
