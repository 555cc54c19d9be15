// Step 8 with several materials: which volume, mass and energy of each pass a face.
//
// Where a face lies between two cells of pure neighbourhood, the rows of one material
// (conservative/remap_flux_rows.hpp); elsewhere, with the donor's values, H = l u_f, nu = |H|/J,
// s = sign(H), N the outflow Courant number, B = 2/max(N,.05):
//   1. theta_m = V_m + s (1-nu)/2 S, S = sign min(B |dm|, 2 |dp|) (0 at extrema) near an interface,
//      where one of five cells has V_m < .01 or > .99, else Q3(dm, dp; nu, B);
//      0 <= theta_m <= min(1, V_m/max(N,1e-12)): never more than the cell holds
//   2. sum_m theta_m = 1: divided by the sum where it is more, filled up to the caps where less
//   3. traces: what would enter a cell without the material below 1e-16 stays; where the face is
//      the donor's only outlet and would leave a trace, it takes all, to the bit
//   4. rho_m = rho_mL + s (1-nu)/2 Q3(D rho_m; B)/J, eps_m likewise with bound 2, differences only
//      where V_m > 1e-10 in donor, upwind and downwind cell; both bounded by the share
//      phi = N theta_m/V_m of the material that leaves: q = (1-phi)/max(phi,.05),
//      |rho_m/rho_mL - 1| <= min(.9, .5 q), |eps_m - eps_mL| <= min(.9, .5 q) (p_m + pi_m)/G_m
//   5. FV = H theta, FM = FV rho_m, FE = FV eps_m; F = sum FM; U, f, K of the mixture as for one
//      material with its energy scale; G_m = FE + FM K, G = sum G_m.
#include "ice/conservative/remap_flux_rows.hpp"
#include "ice/mixture/face_donors.hpp"
#include "ice/mixture/runs.hpp"
#include "ice/mixture/variables.hpp"

namespace sluice::ice::mixture {
namespace {

struct Handles {
  RemapFluxHandles common;
  MaterialHandles materials;
  In pure;
  Out flux;  // of each material
};

// Total mass and energy flux, velocity of what passes, the correction K of the kinetic energy.
template <int D, int C>
void total_fluxes(const Row& row, const Handles& h, const SchemeOptions& o, int axis, double l) {
  const int n = row.count(), M = static_cast<int>(h.materials.volume.size());
  double* __restrict F = row(h.common.flux, 0);
  double* __restrict G = row(h.common.flux, 1);
  for (int i = 0; i < n; ++i) F[i] = 0.0;
  for (int m = 0; m < M; ++m) {
    const double* FM = row(h.flux, component(m, of_mass));
    for (int i = 0; i < n; ++i) F[i] += FM[i];
  }
  const bool based = o.second_order && D > 1;
  const auto cells = [&](In in, int c = 0) { return pair_of(row, in, c, axis); };
  const Pair w = cells(h.common.inverse_rho), rho_L = cells(h.common.rho_L);
  const Pair scale = cells(h.common.energy_scale);
  const Pair mask = o.masked ? cells(h.common.mask) : Pair{};
  Around V[C];
  Pair v[C], base[C];
  double* U[C];
  for (int c = 0; c < C; ++c) {
    if (o.second_order) V[c] = around(row, h.common.velocity, c, axis);
    v[c] = cells(h.common.velocity_L, c);
    base[c] = based ? cells(h.common.base, 2 + c) : v[c];
    U[c] = row(h.common.flux, 2 + c);
  }
  const double* uf = row(h.common.face_velocity);
  for (int i = 0; i < n; ++i) {
    const bool left = l * uf[i] < 0.0;
    const double f = smaller(std::fabs(F[i]) * w.at(i, left), 0.99);
    const double m = o.masked ? mask.at(i, left) : 1.0;
    double d2 = 0, carried = 0;
    for (int c = 0; c < C; ++c) {
      const double before = v[c].at(i, left);
      double u = base[c].at(i, left);
      if (o.second_order)
        u += (left ? -0.5 : 0.5) * (1.0 - f) * m * donor_slope(V[c], i, left, f, 2.0);
      U[c][i] = u;
      (c < D ? d2 : carried) += (u - before) * (u - before);
    }
    if constexpr (C > D) d2 += carried;
    const double rL = rho_L.at(i, left);
    G[i] = -0.5 * (d2 * d2 * rL) / ((1.0 - f) * (d2 * rL + 0.25 * scale.at(i, left)));
  }
  for (int m = 0; m < M; ++m) {
    const double* FM = row(h.flux, component(m, of_mass));
    double* GE = row(h.flux, component(m, of_energy));
    for (int i = 0; i < n; ++i) GE[i] += FM[i] * G[i];
  }
  for (int i = 0; i < n; ++i) G[i] = 0.0;
  for (int m = 0; m < M; ++m) {
    const double* GE = row(h.flux, component(m, of_energy));
    for (int i = 0; i < n; ++i) G[i] += GE[i];
  }
}

template <int D, int C>
void mixed_faces(const Row& row, const Handles& h, const SchemeOptions& o, int axis, double l) {
  for (int first = 0; first < row.count(); first += most_faces) {
    const int left = row.count() - first;
    const Row part = row.part(first, left < most_faces ? left : most_faces);
    carry_materials(part, h.common, h.materials, h.flux, o, axis, l);
    total_fluxes<D, C>(part, h, o, axis, l);
  }
}

}  // namespace

void add_remap_fluxes(TaskList& list, const Variables& v, const SchemeOptions& o, int effect) {
  static const char* names[] = {"remap along axis 0", "remap along axis 1", "remap along axis 2"};
  for (int axis = 0; axis < o.axes.count; ++axis) {
    const int direction = o.axes.direction[axis];
    const auto face = static_cast<std::size_t>(axis);
    TaskBuilder task = list.task(names[axis], effect);
    Handles h;
    h.common = read_remap_inputs(task, v.common, o, axis);
    h.common.flux = task.write(v.common.flux[face]);
    h.materials = read_materials(task, v, o, axis);
    h.pure = task.read(v.pure, Stencil::along(direction, 1, 0));
    h.flux = task.write(v.flux[face]);
    dispatch(o.axes.count, o.components, [&]<int D, int C>() {
      task.kernel([=](const Row& row) {
        const double l = row.step().dt / row.step().spacing[direction];
        for_each_face_run(row(h.pure, 0, axis, -1), row(h.pure), row.count(),
                          [&](int first, int count, double pure) {
                            const Row part = row.part(first, count);
                            if (pure < 0) return mixed_faces<D, C>(part, h, o, axis, l);
                            const auto m = static_cast<int>(pure);
                            if (o.fluids[static_cast<std::size_t>(m)].ideal() == nullptr)
                              flux_row_of<D, C, true>(part, h.common, axis, l, o);
                            else
                              flux_row_of<D, C, false>(part, h.common, axis, l, o);
                          });
      });
    });
  }
}

}  // namespace sluice::ice::mixture
