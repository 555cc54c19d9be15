// Step 6 with several materials: how they share what the Lagrangian phase of the mixture did.
//
//   V_m -> V_m J (uniform strain),   E_mL = E_m - V_m p (J - 1) - R M_m/rho + Q_m,
//   R = W - p (J - 1)
// W is the work defect of the mixture: p dV goes by volume, the rest (dissipation, second order) by
// mass. Q_m is what friction and conduction bring (transport.cpp). Per own volume:
// rho_mL = rho_m/J, eps_mL = E_mL/(V_m J), and the scale (p_m + pi_m)/G_m of each, from the
// pressure of that state. The scale of the mixture is sum V_m scale_m.
#include <algorithm>

#include "ice/closure_rows.hpp"
#include "ice/mixture/runs.hpp"
#include "ice/mixture/variables.hpp"

namespace sluice::ice::mixture {
namespace {

struct Handles {
  StateReads state;
  In pure, near, presence, pressure, inverse_rho, inverse_J, lagrangian, work, density, heat;
  In mixture_density_L, mixture_energy_L, mixture_energy_star;
  int work_component = 1;
  Out energy_L, specific_energy_L, scale, mixture_scale, scratch;
};

// The scale of a material, zero where it is absent.
void find_scale(const Row& row, const Handles& h, int m, const Fluid& fluid) {
  double* scale = row(h.scale, m);
  if (fluid.ideal() != nullptr) {
    std::copy_n(row(h.specific_energy_L, m), row.count(), scale);
    return;
  }
  for_each_run(runs_of(row, h.presence), row.count(), [&](int first, int count, double presence) {
    if ((as_set(presence) >> m & 1) != 0)
      energy_scale_row(fluid, count, row(h.scratch) + first, row(h.specific_energy_L, m) + first,
                       scale + first);
    else
      std::fill_n(scale + first, count, 0.0);
  });
}

// `set`: of the materials in these cells. In those of pure neighbourhood the mixture's values are
// the material's.
void share_cells(const Row& row, const Handles& h, std::uint64_t set,
                 const std::vector<Fluid>& fluids, bool heated) {
  const int n = row.count();
  const double* __restrict pure = row(h.pure);
  const double* __restrict p = row(h.pressure);
  const double* __restrict w = row(h.inverse_rho);
  const double* __restrict iJ = row(h.inverse_J);
  const double* __restrict J = row(h.lagrangian, 0);
  const double* __restrict W = row(h.work, h.work_component);
  const double* __restrict E_star = row(h.mixture_energy_star);
  const double* __restrict E_of_mixture = row(h.mixture_energy_L);
  double* __restrict of_mixture = row(h.mixture_scale);
  double* __restrict rho_L = row(h.scratch, 0);
  double* __restrict total = row(h.scratch, 1);
  std::fill_n(total, n, 0.0);
  for (int m = 0; m < static_cast<int>(fluids.size()); ++m) {
    double* __restrict E_L = row(h.energy_L, m);
    double* __restrict eps = row(h.specific_energy_L, m);
    double* __restrict scale = row(h.scale, m);
    if ((set >> m & 1) == 0) {
      for (int i = 0; i < n; ++i) E_L[i] = eps[i] = scale[i] = 0.0;
      continue;
    }
    const auto k = static_cast<std::size_t>(m);
    const double* __restrict M = row(h.state.mass[k]);
    const double* __restrict V = row(h.state.volume[k]);
    const double* __restrict E = row(h.state.energy[k]);
    const double* __restrict r = row(h.density, m);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double pdV = p[i] * (J[i] - 1.0);
      E_L[i] = E[i] - (V[i] * pdV + (W[i] - pdV) * (M[i] * w[i]));
    }
    if (heated) {
      const double* __restrict Q = row(h.heat, m);
      for (int i = 0; i < n; ++i) E_L[i] += Q[i];
    }
    const double which = m;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const bool mixed = pure[i] < 0.0, alone = pure[i] == which, absent = V[i] == 0.0;
      const double E_own = absent ? 0.0 : E_L[i], per_volume = E_own * iJ[i] / V[i];
      const double E_alone = alone ? E_star[i] : 0.0, eps_alone = alone ? E_of_mixture[i] : 0.0;
      const double eps_own = absent ? 0.0 : per_volume;
      E_L[i] = mixed ? E_own : E_alone;
      eps[i] = mixed ? eps_own : eps_alone;
      rho_L[i] = r[i] * iJ[i];
    }
    find_scale(row, h, m, fluids[k]);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) total[i] += V[i] * scale[i];
  }
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) of_mixture[i] = pure[i] < 0.0 ? total[i] : of_mixture[i];
}

// Where one material is alone all around, its scale is the mixture's; an ideal gas has its energy.
void alone(const Row& row, const Handles& h, const Fluid& fluid) {
  const int n = row.count();
  const double* E = row(h.mixture_energy_L);
  double* scale = row(h.mixture_scale);
  if (fluid.ideal() != nullptr)
    std::copy(E, E + n, scale);
  else
    energy_scale_row(fluid, n, row(h.mixture_density_L), E, scale);
}

}  // namespace

void add_lagrangian(TaskList& list, const Variables& v, const SchemeOptions& o, int effect) {
  ice::add_lagrangian(list, v.common, o, effect);
  TaskBuilder task = list.task("Lagrangian phase of each material", effect);
  Handles h;
  h.state = read_state(task, v);
  h.presence = task.read(v.presence);
  h.pure = task.read(v.pure);
  h.near = task.read(v.near);
  h.mixture_density_L = task.read(v.common.rho_L);
  h.mixture_energy_L = task.read(v.common.energy_L);
  h.mixture_energy_star = task.read(v.common.energy_star);
  h.pressure = task.read(v.common.pressure);
  h.inverse_rho = task.read(v.common.inverse_rho);
  h.inverse_J = task.read(v.common.inverse_J);
  h.lagrangian = task.read(v.common.lagrangian_mixture);
  h.work = o.own_velocities ? task.read(v.slip.work) : h.lagrangian;
  h.work_component = o.own_velocities ? 0 : 1;
  h.density = task.read(v.density);
  const bool heated = o.viscous || o.conducting;
  if (heated) h.heat = task.read(v.heat);
  h.energy_L = task.write(v.energy_L);
  h.specific_energy_L = task.write(v.specific_energy_L);
  h.scale = task.write(v.energy_scale);
  h.mixture_scale = task.write(v.common.energy_scale);
  h.scratch = task.write(list.temporary("Lagrangian density of a material, sum of scales", 2));
  const std::vector<Fluid> fluids = o.fluids;
  const bool gases = std::all_of(fluids.begin(), fluids.end(),
                                 [](const Fluid& fluid) { return fluid.ideal() != nullptr; });
  task.kernel([=](const Row& row) {
    for_each_run(runs_of(row, h.pure), row.count(), [&](int first, int count, double pure) {
      if (pure >= 0.0) alone(row.part(first, count), h, fluids[static_cast<std::size_t>(pure)]);
    });
    for_each_run(runs_of(row, h.near), row.count(), [&](int first, int count, double near) {
      if (near == 0.0) return;
      // Nobody reads what is computed for cells further away; laws may search for a root there.
      const Row part = row.part(first, gases ? whole_vectors(count, row.count() - first) : count);
      std::uint64_t set = 0;
      for_each_run(runs_of(part, h.presence), part.count(),
                   [&](int, int, double presence) { set |= as_set(presence); });
      share_cells(part, h, set, fluids, heated);
    });
  });
}

}  // namespace sluice::ice::mixture
