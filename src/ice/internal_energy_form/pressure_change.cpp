// Step 3 of the classic form: the pressure change by compression, and its work.
//
//   dp = -rho c^2 sum_d l_d (u_f+ - u_f-)        p = p_n + dp
//   E* = E + dp p/(rho c^2)                      volume work: first power of p, one pressure
// One material fills the cell, so that its volume fraction is one and the volume advected through
// the faces is their velocity.
#include "ice/internal_energy_form/variables.hpp"

namespace sluice::ice::internal_energy_form {
namespace {

struct Handles {
  In energy, inverse_rho, pressure, sound;
  std::array<In, 3> face_velocity;
  Out change, pressure_new, energy_star;
};

template <int D>
void change_row(const Row& row, const Handles& h, const double (&l)[3]) {
  const int n = row.count();
  const double* um[3];
  const double* up[3];
  for (int d = 0; d < D; ++d) {
    const In faces = h.face_velocity[d];
    um[d] = row(faces);
    up[d] = row(faces, 0, d, 1);
  }
  const double* __restrict E = row(h.energy);
  const double* __restrict w = row(h.inverse_rho);
  const double* __restrict p = row(h.pressure);
  const double* __restrict c = row(h.sound);
  double* __restrict dp = row(h.change);
  double* __restrict pn = row(h.pressure_new);
  double* __restrict Es = row(h.energy_star);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double dilation = 0;
    for (int d = 0; d < D; ++d) dilation += l[d] * (up[d][i] - um[d][i]);
    dp[i] = -(c[i] * c[i] / w[i]) * dilation;
    pn[i] = p[i] + dp[i];
    Es[i] = E[i] - pn[i] * dilation;
  }
}

}  // namespace

void add_pressure_change(TaskList& list, const PressureChangeInput& v, const SchemeOptions& o,
                         int effect) {
  TaskBuilder task = list.task("pressure change", effect);
  Handles h;
  h.energy = task.read(v.energy);
  h.inverse_rho = task.read(v.inverse_rho);
  h.pressure = task.read(v.pressure);
  h.sound = task.read(v.sound);
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    h.face_velocity[axis] =
        task.read(v.face_velocity[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  }
  h.change = task.write(v.pressure_change);
  h.pressure_new = task.write(v.acting_pressure);
  h.energy_star = task.write(v.energy_star);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      double l[3] = {0, 0, 0};
      for (int d = 0; d < D; ++d)
        l[d] = row.step().dt / row.step().spacing[o.grid.axes.direction[d]];
      change_row<D>(row, h, l);
    });
  });
}

}  // namespace sluice::ice::internal_energy_form
