// Step 9 with several materials: new masses, volumes and energies; one pressure; rates.
//
//   M_m' = M_m + sum_d (FM- - FM+)     V_m' = V_m J + sum_d (FV- - FV+)
//   E_m' = E_mL + sum_d (G_m- - G_m+) + k M_m'/rho'
//   k = sum_d (F- |U- - v|^2 - F+ |U+ - v|^2)/2 - rho' |m'/rho' - v|^2/2
// the kinetic energy that the remap loses goes to the materials by mass. A material that ended with
// no mass is gone: what is left of its energy goes into k. Then one pressure
// (equilibrate.hpp), heat between the materials (heat_exchange.hpp) and one pressure again.
// Cells of pure neighbourhood run the rows of one material.
#include "ice/conservative/update_rows.hpp"
#include "ice/mixture/collapse.hpp"
#include "ice/mixture/equilibrate.hpp"
#include "ice/mixture/heat_exchange.hpp"
#include "ice/mixture/runs.hpp"
#include "ice/mixture/variables.hpp"

namespace sluice::ice::mixture {
namespace {

struct MaterialState {
  In mass, volume;
  Out mass_new, volume_new, energy_new;
};

struct Handles {
  UpdateHandles common;
  In lagrangian, energy_L, pure;
  std::array<In, 3> flux;  // of each material
  std::vector<MaterialState> state;
  Out end, pressure, closure;  // density and modulus of the new mixture; closure of one material
};

// What the update of one material calls its own.
UpdateHandles handles_of(const Handles& h, int m) {
  UpdateHandles u = h.common;
  const MaterialState& s = h.state[static_cast<std::size_t>(m)];
  u.next.rho = s.mass_new;
  u.next.energy = s.energy_new;
  u.next.closure = h.closure;
  return u;
}

void end_row(const Fluid& fluid, int n, const double* rho, const double* E, double* density,
             double* p, double* K) {
  std::copy(rho, rho + n, density);
  if (const eos::IdealGas* gas = fluid.ideal()) {
    for (int i = 0; i < n; ++i) {
      p[i] = gas->pressure(rho[i], E[i]);
      K[i] = gas->gamma * p[i];
    }
    return;
  }
  pressure_and_modulus_row(fluid, n, rho, E, p, K);
}

// `o`: the options of material m.
template <int D, int C>
void pure_cells(const Row& row, const Handles& h, const SchemeOptions& o, int m) {
  const int n = row.count();
  const UpdateHandles u = handles_of(h, m);
  update_row<D, C>(row, u);
  check_row(row, u, o);
  end_row(o.fluid, n, row(u.next.rho), row(u.next.energy), row(h.end, 0), row(h.pressure),
          row(h.end, 1));
  for (int other = 0; other < static_cast<int>(h.state.size()); ++other) {
    const MaterialState& s = h.state[static_cast<std::size_t>(other)];
    double* V = row(s.volume_new);
    for (int i = 0; i < n; ++i) V[i] = other == m ? 1.0 : 0.0;
    if (other == m) continue;
    double *M = row(s.mass_new), *E = row(s.energy_new);
    for (int i = 0; i < n; ++i) M[i] = E[i] = 0.0;
  }
}

// Mass, volume and energy of each material after the remap, without k.
template <int D>
void remap_materials(const Row& row, const Handles& h) {
  const int n = row.count();
  const double* __restrict J = row(h.lagrangian, 0);
  for (int m = 0; m < static_cast<int>(h.state.size()); ++m) {
    const MaterialState& s = h.state[static_cast<std::size_t>(m)];
    const double *M = row(s.mass), *V = row(s.volume), *E_L = row(h.energy_L, m);
    double *Mn = row(s.mass_new), *Vn = row(s.volume_new), *En = row(s.energy_new);
    const double *minus[3][D], *plus[3][D];
    for (int q = 0; q < 3; ++q)
      for (int d = 0; d < D; ++d) {
        const In flux = h.flux[static_cast<std::size_t>(d)];
        minus[q][d] = row(flux, 3 * m + q);
        plus[q][d] = row(flux, 3 * m + q, d, 1);
      }
    const auto gain = [&](int q, int i) {
      double sum = 0;
      for (int d = 0; d < D; ++d) sum += minus[q][d][i] - plus[q][d][i];
      return sum;
    };
    for (int i = 0; i < n; ++i) {
      Vn[i] = V[i] * J[i] + gain(of_volume, i);
      Mn[i] = M[i] + gain(of_mass, i);
      En[i] = E_L[i] + gain(of_energy, i);
    }
  }
}

// New density and momentum of the mixture; k in `defect`.
template <int D, int C>
void mixture_motion(const Row& row, const Handles& h, double* __restrict density,
                    double* __restrict defect) {
  const int n = row.count();
  for (int i = 0; i < n; ++i) density[i] = 0.0;
  for (const MaterialState& s : h.state) {
    const double* M = row(s.mass_new);
    for (int i = 0; i < n; ++i) density[i] += M[i];
  }
  const double *Fm[D], *Fp[D], *Um[D][C], *Up[D][C], *m[C], *dp[C], *v[C];
  double* mn[C];
  for (int d = 0; d < D; ++d) {
    const In flux = h.common.flux[static_cast<std::size_t>(d)];
    Fm[d] = row(flux, 0);
    Fp[d] = row(flux, 0, d, 1);
    for (int c = 0; c < C; ++c) {
      Um[d][c] = row(flux, 2 + c);
      Up[d][c] = row(flux, 2 + c, d, 1);
    }
  }
  for (int c = 0; c < C; ++c) {
    m[c] = row(h.common.momentum, c);
    dp[c] = row(h.common.impulse, c);
    v[c] = row(h.common.velocity_L, c);
    mn[c] = row(h.common.next.momentum, c);
  }
  for (int i = 0; i < n; ++i) {
    double gain = 0;
    for (int d = 0; d < D; ++d) {
      double in = 0, out = 0, carried_in = 0, carried_out = 0;
      for (int c = 0; c < C; ++c) {
        (c < D ? in : carried_in) += (Um[d][c][i] - v[c][i]) * (Um[d][c][i] - v[c][i]);
        (c < D ? out : carried_out) += (Up[d][c][i] - v[c][i]) * (Up[d][c][i] - v[c][i]);
      }
      gain += 0.5 * (Fm[d][i] * (in + carried_in) - Fp[d][i] * (out + carried_out));
    }
    const double w = 1.0 / density[i];
    double square = 0, carried = 0;
    for (int c = 0; c < C; ++c) {
      double momentum = 0;
      for (int d = 0; d < D; ++d) momentum += Fm[d][i] * Um[d][c][i] - Fp[d][i] * Up[d][c][i];
      const double now = (m[c][i] - dp[c][i]) + momentum;
      mn[c][i] = now;
      const double change = now * w - v[c][i];
      (c < D ? square : carried) += change * change;
    }
    defect[i] = gain - 0.5 * density[i] * (square + carried);
  }
}

void report(const Row& row, const Axes& axes, int i, int kind, double value) {
  CellFault f;
  f.cell = row.cell();
  f.cell[axes.direction[0]] += i;
  f.level = row.step().level;
  f.kind = kind;
  f.value = value;
  row.reductions().fault(f);
}

// Nothing is left of a material, to the round-off of what was there: through one outlet it leaves
// to the bit (remap_fluxes.cpp), through several only the sum of their fluxes is all of it. Below
// `least` its numbers would lose their digits; no sum over cells knows of it.
bool is_gone(double M, double V, double M_before, double V_before) {
  constexpr double round_off = 16 * std::numeric_limits<double>::epsilon(), least = 1e-100;
  return M == 0.0 || std::fabs(V) < least || std::fabs(M) <= round_off * M_before ||
         (std::fabs(V) <= round_off * V_before && V_before > 0.0);
}

// Shares the defect out and finds the one pressure of each cell.
void finish_cells(const Row& row, const Handles& h, const SchemeOptions& o,
                  const Equilibration& equilibration, const Collapse& collapse,
                  const HeatExchange& heat) {
  const int n = row.count(), materials = static_cast<int>(h.state.size());
  double *density = row(h.end, 0), *modulus = row(h.end, 1);  // modulus holds the defect so far
  const double* iJ = row(h.common.inverse_J);
  double M[most_materials], V[most_materials], E[most_materials], before[most_materials];
  for (int i = 0; i < n; ++i) {
    double left_over = 0;
    for (int m = 0; m < materials; ++m) {
      const MaterialState& s = h.state[static_cast<std::size_t>(m)];
      M[m] = row(s.mass_new)[i];
      V[m] = row(s.volume_new)[i];
      E[m] = row(s.energy_new)[i];
      if (is_gone(M[m], V[m], row(s.mass)[i], row(s.volume)[i])) {
        left_over += E[m];
        M[m] = V[m] = E[m] = 0.0;
        row(s.mass_new)[i] = 0.0;
      }
    }
    const double share = (modulus[i] + left_over) / density[i];
    for (int m = 0; m < materials; ++m) E[m] += share * M[m];
    const std::uint64_t bubbles =
        collapse.possible() ? collapse.traces_of_gas({M, V, E}, density[i]) : 0;
    if (bubbles != 0) collapse.remember({M, V, E}, bubbles, before);
    Equilibration::Result result = equilibration.equilibrate({M, V, E});
    if (bubbles != 0 && result.failed < 0 &&
        collapse.settle({M, V, E}, bubbles, before, result.pressure))
      result = equilibration.equilibrate({M, V, E});
    if (heat.on() && result.failed < 0 && heat.exchange({M, V, E}, row.step().dt))
      result = equilibration.equilibrate({M, V, E});
    if (!(density[i] > 0.0 && density[i] < infinity)) {
      report(row, o.axes, i, fault_density, density[i]);
    } else if (!(iJ[i] > 0.0 && iJ[i] < infinity)) {
      report(row, o.axes, i, fault_volume, 1.0 / iJ[i]);
    } else if (result.failed >= 0) {
      report(row, o.axes, i, fault_of_material * (result.failed + 1), E[result.failed]);
    }
    modulus[i] = result.modulus;
    row(h.pressure)[i] = result.pressure;
    for (int m = 0; m < materials; ++m) {
      const MaterialState& s = h.state[static_cast<std::size_t>(m)];
      row(s.volume_new)[i] = V[m];
      row(s.energy_new)[i] = E[m];
    }
  }
}

Handles declare(TaskBuilder& task, const Variables& v, const SchemeOptions& o) {
  Handles h;
  h.common = read_update(task, v.common, o);
  h.common.energy_scale = task.read(v.common.energy_scale);
  h.lagrangian = task.read(v.common.lagrangian_mixture);
  h.energy_L = task.read(v.energy_L);
  h.pure = task.read(v.pure);
  for (int axis = 0; axis < o.axes.count; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    h.flux[a] = task.read(v.flux[a], Stencil::along(o.axes.direction[axis], 0, 1));
  }
  h.common.next.momentum = task.write(v.common.momentum_new);
  for (std::size_t m = 0; m < o.fluids.size(); ++m) {
    MaterialState s;
    s.mass = task.read(v.mass[m]);
    s.volume = task.read(v.volume[m]);
    s.mass_new = task.write(v.mass_new[m]);
    s.volume_new = task.write(v.volume_new[m]);
    s.energy_new = task.write(v.energy_new[m]);
    h.state.push_back(s);
  }
  h.end = task.write(v.end);
  h.pressure = task.write(v.common.new_pressure);
  h.closure = task.write(v.common.closure);
  h.common.next.rho = h.end;
  return h;
}

}  // namespace

void add_update(TaskList& list, const Variables& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("update", effect);
  const Handles h = declare(task, v, o);
  std::vector<SchemeOptions> of_material;
  for (const Fluid& fluid : o.fluids) {
    of_material.push_back(o);
    of_material.back().fluid = fluid;
  }
  dispatch(o.axes.count, o.components, [&]<int D, int C>() {
    task.kernel([=, equilibration = Equilibration(o.fluids), collapse = Collapse(o.fluids),
                 heat = HeatExchange(o.fluids, o.heat_exchange)](const Row& row) {
      for_each_run(row(h.pure), row.count(), [&](int first, int count, double pure) {
        const Row part = row.part(first, count);
        if (pure >= 0.0) {
          const auto m = static_cast<std::size_t>(pure);
          return pure_cells<D, C>(part, h, of_material[m], static_cast<int>(m));
        }
        remap_materials<D>(part, h);
        mixture_motion<D, C>(part, h, part(h.end, 0), part(h.end, 1));
        finish_cells(part, h, o, equilibration, collapse, heat);
      });
      rates_of_mixture<D>(row, h.common.next, o, row(h.end, 1));
    });
  });
}

}  // namespace sluice::ice::mixture
