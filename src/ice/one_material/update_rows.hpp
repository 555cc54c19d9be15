// Step 9: the new state from single-valued face fluxes; time-step rates; admissibility.
//
//   rho' = rho + sum_d (F- - F+)          m' = (m - dp) + sum_d (F- U- - F+ U+)
//   E'   = E* + sum_d [ (G- - G+) + (F- |U- - v|^2 - F+ |U+ - v|^2)/2 ] - rho' |m'/rho' - v|^2 / 2
// v is the cell's own Lagrangian velocity: algebraically this conserves total energy with the
// kinetic flux F |U|^2/2 + F K, but no large numbers are subtracted. A cell whose net fluxes are
// zero keeps its bits.
#pragma once
#include "ice/one_material/tasks.hpp"
#include "ice/step/end_of_step.hpp"

namespace sluice::ice {

struct UpdateHandles {
  In rho, momentum, impulse, velocity_L, energy_star, inverse_J, energy_scale;
  std::array<In, 3> flux;
  RateHandles next;  // the new state
};

// Momentum of a row, and what of the kinetic energy becomes heat.
template <int D, int C>
class MotionRows {
 public:
  MotionRows(const Row& row, const UpdateHandles& h) {
    for (int d = 0; d < D; ++d) {
      const In flux = h.flux[d];
      Fm[d] = row(flux, 0);
      Fp[d] = row(flux, 0, d, 1);
      for (int c = 0; c < C; ++c) {
        Um[d][c] = row(flux, 2 + c);
        Up[d][c] = row(flux, 2 + c, d, 1);
      }
    }
    for (int c = 0; c < C; ++c) {
      m[c] = row(h.momentum, c);
      dp[c] = row(h.impulse, c);
      v[c] = row(h.velocity_L, c);
      mn[c] = row(h.next.momentum, c);
    }
  }

  // What comes in through all faces, kg/m^3.
  double mass(int i) const {
    double sum = 0;
    for (int d = 0; d < D; ++d) sum += Fm[d][i] - Fp[d][i];
    return sum;
  }
  // Writes m' of cell i. `passed`(d): what else to add for direction d, G- - G+ (J/m^3). rho and
  // w = 1/rho: of the new state. The energy beside E*, J/m^3.
  template <class Passed>
  double heat(int i, double rho, double w, Passed passed) const {
    double gain = 0;
    for (int d = 0; d < D; ++d) {
      // Components along axes and carried ones apart: no order of the axes shows in the bits.
      double in = 0, out = 0, carried_in = 0, carried_out = 0;
      for (int c = 0; c < C; ++c) {
        (c < D ? in : carried_in) += (Um[d][c][i] - v[c][i]) * (Um[d][c][i] - v[c][i]);
        (c < D ? out : carried_out) += (Up[d][c][i] - v[c][i]) * (Up[d][c][i] - v[c][i]);
      }
      if constexpr (C > D) {
        in += carried_in;
        out += carried_out;
      }
      gain += passed(d) + 0.5 * (Fm[d][i] * in - Fp[d][i] * out);
    }
    double defect = 0, carried_defect = 0;
    for (int c = 0; c < C; ++c) {
      double momentum = 0;
      for (int d = 0; d < D; ++d) momentum += Fm[d][i] * Um[d][c][i] - Fp[d][i] * Up[d][c][i];
      const double now = (m[c][i] - dp[c][i]) + momentum;
      mn[c][i] = now;
      const double change = now * w - v[c][i];
      (c < D ? defect : carried_defect) += change * change;
    }
    if constexpr (C > D) defect += carried_defect;
    return gain - 0.5 * rho * defect;
  }

 private:
  const double *Fm[D], *Fp[D], *Um[D][C], *Up[D][C], *m[C], *dp[C], *v[C];
  double* mn[C];
};

template <int D, int C>
void update_row(const Row& row, const UpdateHandles& h) {
  const int n = row.count();
  const MotionRows<D, C> motion(row, h);
  const double* Gm[D];
  const double* Gp[D];
  for (int d = 0; d < D; ++d) {
    Gm[d] = row(h.flux[d], 1);
    Gp[d] = row(h.flux[d], 1, d, 1);
  }
  const double* __restrict r = row(h.rho);
  const double* __restrict Es = row(h.energy_star);
  double* __restrict rn = row(h.next.rho);
  double* __restrict En = row(h.next.energy);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double rho = r[i] + motion.mass(i);
    rn[i] = rho;
    En[i] = Es[i] + motion.heat(i, rho, 1.0 / rho, [&](int d) { return Gm[d][i] - Gp[d][i]; });
  }
}

// Of the third order, whose fluxes ask nothing of the Lagrangian phase.
inline void check_row_of_new_state(const Row& row, const UpdateHandles& h, const SchemeOptions& o,
                                   int material) {
  const double *rho = row(h.next.rho), *energy = row(h.next.energy), *admissible = energy;
  if (o.materials.fluid.gamma_law() == nullptr) {
    admissible_row(o.materials.fluid, row.count(), rho, energy, row(h.next.closure, 2));
    admissible = row(h.next.closure, 2);
  }
  admissible_row<2>(
      row, o.grid.axes,
      {{{rho, fault_density}, {admissible, fault_of_material * (material + 1), nullptr, energy}}},
      material);
}

// An ideal gas needs a positive energy, any other law says itself what it bears. `material`: whose
// law it is.
inline void check_row(const Row& row, const UpdateHandles& h, const SchemeOptions& o,
                      int material) {
  const auto inverse = [](double x) { return 1.0 / x; };
  const Axes& axes = o.grid.axes;
  const int state = fault_of_material * (material + 1);
  const double* energy = row(h.next.energy);
  if (o.scheme.third_order) return check_row_of_new_state(row, h, o, material);
  if (o.materials.fluid.gamma_law() == nullptr) {
    admissible_row(o.materials.fluid, row.count(), row(h.next.rho), energy, row(h.next.closure, 2));
    return admissible_row<4>(row, axes,
                             {{{row(h.next.rho), fault_density},
                               {row(h.inverse_J), fault_volume, inverse},
                               {row(h.next.closure, 2), state, nullptr, energy},
                               {row(h.energy_scale), state, nullptr, energy}}},
                             material);
  }
  admissible_row<4>(row, axes,
                    {{{row(h.next.rho), fault_density},
                      {row(h.inverse_J), fault_volume, inverse},
                      {energy, state},
                      {row(h.energy_star), state}}},
                    material);
}

// What the checks and rates of the new state read.
inline UpdateHandles read_end_of_step(TaskBuilder& task, const EndOfStepInput& v,
                                      const SchemeOptions& o) {
  UpdateHandles h;
  h.energy_star = task.read(v.energy_star);
  h.inverse_J = task.read(v.inverse_J);
  read_transport(task, v, o, h.next);
  if (!o.scheme.conservative_time_step) return h;
  h.next.sound = task.read(v.sound, Stencil::box(1));
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    h.next.face_velocity[axis] =
        task.read(v.face_velocity[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  }
  return h;
}

// All that is read; what is written belongs to the caller.
inline UpdateHandles read_update(TaskBuilder& task, const AmountsInput& v, const SchemeOptions& o) {
  UpdateHandles h = read_end_of_step(task, v.end, o);
  h.rho = task.read(v.rho);
  h.momentum = task.read(v.momentum);
  h.impulse = task.read(v.impulse);
  h.velocity_L = task.read(v.velocity_L);
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    h.flux[axis] = task.read(v.flux[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  }
  return h;
}

inline UpdateHandles declare_update(TaskBuilder& task, const UpdateInput& v,
                                    const SchemeOptions& o) {
  UpdateHandles h = read_update(task, v.amounts, o);
  h.next.rho = task.write(v.rho);
  h.next.momentum = task.write(v.momentum);
  h.next.energy = task.write(v.energy);
  if (o.transport.conducting && !constant_heat_capacity(o.materials.fluid))
    h.next.heat_capacity = task.write(v.heat_capacity);
  if (o.materials.fluid.gamma_law() != nullptr) return h;
  if (!o.scheme.third_order) h.energy_scale = task.read(v.energy_scale);
  h.next.closure = task.write(v.closure);
  return h;
}

}  // namespace sluice::ice
