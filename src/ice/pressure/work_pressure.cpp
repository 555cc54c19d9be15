// Step i1: X- of every cell, and the pressure whose slopes the faces take.
//
//   X- = p + Y,   ps = X- + min(1, 1/C^2)(p - X-),   C = c dt/dx, the largest of all directions
// p carries what a loose solve left of the equation of state, rho c^2 R: at large C that is noise
// far above the pressure of the flow, and must not enter a gradient.
#include <algorithm>

#include "ice/fluid/labels.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/pressure/finer_faces.hpp"
#include "ice/pressure/variables.hpp"

namespace sluice::ice::pressure {

void declare_variables(TaskList& list, const SchemeOptions& o, SchemeVariables& v) {
  const Labels& l = labels();
  PressureVariables& x = v.solve;
  x.offset = list.old_state(l.pressure_offset, 0, 1);
  x.increment = list.old_state(l.pressure_increment, 0, 1);
  x.offset_new = list.new_state(l.pressure_offset, 0, 1);
  x.work = list.temporary("work pressure");
  x.smooth = list.temporary("smooth pressure");
  x.error = list.temporary("relative volume error");
  if (o.transport.viscous) x.force = list.temporary("viscous force", o.grid.axes.count);
  if (o.grid.meets_coarser) x.interface = list.old_state(l.interface_pressure, 0, 1);
  if (o.grid.meets_finer)
    for (int a = 0; a < o.grid.axes.count; ++a) {
      const int d = o.grid.axes.direction[a];
      x.finer_velocity[a] = list.old_state(l.finer_face_velocity[d], 0, 1);
      x.finer_pressure[a] = list.old_state(l.finer_face_pressure[d], 0, 1);
    }
  for (int a = 0; a < o.grid.axes.count; ++a)
    x.prediction[a] = list.temporary("prediction of axis " + std::to_string(a), prediction_count,
                                     o.grid.axes.direction[a]);
}

void add_work_pressure(TaskList& list, const ErrorInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("work pressure", effect);
  const In p_in = task.read(v.pressure), c_in = task.read(v.moving.sound),
           offset = task.read(v.solve.offset);
  In interface;
  if (o.grid.meets_coarser) interface = task.read(v.solve.interface);
  const Out work = task.write(v.solve.work), smooth = task.write(v.solve.smooth);
  task.kernel([=, axes = o.grid.axes](const Row& row) {
    double per_dx = 0;
    for (int a = 0; a < axes.count; ++a)
      per_dx = std::max(per_dx, 1.0 / row.step().spacing[axes.direction[a]]);
    const double l = row.step().dt * per_dx;
    const int n = row.whole_vectors();
    const double* __restrict p = row(p_in);
    const double* __restrict c = row(c_in);
    const double* __restrict Y = row(offset);
    double* __restrict X = row(work);
    double* __restrict ps = row(smooth);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double C = l * c[i];
      const double share = 1.0 / larger(1.0, C * C);
      X[i] = p[i] + Y[i];
      ps[i] = p[i] + (Y[i] - share * Y[i]);
    }
    if (interface.index < 0) return;
    const double* __restrict given = row(interface);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      X[i] = given[i] == not_given ? X[i] : given[i];
      ps[i] = given[i] == not_given ? ps[i] : given[i];
    }
  });
}

namespace {

void save_cells(TaskList& list, Label label, VariableId from, int effect) {
  TaskBuilder task = list.task("save " + label.name(), effect);
  const In in = task.read(from);
  const Out out = task.write(list.output(label, 0));
  task.kernel([=](const Row& row) { std::copy_n(row(in), row.count(), row(out)); });
}

}  // namespace

void add_solved_faces(TaskList& list, const SolvedFacesInput& v, const SchemeOptions& o,
                      int effect) {
  add_work_pressure(list, v.cells, o, effect);  // p, Y                    X-, ps
  add_smooth_slopes(list, v, o, effect);        // u, ps                   su, sp, UT
  add_viscous_force(list, v, o, effect);        // t_f                     Fv
  add_predictions(list, v, o, effect);          // u, c, slopes, Fv        u*, j, k
  add_solved_face_states(list, v, o, effect);   // X-, d, predictions      u_f, p_f, matrix, R
  save_cells(list, labels().work_pressure, v.cells.solve.work, effect);
  save_cells(list, labels().sum_of_corrections, v.cells.solve.increment, effect);
  save_cells(list, labels().last_correction, list.old_state(labels().pressure_correction, 0, 1),
             effect);
}

}  // namespace sluice::ice::pressure
