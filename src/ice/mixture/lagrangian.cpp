// Step 6 with several materials: how they share what the Lagrangian phase of the mixture did.
//
//   V_m -> V_m J (uniform strain),   E_mL = E_m - V_m p (J - 1) - R M_m/rho + Q_m,
//   R = W - p (J - 1)
// W is the work defect of the mixture: p dV goes by volume, the rest (dissipation, second order) by
// mass. Q_m is what friction and conduction bring (transport.cpp). Per own volume:
// rho_mL = rho_m/J, eps_mL = E_mL/(V_m J), and the scale (p_m + pi_m)/G_m of each, from the
// pressure of that state. With a pressure solve the materials of a cell then find one pressure:
// V_m -> V_m J r_m, with the works of that. The scale of the mixture is sum V_m scale_m.
#include <algorithm>
#include <bit>
#include <optional>

#include "ice/closure/cell_closure.hpp"
#include "ice/fluid/closure_rows.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/mixture/tasks.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/step/end_of_step.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

struct Handles {
  StateReads state;
  In pure, near, presence, pressure, inverse_rho, inverse_J, work, heat;
  In mixture_energy, mixture_density_L, mixture_energy_L, mixture_energy_star;
  std::array<In, 3> face_velocity;
  Out stretch, energy_L, specific_energy_L, scale, mixture_scale;
  Out strain;   // where the materials of a cell relax before the remap
  Out scratch;  // density of a material, work
};

struct Materials {
  std::vector<Fluid> fluids;
  bool all_ideal;  // the scale of each is its energy
  bool heated;
  bool keeps_work;
  std::optional<CellClosure> relaxation;
};

// J and the main outlet.
template <int D>
void stretch_cells(const Row& row, const Handles& h, const Axes& axes) {
  const int n = row.count();
  const double *um[D], *up[D];
  double l[D];
  for (int d = 0; d < D; ++d) {
    const In face_velocity = h.face_velocity[d];
    um[d] = row(face_velocity);
    up[d] = row(face_velocity, 0, d, 1);
    l[d] = row.step().dt / row.step().spacing[axes.direction[d]];
  }
  double* __restrict J = row(h.stretch, 0);
  double* __restrict outlet = row(h.stretch, 1);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    double stretch = 0, count = 0, largest = 0;
    for (int d = 0; d < D; ++d) {
      stretch += l[d] * (up[d][i] - um[d][i]);
      const double high = l[d] * up[d][i], low = -(l[d] * um[d][i]);
      count += (high > 0.0 ? 1.0 : 0.0) + (low > 0.0 ? 1.0 : 0.0);
      largest = larger(largest, larger(high, low));
    }
    double ties = 0;
    for (int d = 0; d < D; ++d)
      ties +=
          (l[d] * up[d][i] == largest ? 1.0 : 0.0) + (-(l[d] * um[d][i]) == largest ? 1.0 : 0.0);
    J[i] = 1.0 + stretch;
    const double several = ties > 1.0 ? -infinity : -largest;
    outlet[i] = count > 1.0 ? several : largest;
  }
}

// W, which is the difference of two energies where nothing else keeps it.
const double* work_of(const Row& row, const Handles& h, bool kept) {
  if (kept) return row(h.work);
  const double* __restrict before = row(h.mixture_energy);
  const double* __restrict after = row(h.mixture_energy_star);
  double* __restrict work = row(h.scratch, 1);
#pragma GCC ivdep
  for (int i = 0; i < row.count(); ++i) work[i] = before[i] - after[i];
  return work;
}

// Energy of a material that is in some of these cells. In those of pure neighbourhood the mixture's
// is the material's.
template <bool Heated>
void share_energy(const Row& row, const Handles& h, int m, const double* __restrict W) {
  const int n = row.count();
  const double* __restrict pure = row(h.pure);
  const double* __restrict p = row(h.pressure);
  const double* __restrict w = row(h.inverse_rho);
  const double* __restrict iJ = row(h.inverse_J);
  const double* __restrict J = row(h.stretch, 0);
  const double* __restrict E_star = row(h.mixture_energy_star);
  const double* __restrict E_of_mixture = row(h.mixture_energy_L);
  const double* __restrict M = row(h.state.mass[m]);
  const double* __restrict V = row(h.state.volume[m]);
  const double* __restrict E = row(h.state.energy[m]);
  const double* __restrict Q = Heated ? row(h.heat, m) : E;
  double* __restrict E_L = row(h.energy_L, m);
  double* __restrict eps = row(h.specific_energy_L, m);
  const double which = m;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double pdV = p[i] * (J[i] - 1.0);
    double energy = E[i] - (V[i] * pdV + (W[i] - pdV) * (M[i] * w[i]));
    if constexpr (Heated) energy += Q[i];
    const bool mixed = pure[i] < 0.0, alone = pure[i] == which, absent = V[i] == 0.0;
    const double E_own = absent ? 0.0 : energy, per_volume = E_own * iJ[i] / V[i];
    const double E_alone = alone ? E_star[i] : 0.0, eps_alone = alone ? E_of_mixture[i] : 0.0;
    const double eps_own = absent ? 0.0 : per_volume;
    E_L[i] = mixed ? E_own : E_alone;
    eps[i] = mixed ? eps_own : eps_alone;
  }
}

// The scale of a material, zero where it is absent.
void find_scale(const Row& row, const Handles& h, int m, const Fluid& fluid) {
  const int n = row.count();
  double* __restrict scale = row(h.scale, m);
  const double* __restrict eps = row(h.specific_energy_L, m);
  if (fluid.gamma_law() != nullptr) {
    for (int i = 0; i < n; ++i) scale[i] = eps[i];
    return;
  }
  const double* __restrict M = row(h.state.mass[m]);
  const double* __restrict V = row(h.state.volume[m]);
  const double* __restrict iJ = h.strain.index < 0
                                    ? row(h.inverse_J)
                                    : row(h.strain, static_cast<int>(h.state.mass.size()) + m);
  double* __restrict rho_L = row(h.scratch);
  for (int i = 0; i < n; ++i) rho_L[i] = M[i] * per_own_volume(V[i]) * iJ[i];
  for_each_run(runs_of(row, h.presence), n, [&](int first, int count, double presence) {
    if ((as_set(presence) >> m & 1) != 0)
      energy_scale_row(fluid, count, rho_L + first, eps + first, scale + first);
    else
      std::fill_n(scale + first, count, 0.0);
  });
}

// The materials of a cell find one pressure in the volume J: r_m and 1/(J r_m), energies likewise.
// A cell without a state stays as it is: the end of the step tells.
void relax_cells(const Row& row, const Handles& h, const CellClosure& closure) {
  const int n = row.count(), materials = static_cast<int>(h.state.mass.size());
  const double *J = row(h.stretch, 0), *iJ = row(h.inverse_J), *presence = row(h.presence);
  for (int m = 0; m < materials; ++m) {
    std::fill_n(row(h.strain, m), n, 1.0);
    std::copy_n(iJ, n, row(h.strain, materials + m));
  }
  for (int i = 0; i < n; ++i) {
    const std::uint64_t set = as_set(presence[i]);
    if (std::popcount(set) < 2 || !(J[i] > 0.0 && J[i] < infinity)) continue;
    double M[max_materials], V[max_materials], E[max_materials], density = 0;
    for (int m = 0; m < materials; ++m) {
      M[m] = row(h.state.mass[m])[i] * iJ[i];
      V[m] = row(h.state.volume[m])[i];
      E[m] = row(h.energy_L, m)[i] * iJ[i];
      density += M[m];
    }
    if (closure.close({M, V, E}, density, 0.0, {}).failed >= 0) continue;
    for (int m = 0; m < materials; ++m) {
      if ((set >> m & 1) == 0) continue;
      const double r = V[m] / row(h.state.volume[m])[i];
      row(h.strain, m)[i] = r;
      row(h.strain, materials + m)[i] = iJ[i] / r;
      row(h.energy_L, m)[i] = E[m] * J[i];
      row(h.specific_energy_L, m)[i] = E[m] / V[m];
    }
  }
}

// `set`: of the materials in these cells.
void share_cells(const Row& row, const Handles& h, std::uint64_t set, const Materials& materials) {
  const int n = row.count();
  double* __restrict total = row(h.mixture_scale);
  std::fill_n(total, n, 0.0);
  const double* W = work_of(row, h, materials.keeps_work);
  for (int m = 0; m < static_cast<int>(materials.fluids.size()); ++m) {
    if ((set >> m & 1) == 0) {
      std::fill_n(row(h.energy_L, m), n, 0.0);
      std::fill_n(row(h.specific_energy_L, m), n, 0.0);
      if (!materials.all_ideal) std::fill_n(row(h.scale, m), n, 0.0);
      continue;
    }
    materials.heated ? share_energy<true>(row, h, m, W) : share_energy<false>(row, h, m, W);
  }
  if (materials.relaxation) relax_cells(row, h, *materials.relaxation);
  for (int m = 0; m < static_cast<int>(materials.fluids.size()); ++m) {
    if ((set >> m & 1) == 0) continue;
    if (!materials.all_ideal) find_scale(row, h, m, materials.fluids[m]);
    const double* __restrict V = row(h.state.volume[m]);
    const double* __restrict scale = row(materials.all_ideal ? h.specific_energy_L : h.scale, m);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) total[i] += V[i] * scale[i];
  }
}

// Where one material is alone all around, its scale is the mixture's. That of an ideal gas is asked
// for near other materials only.
void alone(const Row& row, const Handles& h, const Fluid& fluid) {
  if (fluid.gamma_law() != nullptr) return;
  energy_scale_row(fluid, row.count(), row(h.mixture_density_L), row(h.mixture_energy_L),
                   row(h.mixture_scale));
}

}  // namespace

void add_material_lagrangian(TaskList& list, const MaterialLagrangianInput& v,
                             const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("Lagrangian phase of each material", effect);
  Handles h;
  h.state = read_state(task, v.state);
  h.presence = task.read(v.presence);
  h.pure = task.read(v.pure);
  h.near = task.read(v.near);
  h.mixture_density_L = task.read(v.mixture.rho_L);
  h.mixture_energy_L = task.read(v.mixture.energy_L);
  h.mixture_energy_star = task.read(v.mixture.energy_star);
  h.pressure = task.read(v.mixture.pressure);
  h.inverse_rho = task.read(v.mixture.inverse_rho);
  h.inverse_J = task.read(v.mixture.inverse_J);
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    h.face_velocity[axis] =
        task.read(v.mixture.face_velocity[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  }
  h.mixture_energy = task.read(v.mixture.energy);
  if (o.keeps_work()) h.work = task.read(o.materials.multi_velocity ? v.work : v.mixture.work);
  h.stretch = task.write(v.stretch);
  const bool heated = o.transport.viscous || o.transport.conducting;
  if (heated) h.heat = task.read(v.heat);
  h.energy_L = task.write(v.energy_L);
  h.specific_energy_L = task.write(v.specific_energy_L);
  Materials materials{
      o.materials.fluids, all_ideal_gases(o.materials.fluids), heated, o.keeps_work(), {}};
  if (relaxes_before_remap(o)) {
    h.strain = task.write(v.strain);
    materials.relaxation.emplace(o.materials.fluids,
                                 PairCoefficients(static_cast<int>(o.materials.fluids.size())),
                                 std::nullopt);
  }
  if (!materials.all_ideal) h.scale = task.write(v.energy_scale);
  h.mixture_scale = task.write(v.mixture.energy_scale);
  h.scratch = task.write(list.temporary("Lagrangian density, work", 2));
  const auto stretch = o.grid.axes.count == 1   ? stretch_cells<1>
                       : o.grid.axes.count == 2 ? stretch_cells<2>
                                                : stretch_cells<3>;
  task.kernel([=, axes = o.grid.axes](const Row& row) {
    for_each_run(runs_of(row, h.pure), row.count(), [&](int first, int count, double pure) {
      if (pure >= 0.0)
        alone(row.part(first, count), h, materials.fluids[static_cast<std::size_t>(pure)]);
    });
    for_each_run(runs_of(row, h.near), row.count(), [&](int first, int count, double near) {
      if (near == 0.0) return;
      // Nobody reads what is computed for cells further away; laws may search for a root there.
      const Row part =
          row.part(first, materials.all_ideal ? whole_vectors(count, row.count() - first) : count);
      std::uint64_t set = 0;
      for_each_run(runs_of(part, h.presence), part.count(),
                   [&](int, int, double presence) { set |= as_set(presence); });
      stretch(part, h, axes);
      share_cells(part, h, set, materials);
    });
  });
}

}  // namespace sluice::ice::mixture
