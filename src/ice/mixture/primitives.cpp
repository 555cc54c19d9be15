// Step 1 with several materials: who is where, and the state of the mixture.
//
//   rho = sum M_m,  u = P/rho,  rho_m = M_m/V_m,  (rho e)_m = E_m/V_m
//   p = sum(V_m p_m/K_m)/sum(V_m/K_m),   K = 1/sum(V_m/K_m(rho_m, p)),   c = sqrt(K/rho)
//   pi = min over the materials,   shock slope = sum V_m A_m
// A cell with one material takes all of them from its law. (The energy-weighted mean of pressures
// would lose a gas beside a liquid in round-off.)
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "ice/closure_rows.hpp"
#include "ice/conservative/primitives_rows.hpp"
#include "ice/limiters.hpp"
#include "ice/material_runs.hpp"
#include "ice/mixture/variables.hpp"
#include "ice/scalars/mixed_gas.hpp"

namespace sluice::ice::mixture {
namespace {

void add_presence(TaskList& list, const Variables& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("presence of materials", effect);
  const auto [mass, volume, energy] = read_state(task, v);
  const Out presence = task.write(v.presence);
  const int last_axis = o.axes.count - 1;
  task.kernel([=](const Row& row) {
    double* __restrict set = row(presence);
    RunWriter runs(set, row(presence, 1));
    for_each_marked(row, row.old_marks(), [&](int first, int count, int alone) {
      if (alone >= 0) return runs.add(count, only(alone));
      const int end = first + count;
      // Few cells of a row: what this task and the next read soon is asked for now.
      for (std::size_t m = 0; m < mass.size(); ++m) {
        ask_for(row(mass[m], 0, last_axis, 1) + first, count);
        ask_for(row(volume[m]) + first, count);
        ask_for(row(energy[m]) + first, count);
      }
      for (std::size_t m = 0; m < mass.size(); ++m) {
        const double* __restrict M = row(mass[m]);
        const double bit = only(static_cast<int>(m));
#pragma GCC ivdep
        for (int i = first; i < end; ++i)
          set[i] = (m == 0 ? 0.0 : set[i]) + (M[i] != 0.0 ? bit : 0.0);
      }
      runs.find(count);
    });
    runs.close();
  });
}

// The material that a cell and all cells around it hold alone.
void add_neighbourhood(TaskList& list, const Variables& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("pure neighbourhoods", effect);
  const In presence = task.read(v.presence, Stencil::box(1));
  const Out pure = task.write(v.pure);
  const int axes = o.axes.count;
  task.kernel([=](const Row& row) {
    RunRow around[9];  // from the cell before the row on
    int rows = 0;
    for (int dk = axes > 2 ? -1 : 0; dk <= (axes > 2 ? 1 : 0); ++dk)
      for (int dj = axes > 1 ? -1 : 0; dj <= (axes > 1 ? 1 : 0); ++dj)
        around[rows++] = {row.at_offset(presence, 0, {-1, dj, dk}),
                          row.at_offset(presence, 1, {-1, dj, dk})};
    write_pure(around, rows, row.count(), row(pure), row(pure, 1), row.whole_vectors());
  });
}

// Cells of unlike neighbourhood, and those that share a face with one.
void add_near(TaskList& list, const Variables& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("cells near several materials", effect);
  std::array<In, 3> pure;
  for (int axis = 0; axis < o.axes.count; ++axis)
    pure[static_cast<std::size_t>(axis)] =
        task.read(v.pure, Stencil::along(o.axes.direction[axis], 1, 1));
  const Out near = task.write(v.near);
  const int axes = o.axes.count;
  task.kernel([=](const Row& row) {
    RunRow around[2 * 3 + 1];
    int rows = 0;
    around[rows++] = runs_of(row, pure[0]);
    for (int axis = 0; axis < axes; ++axis)
      for (const int shift : {-1, 1})
        around[rows++] = runs_of(row, pure[static_cast<std::size_t>(axis)], axis, shift);
    write_near(around, rows, row.count(), row(near), row(near, 1), row.whole_vectors());
  });
}

// Density and energy of a material that is in all these cells, per its own volume. Returns whether
// it fills a fair part of each, but not the whole.
bool values_in_blend(int n, const double* __restrict M, const double* __restrict V,
                     const double* __restrict E, double* __restrict r, double* __restrict e) {
  int fair = 1;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double inverse = 1.0 / V[i];
    r[i] = M[i] * inverse;
    e[i] = E[i] * inverse;
    fair &= int{V[i] >= fair_part} & int{V[i] < 1.0};
  }
  return fair != 0;
}

// Runs of cells in which several materials fill a fair part, and the values of each there. A choice
// of loops alone hangs on it; short runs are worth none.
void add_blends(TaskList& list, const Variables& v, int effect) {
  constexpr int fewest = 16;
  TaskBuilder task = list.task("blends of materials", effect);
  const In presence = task.read(v.presence);
  const StateReads state = read_state(task, v);
  const Out blend = task.write(v.blend);
  const Out density = task.write(v.blend_density), energy = task.write(v.blend_energy);
  task.kernel([=](const Row& row) {
    RunWriter runs(row(blend), row(blend, 1));
    for_each_run(runs_of(row, presence), row.count(), [&](int first, int count, double key) {
      const Row part = row.part(first, count);
      bool fair = count >= fewest && !is_single(key);
      for (std::uint64_t left = fair ? as_set(key) : 0; left != 0 && fair; left &= left - 1) {
        const int m = std::countr_zero(left);
        const auto k = static_cast<std::size_t>(m);
        fair = values_in_blend(count, part(state.mass[k]), part(state.volume[k]),
                               part(state.energy[k]), part(density, m), part(energy, m));
      }
      runs.add(count, fair ? key : 0.0);
    });
    runs.close();
  });
}

// 1 where the fraction of a mixed gas is that of all cells around which hold the gas.
void add_alike(TaskList& list, const Variables& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("the same fraction around", effect);
  const In fraction = task.read(scalars::old_fraction(list, o), Stencil::box(1));
  const In mass = task.read(v.mass[static_cast<std::size_t>(o.mixed->material)], Stencil::box(1));
  const Out alike = task.write(v.alike);
  task.kernel([=, axes = o.axes.count](const Row& row) {
    const int n = row.count();
    const double* __restrict f = row(fraction);
    double* __restrict same = row(alike);
    for (int i = 0; i < n; ++i) same[i] = 1.0;
    for (int axis = 0; axis < axes; ++axis)
      for (const int shift : {-1, 1}) {
        const double* __restrict other = row(fraction, 0, axis, shift);
        const double* __restrict M = row(mass, 0, axis, shift);
        for (int i = 0; i < n; ++i) {
          const bool differs = (int{M[i] > 0.0} & int{other[i] != f[i]}) != 0;
          same[i] = differs ? 0.0 : same[i];
        }
      }
  });
}

struct Handles {
  StateReads state;
  In momentum, presence;
  const models::MixedGas* gas = nullptr;  // a material that is a mixture itself
  In fraction;
  Out rho, total_energy, velocity, pressure, sound, inverse_rho, shock_slope, pi;
  Out scratch;
};

// One material alone.
void pure_cells(const Row& row, const Handles& h, int m, const Fluid& fluid) {
  const int n = row.count();
  const auto k = static_cast<std::size_t>(m);
  const double* __restrict M = row(h.state.mass[k]);
  const double* __restrict E = row(h.state.energy[k]);
  if (scalars::is_mixed(h.gas, k))
    scalars::mixed_primitive_row(*h.gas, n, row(h.fraction), M, E, row(h.inverse_rho),
                                 row(h.pressure), row(h.sound));
  else
    primitive_row(fluid, n, M, E, row(h.inverse_rho), row(h.pressure), row(h.sound));
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

// Several materials in each cell: the same set along the row.
void mixed_cells(const Row& row, const Handles& h, std::uint64_t set,
                 const std::vector<Fluid>& fluids) {
  const int n = row.count();
  double* __restrict rho = row(h.rho);
  double* __restrict energy = row(h.total_energy);
  double* __restrict w = row(h.inverse_rho);
  double* __restrict least = row(h.scratch, 4);  // p_m + pi_m
  double* __restrict p = row(h.pressure);
  double* __restrict c = row(h.sound);
  double* __restrict slope = row(h.shock_slope);
  double* __restrict pi = row(h.pi);
  double* __restrict pm = row(h.scratch, 0);
  double* __restrict Km = row(h.scratch, 1);
  double* __restrict r = row(h.scratch, 2);
  double* __restrict e = row(h.scratch, 3);
  for (int i = 0; i < n; ++i) {
    rho[i] = energy[i] = p[i] = c[i] = slope[i] = 0.0;
    pi[i] = least[i] = std::numeric_limits<double>::infinity();
  }
  for_each_of(set, [&](int m) {
    const auto k = static_cast<std::size_t>(m);
    const Fluid& fluid = fluids[k];
    const double* __restrict M = row(h.state.mass[k]);
    const double* __restrict V = row(h.state.volume[k]);
    const double* __restrict E = row(h.state.energy[k]);
    const double fluid_slope = fluid.shock_slope(), fluid_pi = -fluid.lowest_pressure();
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double inverse = 1.0 / V[i];
      r[i] = M[i] * inverse;
      e[i] = E[i] * inverse;
    }
    if (scalars::is_mixed(h.gas, k))
      scalars::mixed_pressure_and_modulus_row(*h.gas, n, row(h.fraction), e, pm, Km);
    else
      pressure_and_modulus_row(fluid, n, r, e, pm, Km);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double softness = V[i] / Km[i];
      rho[i] += M[i];
      energy[i] += E[i];
      p[i] += softness * pm[i];
      c[i] += softness;
      slope[i] += V[i] * fluid_slope;
      pi[i] = fluid_pi < pi[i] ? fluid_pi : pi[i];
      least[i] = smaller(least[i], pm[i] + fluid_pi);
    }
  });
  for (int i = 0; i < n; ++i) {
    // Cells that levels have just filled may hold gas and a liquid under tension: the mean is then
    // no pressure of the gas, and what it has itself counts.
    const double mean = p[i] / c[i];
    p[i] = mean + pi[i] > 0.0 ? mean : least[i] - pi[i];
    w[i] = 1.0 / rho[i];
    c[i] = 0.0;
  }
  for_each_of(set, [&](int m) {
    const auto k = static_cast<std::size_t>(m);
    const double* __restrict M = row(h.state.mass[k]);
    const double* __restrict V = row(h.state.volume[k]);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) r[i] = M[i] / V[i];
    if (scalars::is_mixed(h.gas, k))
      scalars::mixed_modulus_row(*h.gas, n, row(h.fraction), p, Km);
    else
      modulus_row(fluids[k], n, r, p, Km);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) c[i] += V[i] / Km[i];
  });
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) c[i] = std::sqrt(w[i] / c[i]);
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
    const auto k = static_cast<std::size_t>(m);
    const double gamma = fluids[k].ideal()->gamma, fluid_slope = fluids[k].shock_slope();
    const double per_gamma = 1.0 / gamma, per_K = 1.0 / (gamma * (gamma - 1.0));
    const double* __restrict M = row(h.state.mass[k]);
    const double* __restrict V = row(h.state.volume[k]);
    const double* __restrict E = row(h.state.energy[k]);
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
void add_material_values(TaskList& list, const Variables& v, int effect) {
  TaskBuilder task = list.task("values of each material", effect);
  const StateReads state = read_state(task, v);
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

void add_mixture_values(TaskList& list, const Variables& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("primitives", effect);
  Handles h;
  h.state = read_state(task, v);
  h.momentum = task.read(v.common.momentum);
  h.presence = task.read(v.presence);
  h.rho = task.write(v.common.rho);
  h.total_energy = task.write(v.common.energy);
  h.velocity = task.write(v.common.velocity);
  h.pressure = task.write(v.common.pressure);
  h.sound = task.write(v.common.sound);
  h.inverse_rho = task.write(v.common.inverse_rho);
  h.shock_slope = task.write(v.common.shock_slope);
  h.pi = task.write(v.common.pi);
  h.scratch = task.write(list.temporary("closure of a material", 5));
  h.gas = o.mixed;
  if (o.mixed != nullptr) h.fraction = task.read(scalars::old_fraction(list, o));
  const std::vector<Fluid> fluids = o.fluids;
  const int components = o.components;
  const bool gases = o.mixed == nullptr && all_ideal_gases(fluids);
  task.kernel([=](const Row& row) {
    const int room = row.whole_vectors();
    for_each_run(runs_of(row, h.presence), row.count(), [&](int first, int count, double presence) {
      // Cells beyond come after these. Other laws may search for a root there.
      const Row part = row.part(first, gases ? whole_vectors(count, room - first) : count);
      const int m = first_of(presence);
      if (is_single(presence))
        pure_cells(part, h, m, fluids[static_cast<std::size_t>(m)]);
      else if (gases)
        mixed_gases(part, h, as_set(presence), fluids);
      else
        mixed_cells(part, h, as_set(presence), fluids);
    });
    velocity_rows(row, h.momentum, h.velocity, row(h.inverse_rho), components);
  });
}

}  // namespace

void add_primitives(TaskList& list, const Variables& v, const SchemeOptions& o, int effect,
                    bool of_each) {
  add_presence(list, v, o, effect);
  add_neighbourhood(list, v, o, effect);
  add_near(list, v, o, effect);
  if (o.second_order) add_blends(list, v, effect);
  add_mixture_values(list, v, o, effect);
  if (of_each) add_material_values(list, v, effect);
  if (o.mixed != nullptr && o.second_order) add_alike(list, v, o, effect);
}

}  // namespace sluice::ice::mixture
