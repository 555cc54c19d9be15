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
#include <algorithm>

namespace sluice::ice {

// threshold: largest relative change by waves of the density, and of the pressure above the lowest
//   of the equation of state, from a cell to its ghost cell; unit: 1; test:
//   WaveGhosts.KeepDensityAndPressurePositiveBehindSteepSlopes
constexpr double max_change_by_waves = 0.5;

// A cell in the frame of the face: component 0 along the outward normal, then tangents. kg/m^3, Pa
// and m/s; of slopes the same per m.
struct WaveState {
  double rho = 0, p = 0, u[3] = {0, 0, 0};
};

// (b - a) * scale, scale in 1/m.
inline WaveState slope_from(const WaveState& a, const WaveState& b, double scale) {
  return {(b.rho - a.rho) * scale,
          (b.p - a.p) * scale,
          {(b.u[0] - a.u[0]) * scale, (b.u[1] - a.u[1]) * scale, (b.u[2] - a.u[2]) * scale}};
}

struct WaveCell {
  WaveState here, normal, along[2];     // the state; its derivatives outward and along two tangents
  double sound_speed = 1;               // m/s
  double spacing = 1, domain_size = 1;  // along the normal, m
  // The flow far away: its pressure always; where it is given the rest, which inflow is drawn to.
  bool far_known = false;
  WaveState far;
  double pull = 0;  // sigma, a factor without unit
  // What carries vortices (its velocity alone): the flow far away, or means.
  bool carrier_known = false;
  WaveState carrier;
};

// Functions of one cell choose between numbers, never between ways: rows of cells vectorise.

// c - (U - U0). The flow in a cell may be far from what carries vortices, as in a jet beside its
// mean or behind a shock: it makes the wave at most twice as strong. m/s.
inline double speed_past(const WaveCell& cell) {
  const double c = cell.sound_speed, U = cell.here.u[0];
  const double past = std::max(c - (U - cell.carrier.u[0]), 0.5 * c);
  return cell.carrier_known ? past : c;
}

// What the flow along the face adds to G-, Pa/m.
inline double transverse_part(const WaveCell& cell) {
  const WaveState& s = cell.here;
  const double c = cell.sound_speed;
  double sum = 0;
  for (int t = 0; t < 2; ++t) {
    const WaveState& d = cell.along[t];
    const double speed = s.u[1 + t] - cell.carrier.u[1 + t];
    sum += (speed * d.p + s.rho * c * c * d.u[1 + t]) - s.rho * c * speed * d.u[0];
  }
  return 0.5 * sum / speed_past(cell);
}

// What is the same all the way out to the ghosts.
struct LeavingWaves {
  double out = 0, in = 0;  // G+; G- without its transverse part; Pa/m
  double hears = 0;        // 1 where that part counts
  double entropy = 0;      // rho' without p', kg/m^4
  double all_leave = 0;    // 1 where the flow is faster than sound: slopes stay as they are inside
  WaveState inside;        // slopes; shear only where it leaves
};

inline LeavingWaves leaving_waves(const WaveCell& cell) {
  const WaveState &s = cell.here, &d = cell.normal, &far = cell.far;
  const double c = cell.sound_speed, U = s.u[0], mach = U / c;
  const bool enters = U < 0, none_out = U <= -c, none_in = mach <= -1.0;
  const double G = 0.5 * (d.p + s.rho * c * d.u[0]);
  const double to_far = cell.pull * s.rho * c * (1.0 + mach) * (U - far.u[0]) / cell.domain_size;
  const double back = -0.5 * cell.pull * (1.0 + mach) * (s.p - far.p) / cell.domain_size;
  const double entering = cell.far_known ? to_far : 0.0, in = enters ? entering : back;
  // No further than to the target in one cell.
  const double rate = cell.pull * (c - U * U / c) / cell.domain_size;
  const double drawn = -std::min(rate / -U, 1.0 / cell.spacing) * (s.rho - far.rho);
  const double enters_with = cell.far_known ? drawn : 0.0;
  const double leaves_with = d.rho - d.p / (c * c);
  const double heard = enters ? 0.0 : 1.0;
  LeavingWaves w;
  w.out = none_out ? 0.0 : G;
  w.in = none_in ? 0.0 : in;
  w.hears = none_in ? 0.0 : heard;
  w.entropy = enters ? enters_with : leaves_with;
  w.all_leave = U >= c ? 1.0 : 0.0;
  w.inside = {d.rho, d.p, {d.u[0], enters ? 0.0 : d.u[1], enters ? 0.0 : d.u[2]}};
  return w;
}

// Derivatives along the outward normal with which ghosts continue a cell of this density and sound
// speed; `transverse`: that part of G- on the way to them, Pa/m.
inline WaveState outward_slopes(const LeavingWaves& w, double rho, double c, double transverse) {
  const double heard = transverse + w.in, in = w.hears != 0 ? heard : w.in;
  const double p = w.out + in, u = (w.out - in) / (rho * c), of_density = w.entropy + p / (c * c);
  const bool all_leave = w.all_leave != 0;
  return {all_leave ? w.inside.rho : of_density,
          all_leave ? w.inside.p : p,
          {all_leave ? w.inside.u[0] : u, w.inside.u[1], w.inside.u[2]}};
}

}  // namespace sluice::ice
