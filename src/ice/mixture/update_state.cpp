// Declaring the update of a mixture, and the rows that both kinds of it run.
#include "ice/mixture/update_state.hpp"
#include "ice/step/material_runs.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace sluice::ice::mixture {

namespace {

// Mostly it is there already but for a few cells beside an interface, and to look takes half the
// time of writing.
void fill_where_different(double* to, int n, double value) {
  constexpr int some = 32;
  const auto wanted = std::bit_cast<std::uint64_t>(value);
  int done = 0;
  for (; done + some <= n; done += some) {
    std::uint64_t others = 0;
    for (int i = done; i < done + some; ++i) others |= std::bit_cast<std::uint64_t>(to[i]) ^ wanted;
    if (others != 0) std::fill_n(to + done, some, value);
  }
  std::fill_n(to + done, n - done, value);
}

}  // namespace

void declare_update(TaskBuilder& task, const UpdateInput& v, const SchemeOptions& o,
                    UpdateState& h) {
  h.closes = o.materials.mixed == nullptr;
  h.common = read_update(task, v.amounts, o);
  h.common.energy_scale = task.read(v.mixture_energy_scale);
  h.stretch = task.read(v.stretch);
  if (relaxes_before_remap(o)) h.strain = task.read(v.strain);
  h.energy_L = task.read(v.energy_L);
  h.pure = task.read(v.pure);
  if (o.materials.multi_velocity_exchange) h.surface = task.read(v.surface);
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    h.flux[axis] = task.read(v.flux[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  }
  h.common.next.momentum = task.write(v.next.momentum);
  for (std::size_t m = 0; m < o.materials.fluids.size(); ++m) {
    MaterialState s;
    s.mass = task.read(v.state.mass[m]);
    s.volume = task.read(v.state.volume[m]);
    s.mass_new = task.write(v.next.of_each.mass[m]);
    s.volume_new = task.write(v.next.of_each.volume[m]);
    s.energy_new = task.write(v.next.of_each.energy[m]);
    h.state.push_back(s);
  }
  if (o.materials.multi_velocity)
    for (const VariableId id : v.next.slip) h.slip_new.push_back(task.write(id));
  h.sources = declare_sources(task, v.next.source_change, o);
  h.end = task.write(v.next.end);
  h.common.next.rho = h.end;
  if (!h.closes) return;
  h.pressure = task.write(v.next.pressure);
  h.closure = task.write(v.next.closure);
}

std::vector<SchemeOptions> options_of_materials(const SchemeOptions& o) {
  std::vector<SchemeOptions> of_material;
  for (const Fluid& fluid : o.materials.fluids) {
    of_material.push_back(o);
    of_material.back().materials.fluid = fluid;
  }
  return of_material;
}

UpdateHandles handles_of(const UpdateState& h, int m) {
  UpdateHandles u = h.common;
  const MaterialState& s = h.state[m];
  u.next.rho = s.mass_new;
  u.next.energy = s.energy_new;
  u.next.closure = h.closure;
  return u;
}

void leave_alone(const Row& row, const UpdateState& h, int m, int components) {
  const auto fill = [&](Out variable, int c, int first, int count, double value) {
    fill_where_different(row(variable, c) + first, count, value);
  };
  for_each_marked(row, h.closes ? row.new_marks() : nullptr, [&](int first, int count, int alone) {
    if (alone == m) return;
    for (int other = 0; other < static_cast<int>(h.state.size()); ++other) {
      const MaterialState& s = h.state[other];
      fill(s.volume_new, 0, first, count, other == m ? 1.0 : 0.0);
      if (other == m) continue;
      fill(s.mass_new, 0, first, count, 0.0);
      fill(s.energy_new, 0, first, count, 0.0);
    }
    for (const Out slip : h.slip_new)
      for (int c = 0; c < components; ++c) fill(slip, c, first, count, 0.0);
  });
}

void end_alone(const Row& row, const UpdateState& h, const UpdateHandles& u, const Fluid& fluid) {
  const int n = row.count();
  const double *rho = row(u.next.rho), *E = row(u.next.energy);
  double *p = row(h.pressure), *K = row(h.end, 1);
  std::copy(rho, rho + n, row(h.end, 0));
  const eos::IdealGas* gas = fluid.gamma_law();
  if (gas == nullptr) return pressure_and_modulus_row(fluid, n, rho, E, p, K);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    p[i] = gas->pressure(rho[i], E[i]);
    K[i] = gas->gamma * p[i];
  }
}

void add_sources(const Row& row, const UpdateState& h, const SchemeOptions& o, Motion motion) {
  SourceRows rows;
  rows.row = &row;
  rows.change = h.sources.change;
  rows.layout = source_change(o);
  for (std::size_t m = 0; m < h.state.size(); ++m) {
    rows.mass[m] = row(h.state[m].mass_new);
    rows.volume[m] = row(h.state[m].volume_new);
    rows.energy[m] = row(h.state[m].energy_new);
  }
  for (int c = 0; c < o.grid.components; ++c) rows.momentum[c] = row(h.common.next.momentum, c);
  for (std::size_t m = 0; motion == Motion::apart && m < h.slip_new.size(); ++m)
    for (int c = 0; c < o.grid.components; ++c) rows.slip[m][c] = row(h.slip_new[m], c);
  o.forces.sources->apply(rows);
  double* density = row(h.end, 0);
  std::fill_n(density, row.count(), 0.0);
  for (const MaterialState& s : h.state) {
    const double* M = row(s.mass_new);
    for (int i = 0; i < row.count(); ++i) density[i] += M[i];
  }
}

void tell_faults(const Row& row, const Axes& axes, int i, double rho, double inverse_J,
                 const Equilibration::Result& closed, const double* E) {
  CellFault f;
  if (!(rho > 0.0 && rho < infinity)) {
    f.kind = fault_density;
    f.value = rho;
  } else if (!(inverse_J > 0.0 && inverse_J < infinity)) {
    f.kind = fault_volume;
    f.value = 1.0 / inverse_J;
  } else if (closed.failed >= 0) {
    f.kind = fault_of_material * (closed.failed + 1);
    f.material = closed.failed;
    f.value = E[closed.failed];
  } else {
    return;
  }
  f.cell = row.cell();
  f.cell[axes.direction[0]] += i;
  f.level = row.step().level;
  row.reductions().fault(f);
}

ClosingCells::ClosingCells(const Row& row, const UpdateState& h, const SchemeOptions& o)
    : row_(row),
      h_(h),
      o_(o),
      materials_(static_cast<int>(h.state.size())),
      inverse_J_(row(h.common.inverse_J)),
      density_(row(h.end, 0)),
      pressure_(row(h.pressure)),
      modulus_(row(h.end, 1)) {
  for (int m = 0; m < materials_; ++m) {
    const MaterialState& s = h.state[m];
    mass_[m] = row(s.mass_new);
    volume_[m] = row(s.volume_new);
    energy_[m] = row(s.energy_new);
  }
}

void ClosingCells::close(int i, const CellClosure& closure) const {
  double M[max_materials], V[max_materials], E[max_materials];
  for (int m = 0; m < materials_; ++m) {
    M[m] = mass_[m][i];
    V[m] = volume_[m][i];
    E[m] = energy_[m][i];
  }
  const Equilibration::Result result =
      closure.close({M, V, E}, density_[i], row_.step().dt, surface_of(row_, h_, o_, i));
  tell_faults(row_, o_.grid.axes, i, density_[i], inverse_J_[i], result, E);
  modulus_[i] = result.modulus;
  pressure_[i] = result.pressure;
  for (int m = 0; m < materials_; ++m) {
    volume_[m][i] = V[m];
    energy_[m][i] = E[m];
  }
}

void diffusion_rates_of_row(const Row& row, const UpdateState& h, const DiffusionRates& diffusion) {
  if (!row.step().rates) return;
  MaterialRows state;
  for (std::size_t m = 0; m < h.state.size(); ++m) {
    state.mass[m] = row(h.state[m].mass_new);
    state.volume[m] = row(h.state[m].volume_new);
    state.energy[m] = row(h.state[m].energy_new);
    if (diffusion.conductivity_varies())
      state.conductivity[m] = row(h.common.next.conductivity, static_cast<int>(m));
  }
  if (diffusion.viscosity_varies()) state.viscosity = row(h.common.next.viscosity);
  const double most = diffusion.largest(state, row.count(), row.step().spacing);
  row.reductions().maximum(StepSlots::diffusion_rate, ordered_bits(most));
}

}  // namespace sluice::ice::mixture
