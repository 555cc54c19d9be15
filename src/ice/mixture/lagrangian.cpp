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
  In pure, presence, pressure, inverse_rho, inverse_J, lagrangian, work, density, heat;
  In mixture_density_L, mixture_energy_L;
  int work_component = 1;
  Out energy_L, specific_energy_L, scale, mixture_scale, scratch;
};

void share_cells(const Row& row, const Handles& h, std::uint64_t set,
                 const std::vector<Fluid>& fluids, bool heated) {
  const int n = row.count();
  const double* __restrict p = row(h.pressure);
  const double* __restrict w = row(h.inverse_rho);
  const double* __restrict iJ = row(h.inverse_J);
  const double* __restrict J = row(h.lagrangian, 0);
  const double* __restrict W = row(h.work, h.work_component);
  double* __restrict total = row(h.mixture_scale);
  double* __restrict rho_L = row(h.scratch);
  for (int i = 0; i < n; ++i) total[i] = 0.0;
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
    for (int i = 0; i < n; ++i) {
      eps[i] = E_L[i] * iJ[i] / V[i];
      rho_L[i] = r[i] * iJ[i];
    }
    if (fluids[k].ideal() != nullptr)
      std::copy_n(eps, n, scale);
    else
      energy_scale_row(fluids[k], n, rho_L, eps, scale);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) total[i] += V[i] * scale[i];
  }
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
  h.mixture_density_L = task.read(v.common.rho_L);
  h.mixture_energy_L = task.read(v.common.energy_L);
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
  h.scratch = task.write(list.temporary("Lagrangian density of a material"));
  const std::vector<Fluid> fluids = o.fluids;
  task.kernel([=](const Row& row) {
    for_each_run(row(h.pure), row.count(), [&](int first, int count, double pure) {
      const Row part = row.part(first, count);
      if (pure >= 0.0) return alone(part, h, fluids[static_cast<std::size_t>(pure)]);
      for_each_run(part(h.presence), count, [&](int begin, int some, double presence) {
        share_cells(part.part(begin, some), h, as_set(presence), fluids, heated);
      });
    });
  });
}

}  // namespace sluice::ice::mixture
