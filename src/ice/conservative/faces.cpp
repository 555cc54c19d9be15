// Steps 3 to 5: left and right states at each face, impedances, face velocity and pressure.
//
//   u_L = u_a + su_a/2 - (h/rho_a) sp_a - UT_a      p_L = P_a + (1/2 + h u_a) sp_a
//   u_R = u_b - su_b/2 - (h/rho_b) sp_b - UT_b      p_R = P_b - (1/2 - h u_b) sp_b
// (h u only in 2-D and 3-D: the states are Lagrangian along d, Eulerian across it), floored at a
// tenth of the cell's pressure. Impedances of Dukowicz, J. Comput. Phys. 61 (1985) 119, with one
// correction; A = shock slope dUs/du:
//   z_L = rho_a (c_a + A/2 max(0,du)), z_R alike;  u0 = ((z_L u_L + z_R u_R) + (p_L-p_R))/(z_L+z_R)
//   z_L = rho_a (c_a + A max(0,u_L-u0)),  z_R = rho_b (c_b + A max(0,u0-u_R))
//   u_f = ((z_L u_L + z_R u_R) + (p_L - p_R))/(z_L + z_R)
//   p_f = (z_R p_L + z_L p_R)/(z_L + z_R) + phi z_L z_R du/(z_L + z_R)
// phi takes the dissipation away where the jump of velocity is neither acoustic nor a shock:
//   phi = min(1, (2|p_b-p_a| + rbar D^2)/(rcbar D)),  D = max(|du|, |u_b-u_a|).
// Under gravity p_L and p_R are hydrostatic extensions of the cell values, p_b - p_a the deviation
// from hydrostatic balance.
#include "ice/conservative/variables.hpp"
#include "ice/limiters.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In rho, inverse_rho, sound, velocity, pressure;
  In velocity_slope, pressure_slope, predicted, transverse;
  Out face_velocity, face_pressure;
};

struct FaceState {
  double u, p;
};

// The Riemann problem of two cell states in the middle of the step.
inline FaceState solve_face(double uL, double pL, double uR, double pR, double ra, double rb,
                            double ca, double cb, double slope, double u_jump, double p_jump) {
  const double du = uL - uR;
  const double squeeze = 0.5 * slope * larger(0.0, du);
  double zL = ra * (ca + squeeze);
  double zR = rb * (cb + squeeze);
  const double u0 = ((zL * uL + zR * uR) + (pL - pR)) / (zL + zR);
  zL = ra * (ca + slope * larger(0.0, uL - u0));
  zR = rb * (cb + slope * larger(0.0, u0 - uR));
  const double w = 1.0 / (zL + zR);
  const double rbar = 0.5 * (ra + rb);
  const double rcbar = 0.5 * (ra * ca + rb * cb);
  const double D = larger(std::fabs(du), std::fabs(u_jump));
  // phi = ratio/(rcbar D) bounded by 1; D = 0 means du = 0 and no dissipation either way.
  const double wanted = 2.0 * std::fabs(p_jump) + rbar * (D * D);
  const double full = rcbar * D;
  const double phi = wanted < full ? wanted / full : 1.0;
  return {((zL * uL + zR * uR) + (pL - pR)) * w,
          (zR * pL + zL * pR) * w + phi * (zL * zR * du * w)};
}

template <int D, bool Second, bool Gravity>
void face_row(const Row& row, const Handles& h, int axis, double half_courant, double g_dx,
              const eos::IdealGas& gas) {
  const int n = row.count();
  auto a = [&](In in, int c = 0) { return row(in, c, axis, -1); };
  const double* __restrict ra = a(h.rho);
  const double* __restrict rb = row(h.rho);
  const double* __restrict wa = a(h.inverse_rho);
  const double* __restrict wb = row(h.inverse_rho);
  const double* __restrict ca = a(h.sound);
  const double* __restrict cb = row(h.sound);
  const double* __restrict ua = a(h.velocity, axis);
  const double* __restrict ub = row(h.velocity, axis);
  const double* __restrict pa = a(h.pressure);
  const double* __restrict pb = row(h.pressure);
  const double* __restrict sua = Second ? a(h.velocity_slope, axis) : ua;
  const double* __restrict sub = Second ? row(h.velocity_slope, axis) : ub;
  const double* __restrict spa = Second ? a(h.pressure_slope, axis) : pa;
  const double* __restrict spb = Second ? row(h.pressure_slope, axis) : pb;
  const double* __restrict Pa = Second ? a(h.predicted) : pa;
  const double* __restrict Pb = Second ? row(h.predicted) : pb;
  const double* __restrict UTa = Second && D > 1 ? a(h.transverse, axis) : ua;
  const double* __restrict UTb = Second && D > 1 ? row(h.transverse, axis) : ub;
  double* __restrict uf = row(h.face_velocity);
  double* __restrict pf = row(h.face_pressure);
  const double slope = gas.shock_slope();
  const double hc = half_courant;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double uL = ua[i], uR = ub[i], pL = pa[i], pR = pb[i];
    double p_jump = pb[i] - pa[i];
    if constexpr (Second) {
      uL = ua[i] + 0.5 * sua[i] - hc * wa[i] * spa[i];
      uR = ub[i] - 0.5 * sub[i] - hc * wb[i] * spb[i];
      if constexpr (D > 1) {
        uL -= UTa[i];
        uR -= UTb[i];
        pL = Pa[i] + (0.5 + hc * ua[i]) * spa[i];
        pR = Pb[i] - (0.5 - hc * ub[i]) * spb[i];
      } else {
        pL = Pa[i] + 0.5 * spa[i];
        pR = Pb[i] - 0.5 * spb[i];
      }
      pL = larger(pL, 0.1 * pa[i]);
      pR = larger(pR, 0.1 * pb[i]);
    }
    if constexpr (Gravity) {
      pL += 0.5 * g_dx * ra[i];
      pR -= 0.5 * g_dx * rb[i];
      p_jump -= 0.5 * g_dx * (ra[i] + rb[i]);
    }
    const FaceState f =
        solve_face(uL, pL, uR, pR, ra[i], rb[i], ca[i], cb[i], slope, ub[i] - ua[i], p_jump);
    uf[i] = f.u;
    pf[i] = f.p;
  }
}

}  // namespace

void add_faces(TaskList& list, const SchemeVariables& v, const SchemeOptions& o, int effect) {
  static const char* names[] = {"faces of axis 0", "faces of axis 1", "faces of axis 2"};
  for (int axis = 0; axis < o.axes.count; ++axis) {
    const int direction = o.axes.direction[axis];
    const Stencil both = Stencil::along(direction, 1, 0);
    TaskBuilder task = list.task(names[axis], effect);
    Handles h;
    h.rho = task.read(v.rho, both);
    h.inverse_rho = task.read(v.inverse_rho, both);
    h.sound = task.read(v.sound, both);
    h.velocity = task.read(v.velocity, both);
    h.pressure = task.read(v.pressure, both);
    if (o.second_order) {
      h.velocity_slope = task.read(v.velocity_slope, both);
      h.pressure_slope = task.read(v.pressure_slope, both);
      h.predicted = task.read(v.predicted_pressure, both);
      if (o.axes.count > 1) h.transverse = task.read(v.transverse_velocity, both);
    }
    const auto face = static_cast<std::size_t>(axis);
    h.face_velocity = task.write(v.face_velocity[face]);
    h.face_pressure = task.write(v.face_pressure[face]);
    dispatch(o.axes.count, o.components, [&]<int D, int C>() {
      task.kernel([=](const Row& row) {
        const double dx = row.step().spacing[direction];
        const double hc = 0.5 * row.step().dt / dx;
        const double g_dx = o.gravity[direction] * dx;
        if (o.second_order && o.gravity_on)
          face_row<D, true, true>(row, h, axis, hc, g_dx, o.gas);
        else if (o.second_order)
          face_row<D, true, false>(row, h, axis, hc, g_dx, o.gas);
        else if (o.gravity_on)
          face_row<D, false, true>(row, h, axis, hc, g_dx, o.gas);
        else
          face_row<D, false, false>(row, h, axis, hc, g_dx, o.gas);
      });
    });
  }
}

}  // namespace sluice::ice
