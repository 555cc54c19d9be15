// Steps 4, 5 and 8 of the third order: what the states on both sides of a face make of it, and what
// passes through it.
//
// Impedances as in one_material/faces.cpp (Dukowicz with one correction), here of the traced
// densities: z = rho w, w = c + A max(0, squeeze), c of the cells; each w then rises to what the
// velocity that follows from it asks for, as it must where a dense gas meets a thin one. Between
// two waves that move with u_L - w_L and u_R + w_R lies one velocity and one pressure,
//   u* = ((z_L u_L + z_R u_R) + (p_L - p_R))/(z_L + z_R)
//   p* = ((z_R p_L + z_L p_R) + z_L z_R (u_L - u_R))/(z_L + z_R),
// and on either side of the contact, K the side that u* leaves, d = u* - u_L or u_R - u*,
//   rho* = rho_K w/(w + d),   E* = (w E_K - d p_K)/(w + d) + rho* d^2/2,
//   w = max(w_K, c_K + max(A, 1) max(0, -d))  (the shock that d drives: w + d > 0)
// (the three waves of HLLC: Toro, Spruce, Speares, Shock Waves 4 (1994) 25). A face that both waves
// leave to one side has the state of the other. Then, l = dt/dx,
//   u_f = u*, p_f = p*, F = l u* rho*, U = (u*, what is tangential in K), G = l u* E*:
// the form in which the Lagrangian phase and the update of the default scheme take them, so that
// all that acts on faces, on the boundary and between levels acts here alike.
// Sides that part fast leave next to no pressure, as in one_material/faces.cpp; no factor takes
// dissipation from slow flow: jumps of parabolas are small there.
// On a wall the cell inside meets its own image. Where the velocity through a side is given so is
// u_f; what flows in there is the state of the ghost cell.
#include "ice/fluid/limiters.hpp"
#include "ice/parabolas/tasks.hpp"
#include "ice/step/held_faces.hpp"
#include "ice/step/wall_faces.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In rho, energy, velocity, sound, traced;
  Out face_velocity, face_pressure, flux;
};

struct Law {
  double shock_slope = 1, driving_slope = 1;  // of impedances; of shocks before contacts, >= 1
  double pi = 0;                              // minus the lowest pressure
  double energy_of_pressure = 0;              // 1/(gamma - 1) of an ideal gas
};

struct Side {
  double rho, u, p, E;  // E: J/m^3
};
struct Star {
  double u, p;
};
struct Passing {
  double rho, u, p, E;
};

// Pressure that parting sides leave: faces.cpp. z: z_L z_R/(z_L + z_R).
[[gnu::always_inline]] inline double without_pull(double p, double du, double z, double sounds,
                                                  const Law& law) {
  const double parting = -du * (law.shock_slope - 1.0) - 0.6 * sounds;
  return larger(p, smaller(-law.pi, p + 30.0 * z * larger(0.0, parting)));
}

// What passes a face with the star state behind the wave in K, which moves with w: at least as fast
// as the shock that the contact drives. d: how much faster the contact leaves the wave than K does.
[[gnu::always_inline]] inline Passing behind_wave(const Side& K, double w, double d,
                                                  const Star& star) {
  const double inverse = 1.0 / (w + d), rho = K.rho * w * inverse;
  return {rho, star.u, star.p, (w * K.E - d * K.p) * inverse + 0.5 * rho * (d * d)};
}

// The state on the face between L and R, and from which side it comes.
[[gnu::always_inline]] inline Passing solve_face(const Side& L, const Side& R, double ca, double cb,
                                                 const Law& law, bool& left) {
  const double A = law.shock_slope, du = L.u - R.u;
  const double squeeze = 0.5 * A * larger(0.0, du);
  double zL = L.rho * (ca + squeeze), zR = R.rho * (cb + squeeze);
  const double u0 = ((zL * L.u + zR * R.u) + (L.p - R.p)) / (zL + zR);
  double wL = ca + A * larger(0.0, L.u - u0), wR = cb + A * larger(0.0, u0 - R.u);
  zL = L.rho * wL;
  zR = R.rho * wR;
  const double u1 = ((zL * L.u + zR * R.u) + (L.p - R.p)) / (zL + zR);
  wL = larger(wL, ca + A * larger(0.0, L.u - u1));
  wR = larger(wR, cb + A * larger(0.0, u1 - R.u));
  zL = L.rho * wL;
  zR = R.rho * wR;
  const double inverse = 1.0 / (zL + zR), z = zL * zR * inverse;
  Star star;
  star.u = ((zL * L.u + zR * R.u) + (L.p - R.p)) * inverse;
  star.p = without_pull((zR * L.p + zL * R.p) * inverse + z * du, du, z, ca + cb, law);
  left = star.u >= 0.0;
  const Side K{left ? L.rho : R.rho, left ? L.u : R.u, left ? L.p : R.p, left ? L.E : R.E};
  const double d = left ? star.u - L.u : R.u - star.u;
  const double w = larger(left ? wL : wR, (left ? ca : cb) + law.driving_slope * larger(0.0, -d));
  const double speed = left ? L.u : -R.u;
  const Passing in = behind_wave(K, w, d, star);
  const bool past = speed >= w;
  return {past ? K.rho : in.rho, past ? K.u : in.u, past ? K.p : in.p, past ? K.E : in.E};
}

// Rows of the traced states at both sides of the faces, and what is written.
template <int C, bool Scaled>
struct Rows {
  static constexpr int pressure = 1 + C, quantities = C + (Scaled ? 3 : 2);
  const double *L[quantities], *R[quantities], *ca, *cb;
  double *uf, *pf, *F, *G, *U[C];
  double l = 0;
  Law law;

  Rows(const Row& row, const Handles& h, int axis, double l_of, const Law& law_of)
      : ca(row(h.sound, 0, axis, -1)),
        cb(row(h.sound)),
        uf(row(h.face_velocity)),
        pf(row(h.face_pressure)),
        F(row(h.flux, 0)),
        G(row(h.flux, 1)),
        l(l_of),
        law(law_of) {
    for (int q = 0; q < quantities; ++q) {
      L[q] = row(h.traced, q, axis, -1);
      R[q] = row(h.traced, quantities + q);
    }
    for (int c = 0; c < C; ++c) U[c] = row(h.flux, 2 + c);
  }
  [[gnu::always_inline]] Side side(const double* const* q, int axis, int i) const {
    const double p = q[pressure][i];
    return {q[0][i], q[1 + axis][i], p, Scaled ? q[2 + C][i] : law.energy_of_pressure * p};
  }
  [[gnu::always_inline]] void write(int i, const Passing& f) const {
    uf[i] = f.u;
    pf[i] = f.p;
    F[i] = l * f.u * f.rho;
    G[i] = l * f.u * f.E;
  }
};

template <int C, bool Scaled, int axis>
void face_row(const Rows<C, Scaled>& rows, int n) {
  const Rows<C, Scaled> r = rows;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    bool left = false;
    const Passing f =
        solve_face(r.side(r.L, axis, i), r.side(r.R, axis, i), r.ca[i], r.cb[i], r.law, left);
    r.write(i, f);
    for (int c = 0; c < C; ++c) {
      const double a = r.L[1 + c][i], b = r.R[1 + c][i];
      r.U[c][i] = c == axis ? f.u : (left ? a : b);
    }
  }
}

// A wall on the face that moves with u: the cell inside meets its image; plus: it is on the low
// side. What flows in is the ghost cell's state.
template <int C, bool Scaled>
void wall_face(const Row& row, const Handles& h, const Rows<C, Scaled>& r, int axis, int i,
               bool plus, double u) {
  const double* const* inside = plus ? r.L : r.R;
  const Side K = r.side(inside, axis, i);
  const double c = plus ? r.ca[i] : r.cb[i], towards = plus ? K.u - u : u - K.u;
  const double z = K.rho * (c + r.law.shock_slope * larger(0.0, towards));
  const double w = c + r.law.driving_slope * larger(0.0, towards);
  const double p = without_pull(K.p + z * towards, 2.0 * towards, 0.5 * z, 2.0 * c, r.law);
  Passing f = behind_wave(K, w, -towards, {u, p});
  const bool enters = plus ? u < 0.0 : u > 0.0;
  const int ghost = plus ? 0 : -1;
  if (enters) {
    f.rho = row(h.rho, 0, axis, ghost)[i];
    f.E = row(h.energy, 0, axis, ghost)[i];
  }
  r.write(i, f);
  for (int q = 0; q < C; ++q) {
    const double carried = enters ? row(h.velocity, q, axis, ghost)[i] : inside[1 + q][i];
    r.U[q][i] = q == axis && !enters ? u : carried;
  }
}

template <int C, bool Scaled>
void row_of_axis(const Row& row, const Handles& h, int axis, const SchemeOptions& o) {
  const Fluid& fluid = o.materials.fluid;
  const eos::IdealGas* gas = fluid.gamma_law();
  const Law law{fluid.shock_slope(), larger(fluid.shock_slope(), 1.0), -fluid.lowest_pressure(),
                gas == nullptr ? 0.0 : 1.0 / (gas->gamma - 1.0)};
  const double l = row.step().dt / row.step().spacing[o.grid.axes.direction[axis]];
  const Rows<C, Scaled> rows(row, h, axis, l, law);
  const int n = row.whole_vectors();
  if (axis == 0) face_row<C, Scaled, 0>(rows, n);
  if constexpr (C > 1)
    if (axis == 1) face_row<C, Scaled, 1>(rows, n);
  if constexpr (C > 2)
    if (axis == 2) face_row<C, Scaled, 2>(rows, n);
  for_each_wall_face(row, o, axis,
                     [&](int i, bool plus) { wall_face(row, h, rows, axis, i, plus, 0.0); });
  for_each_prescribed_face(row, o, axis, h.velocity, h.sound, [&](int i, bool plus, double u) {
    wall_face(row, h, rows, axis, i, plus, u);
  });
}

}  // namespace

void add_traced_fluxes(TaskList& list, const TracedFluxesInput& v, const SchemeOptions& o,
                       int effect) {
  static const char* names[] = {"fluxes of axis 0", "fluxes of axis 1", "fluxes of axis 2"};
  const bool scaled = TracedComponents::of(o).energy;
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 1, 0);
    TaskBuilder task = list.task(names[axis], effect);
    Handles h;
    h.rho = task.read(v.rho, both);
    h.energy = task.read(v.energy, both);
    h.velocity = task.read(v.velocity, both);
    h.sound = task.read(v.sound, both);
    h.traced = task.read(v.traced[axis], both);
    h.face_velocity = task.write(v.face_velocity[axis]);
    h.face_pressure = task.write(v.face_pressure[axis]);
    h.flux = task.write(v.flux[axis]);
    dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
      task.kernel([=](const Row& row) {
        scaled ? row_of_axis<C, true>(row, h, axis, o) : row_of_axis<C, false>(row, h, axis, o);
      });
    });
  }
}

}  // namespace sluice::ice
