// Steps 3 to 5: left and right states at each face, impedances, face velocity and pressure.
//
//   u_L = u_a + su_a/2 - (h/rho_a) sp_a - UT_a      p_L = P_a + (1/2 + h u_a) sp_a
//   u_R = u_b - su_b/2 - (h/rho_b) sp_b - UT_b      p_R = P_b - (1/2 - h u_b) sp_b
// (h u only in 2-D and 3-D: the states are Lagrangian along d, Eulerian across it), floored at a
// tenth of the cell's pressure above the lowest one of its law. Impedances of Dukowicz, J. Comput.
// Phys. 61 (1985) 119, with one correction; A = shock slope dUs/du:
//   z_L = rho_a (c_a + A/2 max(0,du)), z_R alike;  u0 = ((z_L u_L + z_R u_R) + (p_L-p_R))/(z_L+z_R)
//   z_L = rho_a (c_a + A max(0,u_L-u0)),  z_R = rho_b (c_b + A max(0,u0-u_R))
//   u_f = ((z_L u_L + z_R u_R) + (p_L - p_R))/(z_L + z_R)
//   p_f = (z_R p_L + z_L p_R)/(z_L + z_R) + phi z_L z_R du/(z_L + z_R)
// phi takes the dissipation away where the jump of velocity is neither acoustic nor a shock:
//   phi = min(1, (2|p_b-p_a| + rbar D^2)/(rcbar D)),  D = max(|du|, |u_b-u_a|).
// Sides that part faster than .6 of what opens a vacuum between them, (c_a + c_b)/(A - 1), leave
// next to no pressure (two fans: below .2 % of it): p_f then rises to the lowest pressure of the
// law from below, where a straight line would pull and heat what it should let go.
// Under gravity p_L and p_R are hydrostatic extensions of the cell values, p_b - p_a the deviation
// from hydrostatic balance (of g rho + f with a driving force f); what P took for the flow along
// the hydrostatic part is given back. On a wall the cell inside meets its own mirror image: u_f = 0
// to the bit, whatever the ghosts hold. Where the velocity through a side is given, so is u_f, and
// the cell inside meets its image about that: a wall that moves.
#include "ice/fluid/limiters.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/step/held_faces.hpp"
#include "ice/step/remap_bounds.hpp"
#include "ice/step/runs.hpp"
#include "ice/step/variables.hpp"
#include "ice/step/wall_faces.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In rho, inverse_rho, sound, velocity, pressure;
  In velocity_slope, pressure_slope, predicted, transverse;
  In shock_slope, pi, pure;  // of a mixture
  Out face_velocity, face_pressure;
};

struct FaceState {
  double u, p;
};

// The Riemann problem of two cell states in the middle of the step. Always part of the loop over a
// row: with a call for every face the whole step takes 1.5 times as long.
[[gnu::always_inline]] inline FaceState solve_face(double uL, double pL, double uR, double pR,
                                                   double ra, double rb, double ca, double cb,
                                                   double slope_a, double slope_b, double u_jump,
                                                   double p_jump, double pi) {
  const double du = uL - uR;
  const double squeeze = larger(0.0, du);
  double zL = ra * (ca + 0.5 * slope_a * squeeze);
  double zR = rb * (cb + 0.5 * slope_b * squeeze);
  const double u0 = ((zL * uL + zR * uR) + (pL - pR)) / (zL + zR);
  zL = ra * (ca + slope_a * larger(0.0, uL - u0));
  zR = rb * (cb + slope_b * larger(0.0, u0 - uR));
  const double w = 1.0 / (zL + zR);
  const double rbar = 0.5 * (ra + rb);
  const double rcbar = 0.5 * (ra * ca + rb * cb);
  const double D = larger(std::fabs(du), std::fabs(u_jump));
  // phi = ratio/(rcbar D) bounded by 1; D = 0 means du = 0 and no dissipation either way.
  const double wanted = 2.0 * std::fabs(p_jump) + rbar * (D * D);
  const double full = rcbar * D;
  const double phi = wanted < full ? wanted / full : 1.0;
  const double p = (zR * pL + zL * pR) * w + phi * (zL * zR * du * w);
  const double parting = -du * (0.5 * (slope_a + slope_b) - 1.0) - 0.6 * (ca + cb);
  const double vacuum = smaller(-pi, p + 30.0 * (zL * zR * w) * larger(0.0, parting));
  return {((zL * uL + zR * uR) + (pL - pR)) * w, larger(p, vacuum)};
}

struct FaceConstants {
  double half_courant = 0;  // h = dt/(2 dx)
  double g_dx = 0;
  double f_dx = 0;  // of a driving force
};

// What the face solver asks of the law in the low (a) and the high (b) cell of each face: shock
// slope, and minus the lowest pressure.
struct OneLaw {
  double shock_slope = 1, lowest = 0;

  double slope_a(int) const { return shock_slope; }
  double slope_b(int) const { return shock_slope; }
  double pi_a(int) const { return lowest; }
  double pi_b(int) const { return lowest; }
};
struct LawOfCells {
  const double *slope[2], *pi[2];

  double slope_a(int i) const { return slope[0][i]; }
  double slope_b(int i) const { return slope[1][i]; }
  double pi_a(int i) const { return pi[0][i]; }
  double pi_b(int i) const { return pi[1][i]; }
};

// Rows of the two cells of each face: a on the low side, b on the high side.
template <int D, bool Second, bool Gravity>
struct FaceRows {
  const double *ra, *rb, *wa, *wb, *ca, *cb, *ua, *ub, *pa, *pb;
  const double *sua, *sub, *spa, *spb, *Pa, *Pb, *UTa, *UTb;
  FaceConstants k;

  FaceRows(const Row& row, const Handles& h, int axis, const FaceConstants& constants)
      : k(constants) {
    auto both = [&](In in, int c, const double*& a, const double*& b) {
      a = row(in, c, axis, -1);
      b = row(in, c);
    };
    both(h.rho, 0, ra, rb);
    both(h.inverse_rho, 0, wa, wb);
    both(h.sound, 0, ca, cb);
    both(h.velocity, axis, ua, ub);
    both(h.pressure, 0, pa, pb);
    if constexpr (Second) {
      both(h.velocity_slope, axis, sua, sub);
      both(h.pressure_slope, axis, spa, spb);
      both(h.predicted, 0, Pa, Pb);
      if constexpr (D > 1) both(h.transverse, axis, UTa, UTb);
    }
  }

  template <class Law>
  FaceState left(int i, const Law& law) const {
    double u = ua[i], p = pa[i];
    if constexpr (Second) {
      u = ua[i] + 0.5 * sua[i] - k.half_courant * wa[i] * spa[i];
      p = Pa[i] + 0.5 * spa[i];
      if constexpr (D > 1) {
        u -= UTa[i];
        p = Pa[i] + (0.5 + k.half_courant * ua[i]) * spa[i];
        if constexpr (Gravity) p += k.half_courant * ua[i] * (k.g_dx * ra[i] + k.f_dx);
      }
      const double pi = law.pi_a(i);
      p = larger(p, face_floor * (pa[i] + pi) - pi);
    }
    if constexpr (Gravity) p += 0.5 * (k.g_dx * ra[i] + k.f_dx);
    return {u, p};
  }
  template <class Law>
  FaceState right(int i, const Law& law) const {
    double u = ub[i], p = pb[i];
    if constexpr (Second) {
      u = ub[i] - 0.5 * sub[i] - k.half_courant * wb[i] * spb[i];
      p = Pb[i] - 0.5 * spb[i];
      if constexpr (D > 1) {
        u -= UTb[i];
        p = Pb[i] - (0.5 - k.half_courant * ub[i]) * spb[i];
        if constexpr (Gravity) p += k.half_courant * ub[i] * (k.g_dx * rb[i] + k.f_dx);
      }
      const double pi = law.pi_b(i);
      p = larger(p, face_floor * (pb[i] + pi) - pi);
    }
    if constexpr (Gravity) p -= 0.5 * (k.g_dx * rb[i] + k.f_dx);
    return {u, p};
  }
  template <class Law>
  FaceState solve(int i, const Law& law) const {
    const FaceState L = left(i, law), R = right(i, law);
    double p_jump = pb[i] - pa[i];
    if constexpr (Gravity) p_jump -= 0.5 * k.g_dx * (ra[i] + rb[i]) + k.f_dx;
    return solve_face(L.u, L.p, R.u, R.p, ra[i], rb[i], ca[i], cb[i], law.slope_a(i),
                      law.slope_b(i), ub[i] - ua[i], p_jump, smaller(law.pi_a(i), law.pi_b(i)));
  }
  // A wall on the face that moves with u: the cell inside meets its own mirror image.
  template <class Law>
  FaceState at_wall(int i, bool plus, double u, const Law& law) const {
    const FaceState in = plus ? left(i, law) : right(i, law);
    const double towards = plus ? in.u - u : u - in.u;
    const double cell = plus ? ua[i] - u : u - ub[i];
    const double rho = plus ? ra[i] : rb[i], c = plus ? ca[i] : cb[i];
    const double A = plus ? law.slope_a(i) : law.slope_b(i);
    const FaceState f = solve_face(towards, in.p, -towards, in.p, rho, rho, c, c, A, A, -2.0 * cell,
                                   0.0, plus ? law.pi_a(i) : law.pi_b(i));
    return {u, f.p};
  }
};

template <int D, bool Second, bool Gravity>
class FaceRow {
 public:
  FaceRow(const Row& row, const Handles& h, int axis, const FaceConstants& k)
      : rows_(row, h, axis, k), uf_(row(h.face_velocity)), pf_(row(h.face_pressure)) {}

  template <class Law>
  void run(int first, int end, const Law& of) const {
    const FaceRows<D, Second, Gravity> rows = rows_;
    const Law law = of;
    double* __restrict uf = uf_;
    double* __restrict pf = pf_;
#pragma GCC ivdep
    for (int i = first; i < end; ++i) {
      const FaceState f = rows.solve(i, law);
      uf[i] = f.u;
      pf[i] = f.p;
    }
  }
  template <class Law>
  void walls(const Row& row, const SchemeOptions& o, int axis, const Law& law) const {
    for_each_wall_face(row, o, axis, [&](int i, bool plus) {
      const FaceState f = rows_.at_wall(i, plus, 0.0, law);
      uf_[i] = f.u;
      pf_[i] = f.p;
    });
  }
  template <class Law>
  void held(const Row& row, const SchemeOptions& o, const Handles& h, int axis,
            const Law& law) const {
    for_each_prescribed_face(row, o, axis, h.velocity, h.sound, [&](int i, bool plus, double u) {
      const FaceState f = rows_.at_wall(i, plus, u, law);
      uf_[i] = f.u;
      pf_[i] = f.p;
    });
  }

 private:
  FaceRows<D, Second, Gravity> rows_;
  double *uf_, *pf_;
};

OneLaw law_of(const Fluid& fluid) {
  return {fluid.shock_slope(), -fluid.lowest_pressure()};
}

template <int D, bool Second, bool Gravity>
void face_row(const Row& row, const Handles& h, int axis, const FaceConstants& k,
              const SchemeOptions& o) {
  const FaceRow<D, Second, Gravity> faces(row, h, axis, k);
  if (!o.materials.mixture) {
    faces.run(0, row.whole_vectors(), law_of(o.materials.fluid));
    faces.walls(row, o, axis, law_of(o.materials.fluid));
    faces.held(row, o, h, axis, law_of(o.materials.fluid));
    return;
  }
  const LawOfCells of_cells{{row(h.shock_slope, 0, axis, -1), row(h.shock_slope)},
                            {row(h.pi, 0, axis, -1), row(h.pi)}};
  const int n = row.count(), room = row.whole_vectors();
  for_each_face_run(runs_of(row, h.pure, axis, -1), runs_of(row, h.pure), n,
                    [&](int first, int count, double pure) {
                      // What is computed for faces beyond is overwritten by the next run.
                      const int end = first + whole_vectors(count, room - first);
                      if (pure < 0.0)
                        faces.run(first, end, of_cells);
                      else
                        faces.run(first, end,
                                  law_of(o.materials.fluids[static_cast<std::size_t>(pure)]));
                    });
  faces.walls(row, o, axis, of_cells);
  faces.held(row, o, h, axis, of_cells);
}

template <int D>
void face_row_of(const Row& row, const Handles& h, int axis, const FaceConstants& k,
                 const SchemeOptions& o) {
  if (o.scheme.second_order && o.forces.on)
    face_row<D, true, true>(row, h, axis, k, o);
  else if (o.scheme.second_order)
    face_row<D, true, false>(row, h, axis, k, o);
  else if (o.forces.on)
    face_row<D, false, true>(row, h, axis, k, o);
  else
    face_row<D, false, false>(row, h, axis, k, o);
}

}  // namespace

void add_faces(TaskList& list, const FacesInput& v, const SchemeOptions& o, int effect) {
  static const char* names[] = {"faces of axis 0", "faces of axis 1", "faces of axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const int direction = o.grid.axes.direction[axis];
    const Stencil both = Stencil::along(direction, 1, 0);
    TaskBuilder task = list.task(names[axis], effect);
    Handles h;
    h.rho = task.read(v.moving.rho, both);
    h.inverse_rho = task.read(v.moving.inverse_rho, both);
    h.sound = task.read(v.moving.sound, both);
    h.velocity = task.read(v.moving.velocity, both);
    h.pressure = task.read(v.pressure, both);
    if (o.scheme.second_order) {
      h.velocity_slope = task.read(v.velocity_slope, both);
      h.pressure_slope = task.read(v.pressure_slope, both);
      h.predicted = task.read(v.predicted_pressure, both);
      if (o.grid.axes.count > 1) h.transverse = task.read(v.transverse_velocity, both);
    }
    if (o.materials.mixture) {
      h.shock_slope = task.read(v.shock_slope, both);
      h.pi = task.read(v.pi, both);
      h.pure = task.read(v.pure, both);
    }
    h.face_velocity = task.write(v.face_velocity[axis]);
    h.face_pressure = task.write(v.face_pressure[axis]);
    dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
      task.kernel([=](const Row& row) {
        const double dx = row.step().spacing[direction];
        FaceConstants k;
        k.half_courant = 0.5 * row.step().dt / dx;
        k.g_dx = o.forces.gravity[direction] * dx;
        k.f_dx = o.forces.driving[direction] * dx;
        face_row_of<D>(row, h, axis, k, o);
      });
    });
  }
}

}  // namespace sluice::ice
