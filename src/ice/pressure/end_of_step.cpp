// Steps i5 and i6: what the solve left of the volume of each cell; X of the next step.
//
//   R with dp = p(rho/J, E*/J) - p of the Lagrangian phase: 0 where the solve is exact
//   Y' = X - p',  X = X- + d, p' the pressure of the new state
#include <algorithm>
#include <cmath>

#include "framework/task/reductions.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/pressure/error_rows.hpp"
#include "ice/pressure/variables.hpp"
#include "ice/step/cell_sums.hpp"
#include "ice/step/laws_of_cells.hpp"

namespace sluice::ice::pressure {

void add_volume_error(TaskList& list, const ErrorInput& v, const SchemeOptions& o, VariableId p_L,
                      int effect) {
  TaskBuilder task = list.task("volume error", effect);
  const ErrorReads in = read_error(task, v, o);
  const In rho = task.read(v.moving.rho), sound = task.read(v.moving.sound), p_in = task.read(p_L);
  const Out out = task.write(v.solve.error);
  task.always();
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=, axes = o.grid.axes](const Row& row) {
      const int n = row.count();
      const double *r = row(rho), *c = row(sound), *p = row(in.pressure), *pL = row(p_in);
      double* R = row(out);
      const ErrorRows<D> error(row, in, axes);
      for (int i = 0; i < n; ++i) R[i] = error.at(i, pL[i] - p[i], r[i] * (c[i] * c[i]));
      // Cells under a finer level are its means.
      std::int64_t most = 0;
      for_uncovered(row, o, [&](int first, int end) {
        for (int i = first; i < end; ++i) {
          const std::int64_t size = ordered_bits(std::fabs(R[i]));
          most = size > most ? size : most;
        }
      });
      row.reductions().maximum(StepSlots::volume_error, most);
    });
  });
  TaskBuilder save = list.task("save " + labels().volume_error.name(), effect);
  const In error = save.read(v.solve.error);
  const Out saved = save.write(list.output(labels().volume_error, 0));
  save.kernel([=](const Row& row) { std::copy_n(row(error), row.count(), row(saved)); });
}

void add_offset(TaskList& list, const PressureVariables& v, VariableId p_new, int effect) {
  TaskBuilder task = list.task("work pressure of the next step", effect);
  const In work = task.read(v.work), increment = task.read(v.increment);
  const In p_in = task.read(p_new);
  const Out offset = task.write(v.offset_new);
  task.kernel([=](const Row& row) {
    const double *X = row(work), *d = row(increment), *p = row(p_in);
    double* Y = row(offset);
    for (int i = 0; i < row.count(); ++i) Y[i] = (X[i] + d[i]) - p[i];
  });
}

void add_end_of_one(TaskList& list, const EndOfOneInput& v, const SchemeOptions& o, int effect) {
  const VariableId p_L = list.temporary("Lagrangian pressure");
  {
    TaskBuilder task = list.task("Lagrangian pressure", effect);
    const In rho = task.read(v.rho_L), energy = task.read(v.energy_L);
    const Out out = task.write(p_L);
    const LawsOfCells laws(task, list, o);
    task.kernel([=](const Row& row) {
      laws.of_one(row).pressure(row.count(), row(rho), row(energy), row(out));
    });
  }
  add_volume_error(list, v.error, o, p_L, effect);
  const VariableId p_new = list.temporary("pressure of the new state");
  {
    TaskBuilder task = list.task("pressure of the new state", effect);
    const In rho = task.read(v.after.rho), energy = task.read(v.after.energy);
    const Out out = task.write(p_new);
    const LawsOfCells laws(task, list, o, LawsOfCells::When::new_state);
    task.kernel([=](const Row& row) {
      laws.of_one(row).pressure(row.count(), row(rho), row(energy), row(out));
    });
  }
  add_offset(list, v.error.solve, p_new, effect);
}

}  // namespace sluice::ice::pressure
