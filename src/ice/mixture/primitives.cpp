// Step 1 with several materials: the state of the mixture.
//
//   rho = sum M_m,  u = P/rho,  rho_m = M_m/V_m,  (rho e)_m = E_m/V_m
//   p = sum(V_m p_m/K_m)/sum(V_m/K_m),   K = 1/sum(V_m/K_m(rho_m, p)),   c = sqrt(K/rho)
//   pi = min over the materials,   shock slope = sum V_m A_m
// A cell with one material takes all of them from its law. (The energy-weighted mean of pressures
// would lose a gas beside a liquid in round-off.)
#include <algorithm>
#include <cmath>
#include <limits>

#include "ice/fluid/limiters.hpp"
#include "ice/mixture/presence.hpp"
#include "ice/mixture/tasks.hpp"
#include "ice/one_material/primitives_rows.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

struct Handles {
  StateReads state;
  In momentum, presence;
  LawsOfCells laws;
  Out rho, total_energy, velocity, pressure, sound, inverse_rho, shock_slope, pi;
  Out scratch;
};

// One material alone.
void pure_cells(const Row& row, const Handles& h, int m, const Fluid& fluid) {
  const int n = row.count();
  const double* __restrict M = row(h.state.mass[m]);
  const double* __restrict E = row(h.state.energy[m]);
  h.laws.of(row, m).primitives(n, M, E, row(h.inverse_rho), row(h.pressure), row(h.sound));
  double* __restrict rho = row(h.rho);
  double* __restrict energy = row(h.total_energy);
  double* __restrict slope = row(h.shock_slope);
  double* __restrict pi = row(h.pi);
  const double fluid_slope = fluid.shock_slope(), fluid_pi = -fluid.lowest_pressure();
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    rho[i] = M[i];
    energy[i] = E[i];
    slope[i] = fluid_slope;
    pi[i] = fluid_pi;
  }
}

// Sums over the materials of a mixture, and rows of one material for its law.
struct MixtureRows {
  double *rho, *energy, *p, *c, *slope, *pi;
  double* least;  // smallest p_m + pi_m
  double *pm, *Km, *r, *e;

  MixtureRows(const Row& row, const Handles& h)
      : rho(row(h.rho)),
        energy(row(h.total_energy)),
        p(row(h.pressure)),
        c(row(h.sound)),
        slope(row(h.shock_slope)),
        pi(row(h.pi)),
        least(row(h.scratch, 4)),
        pm(row(h.scratch, 0)),
        Km(row(h.scratch, 1)),
        r(row(h.scratch, 2)),
        e(row(h.scratch, 3)) {}
};

// Adds material m at its own pressure: `p` sums V_m p_m/K_m, `c` sums V_m/K_m.
void add_at_own_pressure(const Row& row, const Handles& h, int m, const Fluid& fluid,
                         const MixtureRows& x) {
  const int n = row.count();
  const double* __restrict M = row(h.state.mass[m]);
  const double* __restrict V = row(h.state.volume[m]);
  const double* __restrict E = row(h.state.energy[m]);
  const double fluid_slope = fluid.shock_slope(), fluid_pi = -fluid.lowest_pressure();
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double inverse = 1.0 / V[i];
    x.r[i] = M[i] * inverse;
    x.e[i] = E[i] * inverse;
  }
  h.laws.of(row, m).pressure_and_modulus(n, x.r, x.e, x.pm, x.Km);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double softness = V[i] / x.Km[i];
    x.rho[i] += M[i];
    x.energy[i] += E[i];
    x.p[i] += softness * x.pm[i];
    x.c[i] += softness;
    x.slope[i] += V[i] * fluid_slope;
    x.pi[i] = fluid_pi < x.pi[i] ? fluid_pi : x.pi[i];
    x.least[i] = smaller(x.least[i], x.pm[i] + fluid_pi);
  }
}

// Adds V_m/K_m of material m at the mean pressure to `c`.
void add_softness(const Row& row, const Handles& h, int m, const MixtureRows& x) {
  const int n = row.count();
  const double* __restrict M = row(h.state.mass[m]);
  const double* __restrict V = row(h.state.volume[m]);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) x.r[i] = M[i] / V[i];
  h.laws.of(row, m).modulus(n, x.r, x.p, x.Km);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) x.c[i] += V[i] / x.Km[i];
}

// Several materials in each cell: the same set along the row.
void mixed_cells(const Row& row, const Handles& h, std::uint64_t set,
                 const std::vector<Fluid>& fluids) {
  const int n = row.count();
  const MixtureRows x(row, h);
  double* __restrict w = row(h.inverse_rho);
  for (int i = 0; i < n; ++i) {
    x.rho[i] = x.energy[i] = x.p[i] = x.c[i] = x.slope[i] = 0.0;
    x.pi[i] = x.least[i] = std::numeric_limits<double>::infinity();
  }
  for_each_of(set, [&](int m) { add_at_own_pressure(row, h, m, fluids[m], x); });
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    // Cells that levels have just filled may hold gas and a liquid under tension: the mean is then
    // no pressure of the gas, and what it has itself counts.
    const double mean = x.p[i] / x.c[i], pi = x.pi[i];
    x.p[i] = mean + pi > 0.0 ? mean : x.least[i] - pi;
    w[i] = 1.0 / x.rho[i];
    x.c[i] = 0.0;
  }
  for_each_of(set, [&](int m) { add_softness(row, h, m, x); });
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) x.c[i] = std::sqrt(w[i] / x.c[i]);
}

// Ideal gases alone: V_m/K_m = V_m^2/(gamma_m (gamma_m - 1) E_m), and K at the pressure p is that
// at the pressures of the gases.
void mixed_gases(const Row& row, const Handles& h, std::uint64_t set,
                 const std::vector<Fluid>& fluids) {
  const int n = row.count();
  double* __restrict rho = row(h.rho);
  double* __restrict energy = row(h.total_energy);
  double* __restrict w = row(h.inverse_rho);
  double* __restrict p = row(h.pressure);
  double* __restrict c = row(h.sound);
  double* __restrict slope = row(h.shock_slope);
  double* __restrict pi = row(h.pi);
  std::fill_n(pi, n, 0.0);
  const auto add = [&](int m, auto to) {  // to(sum so far, value)
    const double gamma = fluids[m].gamma_law()->gamma, fluid_slope = fluids[m].shock_slope();
    const double per_gamma = 1.0 / gamma, per_K = 1.0 / (gamma * (gamma - 1.0));
    const double* __restrict M = row(h.state.mass[m]);
    const double* __restrict V = row(h.state.volume[m]);
    const double* __restrict E = row(h.state.energy[m]);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      rho[i] = to(rho[i], M[i]);
      energy[i] = to(energy[i], E[i]);
      p[i] = to(p[i], V[i] * per_gamma);
      c[i] = to(c[i], V[i] * V[i] * per_K / E[i]);
      slope[i] = to(slope[i], V[i] * fluid_slope);
    }
  };
  bool first = true;
  for_each_of(set, [&](int m) {
    if (first)
      add(m, [](double, double value) { return value; });
    else
      add(m, [](double sum, double value) { return sum + value; });
    first = false;
  });
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    w[i] = 1.0 / rho[i];
    p[i] = p[i] / c[i];
    c[i] = std::sqrt(w[i] / c[i]);
  }
}

// Density and energy of each material per its own volume.
void add_material_values(TaskList& list, const PrimitivesInput& v, int effect) {
  TaskBuilder task = list.task("values of each material", effect);
  const StateReads state = read_state(task, v.materials.state);
  const Out density = task.write(v.density), specific_energy = task.write(v.specific_energy);
  task.kernel([=](const Row& row) {
    const int n = row.count();
    for (std::size_t m = 0; m < state.mass.size(); ++m) {
      const double* __restrict M = row(state.mass[m]);
      const double* __restrict V = row(state.volume[m]);
      const double* __restrict E = row(state.energy[m]);
      double* __restrict r = row(density, static_cast<int>(m));
      double* __restrict e = row(specific_energy, static_cast<int>(m));
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) {
        const double inverse = per_own_volume(V[i]);
        r[i] = M[i] * inverse;
        e[i] = E[i] * inverse;
      }
    }
  });
}

void add_mixture_values(TaskList& list, const PrimitivesInput& v, const SchemeOptions& o,
                        int effect) {
  TaskBuilder task = list.task("primitives", effect);
  Handles h;
  h.state = read_state(task, v.materials.state);
  h.momentum = task.read(v.momentum);
  h.presence = task.read(v.materials.presence);
  h.rho = task.write(v.rho);
  h.total_energy = task.write(v.energy);
  h.velocity = task.write(v.velocity);
  h.pressure = task.write(v.pressure);
  h.sound = task.write(v.sound);
  h.inverse_rho = task.write(v.inverse_rho);
  h.shock_slope = task.write(v.shock_slope);
  h.pi = task.write(v.pi);
  h.scratch = task.write(list.temporary("closure of a material", 5));
  h.laws = LawsOfCells(task, list, o);
  const std::vector<Fluid> fluids = o.materials.fluids;
  const int components = o.grid.components;
  const bool gases = h.laws.all_plain() && all_ideal_gases(fluids);
  task.kernel([=](const Row& row) {
    const int room = row.whole_vectors();
    for_each_run(runs_of(row, h.presence), row.count(), [&](int first, int count, double presence) {
      // Cells beyond come after these. Other laws may search for a root there.
      const Row part = row.part(first, gases ? whole_vectors(count, room - first) : count);
      const int m = first_of(presence);
      if (is_single(presence))
        pure_cells(part, h, m, fluids[m]);
      else if (gases)
        mixed_gases(part, h, as_set(presence), fluids);
      else
        mixed_cells(part, h, as_set(presence), fluids);
    });
    velocity_rows(row, h.momentum, h.velocity, row(h.inverse_rho), components);
  });
}

}  // namespace

void add_primitives(TaskList& list, const PrimitivesInput& v, const SchemeOptions& o, int effect,
                    bool of_each) {
  add_presence(list, v.materials, o, effect);
  add_mixture_values(list, v, o, effect);
  if (of_each) add_material_values(list, v, effect);
}

}  // namespace sluice::ice::mixture
