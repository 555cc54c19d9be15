// Step 5 of the classic form: momentum and energy before advection.
//
//   m_L = m - dp (impulse.hpp),  E_L = E*
// What is advected with compatible fluxes is m_L/rho and E_L/rho, otherwise m_L and E_L.
#include "ice/internal_energy_form/variables.hpp"
#include "ice/step/held_faces.hpp"
#include "ice/step/impulse.hpp"

namespace sluice::ice::internal_energy_form {
namespace {

struct Handles {
  ImpulseHandles forces;
  In inverse_rho, momentum, energy_star, velocity, sound;
  Out momentum_out, energy_out;
};

template <int C, bool Specific>
void advected_rows(const Row& row, const Handles& h) {
  const int n = row.count();
  const double* __restrict w = row(h.inverse_rho);
  const double* __restrict E = row(h.energy_star);
  double* __restrict e = row(h.energy_out);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) e[i] = Specific ? E[i] * w[i] : E[i];
  for (int c = 0; c < C; ++c) {
    const double* __restrict m = row(h.momentum, c);
    const double* __restrict dp = row(h.forces.impulse, c);
    double* __restrict q = row(h.momentum_out, c);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) q[i] = Specific ? (m[i] - dp[i]) * w[i] : m[i] - dp[i];
  }
}

}  // namespace

void add_lagrangian(TaskList& list, const LagrangianInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("Lagrangian momentum and energy", effect);
  Handles h;
  h.forces.rho = task.read(v.rho);
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 0, 1);
    h.forces.face_pressure[axis] = task.read(v.face_pressure[axis], both);
    if (o.transport.viscous) h.forces.stress[axis] = task.read(v.stress[axis], both);
  }
  h.inverse_rho = task.read(v.inverse_rho);
  h.momentum = task.read(v.old_momentum);
  h.energy_star = task.read(v.energy_star);
  if (holds_velocities(o)) {
    h.velocity = task.read(v.velocity);
    h.sound = task.read(v.sound);
  }
  h.forces.impulse = task.write(v.impulse);
  h.momentum_out = task.write(v.momentum);
  h.energy_out = task.write(v.energy);
  const bool per_mass = specific(o);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      impulse_rows<D, C>(row, h.forces, impulse_constants(o, row.step()), o.transport.viscous);
      leave_prescribed_ghosts(row, o, h.velocity, h.sound, h.forces.impulse);
      if (per_mass)
        advected_rows<C, true>(row, h);
      else
        advected_rows<C, false>(row, h);
    });
  });
}

}  // namespace sluice::ice::internal_energy_form
