// Step 9: the new state from single-valued face fluxes; time-step rates; admissibility.
//
//   rho' = rho + sum_d (F- - F+)          m' = (m - dp) + sum_d (F- U- - F+ U+)
//   E'   = E* + sum_d [ (G- - G+) + (F- |U- - v|^2 - F+ |U+ - v|^2)/2 ] - rho' |m'/rho' - v|^2 / 2
// v is the cell's own Lagrangian velocity: algebraically this conserves total energy with the
// kinetic flux F |U|^2/2 + F K, but no large numbers are subtracted. A cell whose net fluxes are
// zero keeps its bits.
// Rates: the deck's rule max_d (|u_d| + knob c)/dx_d (aggressive) or the outflow rule with face
// velocities (conservative); the scheme's own sum_d |u_d|/dx_d and max_d (|u_d| + c)/dx_d.
#include "framework/task/reductions.hpp"
#include "ice/conservative/variables.hpp"
#include "ice/limiters.hpp"

namespace sluice::ice {
namespace {

struct Handles {
  In rho, momentum, impulse, velocity_L, energy_star, inverse_J, sound;
  std::array<In, 3> flux, face_velocity;
  Out rho_new, momentum_new, energy_new;
};

struct Rates {
  double inverse_dx[3] = {0, 0, 0};
  double knob = 1;
  double gravity_speed = 0;  // sqrt(sum dx |g|), conservative rule only
  bool conservative = false;
};

template <int D, int C>
void update_row(const Row& row, const Handles& h) {
  const int n = row.count();
  const double* Fm[3];
  const double* Fp[3];
  const double* Gm[3];
  const double* Gp[3];
  const double* Um[3][3];
  const double* Up[3][3];
  for (int d = 0; d < D; ++d) {
    const In flux = h.flux[static_cast<std::size_t>(d)];
    Fm[d] = row(flux, 0);
    Fp[d] = row(flux, 0, d, 1);
    Gm[d] = row(flux, 1);
    Gp[d] = row(flux, 1, d, 1);
    for (int c = 0; c < C; ++c) {
      Um[d][c] = row(flux, 2 + c);
      Up[d][c] = row(flux, 2 + c, d, 1);
    }
  }
  const double* m[3];
  const double* dp[3];
  const double* v[3];
  double* mn[3];
  for (int c = 0; c < C; ++c) {
    m[c] = row(h.momentum, c);
    dp[c] = row(h.impulse, c);
    v[c] = row(h.velocity_L, c);
    mn[c] = row(h.momentum_new, c);
  }
  const double* __restrict r = row(h.rho);
  const double* __restrict Es = row(h.energy_star);
  double* __restrict rn = row(h.rho_new);
  double* __restrict En = row(h.energy_new);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double mass = 0;
    for (int d = 0; d < D; ++d) mass += Fm[d][i] - Fp[d][i];
    const double rho = r[i] + mass;
    const double w = 1.0 / rho;
    double gain = 0;
    for (int d = 0; d < D; ++d) {
      double in = 0, out = 0;
      for (int c = 0; c < C; ++c) {
        in += (Um[d][c][i] - v[c][i]) * (Um[d][c][i] - v[c][i]);
        out += (Up[d][c][i] - v[c][i]) * (Up[d][c][i] - v[c][i]);
      }
      gain += (Gm[d][i] - Gp[d][i]) + 0.5 * (Fm[d][i] * in - Fp[d][i] * out);
    }
    double defect = 0;
    for (int c = 0; c < C; ++c) {
      double momentum = 0;
      for (int d = 0; d < D; ++d) momentum += Fm[d][i] * Um[d][c][i] - Fp[d][i] * Up[d][c][i];
      const double now = (m[c][i] - dp[c][i]) + momentum;
      mn[c][i] = now;
      const double change = now * w - v[c][i];
      defect += change * change;
    }
    rn[i] = rho;
    En[i] = Es[i] + (gain - 0.5 * rho * defect);
  }
}

// Counts cells that are not admissible; NaN fails every comparison.
template <int D>
void admissible_row(const Row& row, const Handles& h, const Axes& axes) {
  const int n = row.count();
  const double* __restrict r = row(h.rho_new);
  const double* __restrict E = row(h.energy_new);
  const double* __restrict iJ = row(h.inverse_J);
  const double* __restrict Es = row(h.energy_star);
  int bad = 0;
  for (int i = 0; i < n; ++i) bad += !((r[i] > 0.0) & (E[i] > 0.0) & (iJ[i] > 0.0) & (Es[i] > 0.0));
  if (bad == 0) return;
  for (int i = 0; i < n; ++i) {
    CellFault f;
    f.cell = row.cell();
    f.cell[axes.direction[0]] += i;
    f.level = row.step().level;
    if (!(r[i] > 0.0)) {
      f.kind = fault_density;
      f.value = r[i];
    } else if (!(iJ[i] > 0.0)) {
      f.kind = fault_volume;
      f.value = 1.0 / iJ[i];
    } else if (!(E[i] > 0.0) || !(Es[i] > 0.0)) {
      f.kind = fault_energy;
      f.value = E[i] > 0.0 ? Es[i] : E[i];
    } else {
      continue;
    }
    row.reductions().fault(f);
  }
}

template <int D>
void rate_row(const Row& row, const Handles& h, const Rates& x, const eos::IdealGas& gas) {
  const int n = row.count();
  const double* __restrict r = row(h.rho_new);
  const double* __restrict E = row(h.energy_new);
  const double* m[3];
  for (int d = 0; d < D; ++d) m[d] = row(h.momentum_new, d);
  std::int64_t deck = 0, flow = 0, sound = 0;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double w = 1.0 / r[i];
    const double c = std::sqrt(gas.gamma * gas.pressure(r[i], E[i]) * w);
    double deck_rate = 0, flow_rate = 0, sound_rate = 0;
    for (int d = 0; d < D; ++d) {
      const double speed = std::fabs(m[d][i]) * w;
      deck_rate = larger(deck_rate, (speed + x.knob * c) * x.inverse_dx[d]);
      sound_rate = larger(sound_rate, (speed + c) * x.inverse_dx[d]);
      flow_rate += speed * x.inverse_dx[d];
    }
    const std::int64_t a = ordered_bits(deck_rate), b = ordered_bits(flow_rate),
                       s = ordered_bits(sound_rate);
    deck = a > deck ? a : deck;
    flow = b > flow ? b : flow;
    sound = s > sound ? s : sound;
  }
  if (!x.conservative) row.reductions().maximum(StepSlots::deck_rate, deck);
  row.reductions().maximum(StepSlots::flow_rate, flow);
  row.reductions().maximum(StepSlots::sound_rate, sound);
}

// Sum over directions of the outflow of a cell, each side widened by sound, shear and gravity:
// what the deck's conservative rule bounds by V cfl / dt.
template <int D>
void outflow_rate_row(const Row& row, const Handles& h, const Rates& x) {
  const int n = row.count();
  const double* um[3];
  const double* up[3];
  const double* cm[3];
  const double* cp[3];
  const double* c = row(h.sound);
  for (int d = 0; d < D; ++d) {
    const In faces = h.face_velocity[static_cast<std::size_t>(d)];
    um[d] = row(faces);
    up[d] = row(faces, 0, d, 1);
    cm[d] = row(h.sound, 0, d, -1);
    cp[d] = row(h.sound, 0, d, 1);
  }
  std::int64_t most = 0;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double rate = 0;
    for (int d = 0; d < D; ++d) {
      const double margin = std::fabs(up[d][i] - um[d][i]) + x.gravity_speed;
      const double right = up[d][i] + x.knob * larger(c[i], cp[d][i]) + margin;
      const double left = um[d][i] - x.knob * larger(c[i], cm[d][i]) - margin;
      rate += (larger(0.0, right) + larger(0.0, -left)) * x.inverse_dx[d];
    }
    const std::int64_t a = ordered_bits(rate);
    most = a > most ? a : most;
  }
  row.reductions().maximum(StepSlots::deck_rate, most);
}

Handles declare(TaskBuilder& task, const SchemeVariables& v, const SchemeOptions& o) {
  Handles h;
  h.rho = task.read(v.rho);
  h.momentum = task.read(v.momentum);
  h.impulse = task.read(v.impulse);
  h.velocity_L = task.read(v.velocity_L);
  h.energy_star = task.read(v.energy_star);
  h.inverse_J = task.read(v.inverse_J);
  if (o.conservative_time_step) h.sound = task.read(v.sound, Stencil::box(1));
  for (int axis = 0; axis < o.axes.count; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const Stencil both = Stencil::along(o.axes.direction[axis], 0, 1);
    h.flux[a] = task.read(v.flux[a], both);
    if (o.conservative_time_step) h.face_velocity[a] = task.read(v.face_velocity[a], both);
  }
  h.rho_new = task.write(v.rho_new);
  h.momentum_new = task.write(v.momentum_new);
  h.energy_new = task.write(v.energy_new);
  return h;
}

}  // namespace

void add_update(TaskList& list, const SchemeVariables& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("update", effect);
  const Handles h = declare(task, v, o);
  dispatch(o.axes.count, o.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      Rates x;
      x.knob = o.sound_speed_knob;
      x.conservative = o.conservative_time_step;
      double dx_g = 0;
      for (int d = 0; d < D; ++d) {
        const double dx = row.step().spacing[o.axes.direction[d]];
        x.inverse_dx[d] = 1.0 / dx;
        dx_g += dx * std::fabs(o.gravity[o.axes.direction[d]]);
      }
      x.gravity_speed = std::sqrt(dx_g);
      update_row<D, C>(row, h);
      admissible_row<D>(row, h, o.axes);
      rate_row<D>(row, h, x, o.gas);
      if (x.conservative) outflow_rate_row<D>(row, h, x);
    });
  });
}

}  // namespace sluice::ice
