// Keys of cells by the materials in and around them; values of materials that share many cells.
#include "ice/mixture/presence.hpp"

#include <bit>

#include "ice/step/laws_of_cells.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

void add_sets(TaskList& list, const PresenceInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("presence of materials", effect);
  const auto [mass, volume, energy] = read_state(task, v.state);
  const Out presence = task.write(v.presence);
  const int last_axis = o.grid.axes.count - 1;
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
void add_neighbourhood(TaskList& list, const PresenceInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("pure neighbourhoods", effect);
  const In presence = task.read(v.presence, Stencil::box(1));
  const Out pure = task.write(v.pure);
  const int axes = o.grid.axes.count;
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
void add_near(TaskList& list, const PresenceInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("cells near several materials", effect);
  std::array<In, 3> pure;
  for (int axis = 0; axis < o.grid.axes.count; ++axis)
    pure[axis] = task.read(v.pure, Stencil::along(o.grid.axes.direction[axis], 1, 1));
  const Out near = task.write(v.near);
  const int axes = o.grid.axes.count;
  task.kernel([=](const Row& row) {
    RunRow around[2 * 3 + 1];
    int rows = 0;
    around[rows++] = runs_of(row, pure[0]);
    for (int axis = 0; axis < axes; ++axis)
      for (const int shift : {-1, 1}) around[rows++] = runs_of(row, pure[axis], axis, shift);
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
void add_blends(TaskList& list, const PresenceInput& v, int effect) {
  constexpr int fewest = 16;
  TaskBuilder task = list.task("blends of materials", effect);
  const In presence = task.read(v.presence);
  const StateReads state = read_state(task, v.state);
  const Out blend = task.write(v.blend);
  const Out density = task.write(v.blend_density), energy = task.write(v.blend_energy);
  task.kernel([=](const Row& row) {
    RunWriter runs(row(blend), row(blend, 1));
    for_each_run(runs_of(row, presence), row.count(), [&](int first, int count, double key) {
      const Row part = row.part(first, count);
      bool fair = count >= fewest && !is_single(key);
      for (std::uint64_t left = fair ? as_set(key) : 0; left != 0 && fair; left &= left - 1) {
        const int m = std::countr_zero(left);
        fair = values_in_blend(count, part(state.mass[m]), part(state.volume[m]),
                               part(state.energy[m]), part(density, m), part(energy, m));
      }
      runs.add(count, fair ? key : 0.0);
    });
    runs.close();
  });
}

// 1 where the fraction of a mixed gas is that of all cells around which hold the gas.
void add_alike(TaskList& list, const PresenceInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("the same fraction around", effect);
  const In fraction = task.read(old_fraction(list, o), Stencil::box(1));
  const In mass = task.read(v.state.mass[o.materials.mixed->material], Stencil::box(1));
  const Out alike = task.write(v.alike);
  task.kernel([=, axes = o.grid.axes.count](const Row& row) {
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

}  // namespace

void add_presence(TaskList& list, const PresenceInput& v, const SchemeOptions& o, int effect) {
  add_sets(list, v, o, effect);
  add_neighbourhood(list, v, o, effect);
  add_near(list, v, o, effect);
  if (o.scheme.second_order) add_blends(list, v, effect);
  if (o.materials.mixed != nullptr && o.scheme.second_order) add_alike(list, v, o, effect);
}

}  // namespace sluice::ice::mixture
