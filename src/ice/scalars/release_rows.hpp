// What the tasks that end a step with released heat have in common: the state after the remap is
// copied, other sources act, heat is added by the caller, the new state is checked.
#pragma once
#include "ice/one_material/update_rows.hpp"
#include "ice/sources/source_tasks.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice::scalars {

struct ReleaseHandles {
  UpdateHandles end;  // end.next: the new state
  SourceHandles sources;
  In rho, momentum, energy;  // after the remap
};

struct ReleaseInput {
  EndOfStepInput end;
  VariableId rho_remap, momentum_remap, energy_remap;
  VariableId rho_new, momentum_new, energy_new, source_change;  // written

  static ReleaseInput of(const SchemeVariables& v) {
    return {.end = EndOfStepInput::of(v),
            .rho_remap = v.rho_remap,
            .momentum_remap = v.momentum_remap,
            .energy_remap = v.energy_remap,
            .rho_new = v.rho_new,
            .momentum_new = v.momentum_new,
            .energy_new = v.energy_new,
            .source_change = v.source_change};
  }
};

inline ReleaseHandles declare_heat_release(TaskBuilder& task, const ReleaseInput& v,
                                           const SchemeOptions& o) {
  ReleaseHandles h;
  h.end = read_end_of_step(task, v.end, o);
  h.end.next.rho = task.write(v.rho_new);
  h.end.next.momentum = task.write(v.momentum_new);
  h.end.next.energy = task.write(v.energy_new);
  h.sources = declare_sources(task, v.source_change, o);
  h.rho = task.read(v.rho_remap);
  h.momentum = task.read(v.momentum_remap);
  h.energy = task.read(v.energy_remap);
  return h;
}

// The new state but for the heat.
inline void begin_heat_release(const Row& row, const ReleaseHandles& h, const SchemeOptions& o) {
  const auto copy = [n = row.count()](const double* from, double* to) {
    for (int i = 0; i < n; ++i) to[i] = from[i];
  };
  copy(row(h.rho), row(h.end.next.rho));
  copy(row(h.energy), row(h.end.next.energy));
  for (int c = 0; c < o.grid.components; ++c) copy(row(h.momentum, c), row(h.end.next.momentum, c));
  add_sources_of_one(row, h.sources, o, h.end.next.rho, h.end.next.momentum, h.end.next.energy);
}

// Where heat is recorded: of the gas, and of all; per volume of the cell, J/m^3.
struct HeatBudget {
  double *of_gas, *of_all;

  HeatBudget(const Row& row, const ReleaseHandles& h, const SchemeOptions& o)
      : of_gas(row(h.sources.change, source_change(o).of(0, SourceChange::energy))),
        of_all(row(h.sources.change, source_change(o).of(SourceChange::total_energy))) {}
  void add(int i, double heat) const {
    of_gas[i] += heat;
    of_all[i] += heat;
  }
};

template <int D>
void end_heat_release(const Row& row, const ReleaseHandles& h, const SchemeOptions& o) {
  check_row(row, h.end, o, o.materials.index);
  rates_of_row<D>(row, h.end.next, o);
}

}  // namespace sluice::ice::scalars
