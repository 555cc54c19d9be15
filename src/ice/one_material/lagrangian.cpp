// Step 6: the Lagrangian phase, cells including one ghost layer.
//
//   dp_d = l_d (p_f+ - p_f-) - dt F_d       F: force per volume of gravity and viscous stress
//   v_d  = u_d - dp_d/rho                    ub_d = u_d - dp_d/(2 rho)
//   J    = 1 + sum_d l_d (u_f+ - u_f-)
//   E*   = E - sum_d l_d [p_f+ (u_f+ - ub_d) - p_f- (u_f- - ub_d)]     (work defect)
//   rho_L = rho/J,  E_L = E*/J,  N = (1/J) sum_d l_d [max(0,u_f+) + max(0,-u_f-)]
// l = dt/dx. The work defect is what remains of the work of the face pressures when the kinetic
// energy that the cell gains is taken away: no kinetic energy is ever subtracted. Viscous stress
// adds its own defect, sum_d l_d [t_f+ . (u_f+ - ub) - t_f- . (u_f- - ub)] with t_f the stress
// vector on the face and u_f the mean of the two cells: friction becomes heat, exactly. Conduction
// adds -sum_d l_d (q+ - q-). Shear along strong shocks acts alike: step/shock_shear.hpp.
#include "ice/fluid/closure_rows.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/step/end_of_step.hpp"
#include "ice/step/heat_rows.hpp"
#include "ice/step/held_faces.hpp"
#include "ice/step/impulse.hpp"
#include "ice/step/remap_bounds.hpp"
#include "ice/step/shock_shear.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In inverse_rho, velocity, energy, sound;
  FrictionReads friction;
  std::array<In, 3> face_velocity, heat_flux;
  ImpulseHandles forces;
  Out inverse_J, rho_L, energy_L, velocity_L, energy_star, courant, inverse_courant, energy_scale;
  Out mixture;  // work of pressures, of friction
  ShockShearReads shear;
};

// All but friction and conduction.
template <int D, int C>
void cell_rows(const Row& row, const Handles& h, const ImpulseConstants& constants) {
  const int n = row.whole_vectors();
  const ImpulseConstants s = constants;
  const double* __restrict r = row(h.forces.rho);
  const double* __restrict w = row(h.inverse_rho);
  const double* __restrict E = row(h.energy);
  const double* um[3];
  const double* up[3];
  const double* pm[3];
  const double* pp[3];
  const double* u[C];
  const double* dp[C];
  double* v[C];
  for (int d = 0; d < D; ++d) {
    um[d] = row(h.face_velocity[d]);
    up[d] = row(h.face_velocity[d], 0, d, 1);
    pm[d] = row(h.forces.face_pressure[d]);
    pp[d] = row(h.forces.face_pressure[d], 0, d, 1);
  }
  for (int c = 0; c < C; ++c) {
    u[c] = row(h.velocity, c);
    dp[c] = row(h.forces.impulse, c);
    v[c] = row(h.velocity_L, c);
  }
  double* __restrict iJ = row(h.inverse_J);
  double* __restrict rL = row(h.rho_L);
  double* __restrict EL = row(h.energy_L);
  double* __restrict Es = row(h.energy_star);
  double* __restrict N = row(h.courant);
  double* __restrict iN = row(h.inverse_courant);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    for (int c = 0; c < C; ++c) v[c][i] = u[c][i] - dp[c][i] * w[i];
    double stretch = 0, work = 0, out = 0;
    for (int d = 0; d < D; ++d) {
      const double ub = u[d][i] - 0.5 * dp[d][i] * w[i];
      stretch += s.l[d] * (up[d][i] - um[d][i]);
      work += s.l[d] * (pp[d][i] * (up[d][i] - ub) - pm[d][i] * (um[d][i] - ub));
      out += s.l[d] * (larger(0.0, up[d][i]) + larger(0.0, -um[d][i]));
    }
    // Carried components flow out too, as they would if their direction were swept.
    double carried = 0;
    for (int c = D; c < C; ++c) carried += s.l[c] * std::fabs(u[c][i]);
    if constexpr (C > D) out += carried;
    const double inverse = 1.0 / (1.0 + stretch), energy = E[i] - work;
    const double outflow = smaller(out * inverse, 1.0);
    iJ[i] = inverse;
    Es[i] = energy;
    EL[i] = energy * inverse;
    rL[i] = r[i] * inverse;
    N[i] = outflow;
    iN[i] = 1.0 / larger(outflow, min_outflow);
  }
}

// E* and E_L with the heat of shear along shocks.
template <int D, int C>
void heat_of_shocks(const Row& whole, const Handles& h) {
  for_each_sheared_part<D>(whole, h.shear, [&](const Row& row) {
    double *Es = row(h.energy_star), *EL = row(h.energy_L);
    const double* iJ = row(h.inverse_J);
    add_heat_of_shear<D, C>(row, h.shear, row(h.inverse_rho), Es);
    for (int i = 0; i < row.count(); ++i) EL[i] = Es[i] * iJ[i];
  });
}

// E* and E_L with friction and conduction; of a mixture, what the materials share out.
template <int D, int C>
void heat_rows(const Row& row, const Handles& h, const ImpulseConstants& s,
               const SchemeOptions& o) {
  if (!o.keeps_work() && !o.transport.viscous && !o.transport.conducting) return;
  const int n = row.whole_vectors();
  double *Es = row(h.energy_star), *EL = row(h.energy_L);
  if (o.keeps_work()) {
    const double* E = row(h.energy);
    double* work = row(h.mixture, 0);
    for (int i = 0; i < n; ++i) work[i] = E[i] - Es[i];
  }
  if (o.transport.viscous) {
    double* friction = o.materials.mixture ? row(h.mixture, 1) : EL;  // E_L is written again
    friction_rows<D, C>(row, h.friction, row(h.inverse_rho), s, o.friction_tilts(), friction);
    for (int i = 0; i < n; ++i) Es[i] += friction[i];
  }
  if (o.transport.conducting) conduction_rows<D>(row, h.heat_flux, s, Es);
  const double* iJ = row(h.inverse_J);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) EL[i] = Es[i] * iJ[i];
}

}  // namespace

void add_lagrangian(TaskList& list, const LagrangianInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("Lagrangian phase", effect);
  Handles h;
  h.forces.rho = task.read(v.rho);
  h.inverse_rho = task.read(v.inverse_rho);
  h.velocity = task.read(v.velocity, o.transport.viscous ? Stencil::box(1) : Stencil::point());
  h.energy = task.read(v.energy);
  if (holds_velocities(o)) h.sound = task.read(v.sound);
  if (o.friction_tilts()) h.friction.viscosity = task.read(v.front_viscosity, Stencil::box(1));
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 0, 1);
    h.face_velocity[axis] = task.read(v.faces.velocity[axis], both);
    h.forces.face_pressure[axis] = task.read(v.faces.pressure[axis], both);
    if (o.transport.viscous) h.forces.stress[axis] = task.read(v.faces.stress[axis], both);
    if (o.transport.conducting) h.heat_flux[axis] = task.read(v.faces.heat_flux[axis], both);
  }
  h.inverse_J = task.write(v.donors.inverse_J);
  h.rho_L = task.write(v.donors.rho_L);
  h.energy_L = task.write(v.donors.energy_L);
  h.velocity_L = task.write(v.donors.velocity_L);
  h.energy_star = task.write(v.energy_star);
  h.courant = task.write(v.donors.courant);
  h.inverse_courant = task.write(v.donors.inverse_courant);
  // What the remap of the second order takes of it.
  const bool scaled = o.materials.fluid.gamma_law() == nullptr && !o.scheme.third_order;
  if (scaled && !o.materials.mixture) h.energy_scale = task.write(v.donors.energy_scale);
  if (o.keeps_work()) h.mixture = task.write(v.lagrangian_mixture);
  h.forces.impulse = task.write(v.impulse);
  if (o.scheme.shears_shocks) h.shear = read_shock_shear(task, v.shear);
  h.shear.impulse = h.forces.impulse;
  h.friction.velocity = h.velocity;
  h.friction.stress = h.forces.stress;
  h.friction.impulse = h.forces.impulse;
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      const ImpulseConstants s = impulse_constants(o, row.step());
      impulse_rows<D, C>(row, h.forces, s, o.transport.viscous);
      const bool sheared = o.scheme.shears_shocks && is_sheared<D>(row, h.shear);
      if (sheared) take_shear<D, C>(row, h.shear);
      leave_prescribed_ghosts(row, o, h.velocity, h.sound, h.forces.impulse);
      cell_rows<D, C>(row, h, s);
      if (sheared) heat_of_shocks<D, C>(row, h);
      heat_rows<D, C>(row, h, s, o);
      if (scaled && !o.materials.mixture)
        energy_scale_row(o.materials.fluid, row.count(), row(h.rho_L), row(h.energy_L),
                         row(h.energy_scale));
    });
  });
}

}  // namespace sluice::ice
