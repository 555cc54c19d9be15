// Step 9 where solids are: one_material/update_rows.hpp on amounts of the cell. Cells that no solid
// meets are checked and rated here; of the others the new state is not known yet: what is stored is
// mass, momentum and TOTAL energy per volume of the cell,
//   E' + rho' |u'|^2/2 = E_L + gain - rho' |v|^2/2 + P' . v
// (v the frame of the update), which asks for no division by what may be next to nothing.
#include "ice/cut_cells/variables.hpp"
#include "ice/one_material/update_rows.hpp"
#include "ice/sources/source_tasks.hpp"

namespace sluice::ice::cut_cells {
namespace {

struct Handles {
  UpdateHandles amounts;
  In fraction, next, rho, momentum, energy, frame;
  Out fraction_new, rho_new, momentum_new, energy_new;
};

template <int D, int C>
void update_cells(const Row& row, const Handles& h) {
  const int n = row.count();
  const MotionRows<D, C> motion(row, h.amounts);
  const double *Gm[D], *Gp[D], *v[C];
  double* P[C];
  for (int d = 0; d < D; ++d) {
    const In flux = h.amounts.flux[d];
    Gm[d] = row(flux, 1);
    Gp[d] = row(flux, 1, d, 1);
  }
  for (int c = 0; c < C; ++c) {
    v[c] = row(h.frame, c);
    P[c] = row(h.amounts.next.momentum, c);
  }
  const double *M = row(h.amounts.rho), *Es = row(h.amounts.energy_star);
  const double *theta = row(h.fraction), *after = row(h.next);
  double* __restrict rn = row(h.amounts.next.rho);
  double* __restrict En = row(h.amounts.next.energy);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const bool solid = (theta[i] > 0) | (after[i] > 0);
    const double rho = M[i] + motion.mass(i), inverse = 1.0 / rho;
    rn[i] = rho;
    double total = Es[i] + motion.heat(i, solid ? 0.0 : rho, solid ? 0.0 : inverse,
                                       [&](int d) { return Gm[d][i] - Gp[d][i]; });
    for (int c = 0; c < C; ++c) {
      const double of_frame = (P[c][i] - 0.5 * rho * v[c][i]) * v[c][i];
      total += solid ? of_frame : 0.0;
    }
    En[i] = total;
  }
}

// The new state; the rows that are looked at get the old state where a solid is.
void store_row(const Row& row, const Handles& h, int components) {
  const int n = row.count();
  const double *theta = row(h.fraction), *after = row(h.next);
  double* __restrict to = row(h.fraction_new);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) to[i] = after[i];
  const auto store = [&](Out amount, Out state, In old, int c) {
    double* __restrict a = row(amount, c);
    double* __restrict s = row(state, c);
    const double* before = row(old, c);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double next = a[i];
      s[i] = next;
      const bool solid = (theta[i] > 0) | (after[i] > 0);
      a[i] = solid ? before[i] : next;
    }
  };
  store(h.amounts.next.rho, h.rho_new, h.rho, 0);
  for (int c = 0; c < components; ++c)
    store(h.amounts.next.momentum, h.momentum_new, h.momentum, c);
  store(h.amounts.next.energy, h.energy_new, h.energy, 0);
}

// As check_row: of cells without solids.
void check_cells(const Row& row, const Handles& h, const SchemeOptions& o) {
  const auto inverse = [](double x) { return 1.0 / x; };
  const int state = fault_of_material * (o.materials.index + 1);
  const double *rho = row(h.amounts.next.rho), *energy = row(h.amounts.next.energy);
  if (o.materials.fluid.gamma_law() == nullptr) {
    double* good = row(h.amounts.next.closure, 2);
    admissible_row(o.materials.fluid, row.count(), rho, energy, good);
    return admissible_row<3>(row, o.grid.axes,
                             {{{rho, fault_density},
                               {row(h.amounts.inverse_J), fault_volume, inverse},
                               {good, state, nullptr, energy}}},
                             o.materials.index);
  }
  admissible_row<3>(
      row, o.grid.axes,
      {{{rho, fault_density}, {row(h.amounts.inverse_J), fault_volume, inverse}, {energy, state}}},
      o.materials.index);
}

}  // namespace

void add_update(TaskList& list, const UpdateInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("update with solids", effect);
  Handles h;
  h.amounts = declare_update(task, v.amounts, o);
  h.frame = task.read(v.velocity_L);
  h.fraction = task.read(v.fraction);
  h.next = task.read(v.next);
  h.rho = task.read(v.rho);
  h.momentum = task.read(v.momentum);
  h.energy = task.read(v.energy);
  h.fraction_new = task.write(v.fraction_new);
  h.rho_new = task.write(v.rho_new);
  h.momentum_new = task.write(v.momentum_new);
  h.energy_new = task.write(v.energy_new);
  const int components = o.grid.components;
  const SourceHandles sources = declare_sources(task, v.amounts.source_change, o);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      update_cells<D, C>(row, h);
      const RateHandles& amounts = h.amounts.next;
      add_sources_of_one(row, sources, o, amounts.rho, amounts.momentum, amounts.energy);
      store_row(row, h, components);
      check_cells(row, h, o);
      rates_of_row<D>(row, h.amounts.next, o);
    });
  });
}

}  // namespace sluice::ice::cut_cells
