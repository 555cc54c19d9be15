// The system beside solids, and the end of a step there. Of a cell the fluid has the share V, of a
// face 1 - A is open in the mean of the step; cut_cells/variables.hpp has the symbols.
//
//   V R = V { (1 - g1)(p - X-) - al 2 sum_d h_d u_d sp_d - d }/(al K) - (V_L - V),   K = rho c^2
//   V_L = V' + sum_d l_d (w_d+ - w_d-),   w = (1 - A) u_f - C dx/dt
//   V e/(al K) - sum over faces of (1 - A) A_f dt^2/(rho_f dx^2) (e_neighbour - e) = V R
// with A_f that of whole faces (faces.cpp): what V_L makes of a rise of d is (1 - A) du_f, the mean
// of the open share and not that at the start. Faces beside cells without fluid move with the
// solid, and do not depend on d. V R is a volume of the CELL: one of little fluid counts little,
// for it shares what it holds with its neighbours anyhow.
//
// Rows of cells without fluid say d = 0. A cell with no open face stands alone: V, or V_L where
// that is more, so that a pocket that is squeezed has its pressure at once and one that opens none
// below -K.
//
// Behind the sweep -(V_L - V) becomes V (p_L - p)/K, p_L by the law, where a cell gives what the
// step makes of it; where it gives its old state (cut_cells/lagrangian.cpp) it stays linear.
#include <algorithm>
#include <cmath>

#include "framework/task/reductions.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/pressure/error_rows.hpp"
#include "ice/step/cell_sums.hpp"
#include "ice/step/laws_of_cells.hpp"

namespace sluice::ice::pressure {
namespace {

void add_open_coefficient(TaskList& list, const CutCellErrorInput& v, const SchemeOptions& o,
                          int axis, int effect) {
  const int direction = o.grid.axes.direction[axis];
  const std::string name = "coefficients of whole faces " + std::to_string(axis);
  const VariableId of_whole = list.temporary(name, 1, direction);
  add_face_coefficient(list, v.error, o, axis, of_whole, effect);
  TaskBuilder task = list.task("coefficients of open faces " + std::to_string(axis), effect);
  const In whole = task.read(of_whole), covered = task.read(v.mean_covered[axis]);
  const In fraction = task.read(v.fraction, Stencil::along(direction, 1, 0));
  const Out out = task.write(list.output(labels().matrix_face[direction], 0));
  task.kernel([=](const Row& row) {
    const double *k = row(whole), *A = row(covered);
    const double *ta = row(fraction, 0, axis, -1), *tb = row(fraction);
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i)
      to[i] = ta[i] < 1 && tb[i] < 1 ? (1.0 - A[i]) * k[i] : 0.0;
  });
}

// The own coefficient of a cell.
void add_cell_coefficient(TaskList& list, const CutCellErrorInput& v, const SchemeOptions& o,
                          int effect) {
  TaskBuilder task = list.task("compressibility beside solids", effect);
  const In rho = task.read(v.error.moving.rho), sound = task.read(v.error.moving.sound);
  const In fraction = task.read(v.fraction, Stencil::box(1));
  const In after = task.read(v.next);
  std::array<In, 3> covered;
  for (int a = 0; a < o.grid.axes.count; ++a)
    covered[a] = task.read(v.mean_covered[a], Stencil::along(o.grid.axes.direction[a], 0, 1));
  const Out out = task.write(list.output(labels().matrix_cell, 0));
  task.kernel([=, axes = o.grid.axes](const Row& row) {
    const double al = solve_constants(row.step()).al;
    const double *r = row(rho), *c = row(sound), *theta = row(fraction), *next = row(after);
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i) {
      bool closed = true;
      for (int a = 0; a < axes.count && theta[i] < 1; ++a) {
        const In A = covered[a];
        closed &= (row(A)[i] >= 1 || row(fraction, 0, a, -1)[i] >= 1) &&
                  (row(A, 0, a, 1)[i] >= 1 || row(fraction, 0, a, 1)[i] >= 1);
      }
      const double V = 1.0 - (closed ? std::min(theta[i], next[i]) : theta[i]);
      to[i] = (V > 0 ? V : 1.0) / (al * (r[i] * (c[i] * c[i])));
    }
  });
}

struct VolumeReads {
  In fraction, next, rho, sound;
  ErrorReads error;
};

VolumeReads read_volumes(TaskBuilder& task, const CutCellErrorInput& v, const SchemeOptions& o) {
  VolumeReads h;
  h.error = read_error(task, v.error, o);
  h.fraction = task.read(v.fraction);
  h.next = task.read(v.next);
  h.rho = task.read(v.error.moving.rho);
  h.sound = task.read(v.error.moving.sound);
  return h;
}

// V R of the cells of a row, given V_L - V of each; where no solid is R, to the bit as elsewhere,
// given the rise of the pressure.
template <int D, class Growth, class Rise>
void error_row(const Row& row, const VolumeReads& h, const Axes& axes, double* to, Growth&& growth,
               Rise&& rise) {
  const double *theta = row(h.fraction), *after = row(h.next);
  const double *r = row(h.rho), *c = row(h.sound);
  const ErrorRows<D> error(row, h.error, axes);
  for (int i = 0; i < row.count(); ++i) {
    const double V = 1.0 - theta[i], K = r[i] * (c[i] * c[i]);
    if (theta[i] > 0 || after[i] > 0)
      to[i] = V > 0 ? error.beside_solids(i, V, growth(i, V, K), K) : 0.0;
    else
      to[i] = error.at(i, rise(i, K), K);
  }
}

template <int D>
void add_right_side(TaskList& list, const CutCellErrorInput& v, const SchemeOptions& o,
                    int effect) {
  TaskBuilder task = list.task("right-hand side beside solids", effect);
  const VolumeReads h = read_volumes(task, v, o);
  std::array<In, 3> flow;
  for (int a = 0; a < D; ++a)
    flow[a] = task.read(v.flow[a], Stencil::along(o.grid.axes.direction[a], 0, 1));
  const Out out = task.write(list.output(labels().right_side, 0));
  task.kernel([=, axes = o.grid.axes](const Row& row) {
    const double *theta = row(h.fraction), *after = row(h.next);
    const double *low[D], *high[D];
    double l[D];
    for (int d = 0; d < D; ++d) {
      low[d] = row(flow[d]);
      high[d] = row(flow[d], 0, d, 1);
      l[d] = row.step().dt / row.step().spacing[axes.direction[d]];
    }
    const auto stretch = [&](int i) {
      double sum = 0;
      for (int d = 0; d < D; ++d) sum += l[d] * (high[d][i] - low[d][i]);
      return sum;
    };
    error_row<D>(
        row, h, axes, row(out),
        [&](int i, double, double) { return (theta[i] - after[i]) + stretch(i); },
        [&](int i, double K) { return -K * stretch(i); });
  });
}

VariableId add_pressure(TaskList& list, const SchemeOptions& o, VariableId rho, VariableId energy,
                        const char* name, LawsOfCells::When when, int effect) {
  const VariableId to = list.temporary(name);
  TaskBuilder task = list.task(name, effect);
  const In r = task.read(rho), E = task.read(energy);
  const Out out = task.write(to);
  const LawsOfCells laws(task, list, o, when);
  task.kernel(
      [=](const Row& row) { laws.of_one(row).pressure(row.count(), row(r), row(E), row(out)); });
  return to;
}

template <int D>
void add_error(TaskList& list, const CutCellErrorInput& v, const SchemeOptions& o, VariableId p_L,
               int effect) {
  TaskBuilder task = list.task("volume error beside solids", effect);
  const VolumeReads h = read_volumes(task, v, o);
  const In pL_in = task.read(p_L), p_in = task.read(v.error.pressure);
  const In inverse = task.read(v.inverse_J), gives_old = task.read(v.gives_old);
  const Out out = task.write(v.error.solve.error);
  task.always();
  task.kernel([=, axes = o.grid.axes](const Row& row) {
    const double *pL = row(pL_in), *p = row(p_in), *per_V = row(inverse), *old = row(gives_old);
    double* R = row(out);
    error_row<D>(
        row, h, axes, R,
        [&](int i, double V, double K) {
          const double V_L = 1.0 / per_V[i];
          return old[i] == 0 ? -V * ((pL[i] - p[i]) / K) : V_L - V;
        },
        [&](int i, double) { return pL[i] - p[i]; });
    std::int64_t most = 0;
    for (int i = 0; i < row.count(); ++i) {
      const std::int64_t size = ordered_bits(std::fabs(R[i]));
      most = size > most ? size : most;
    }
    row.reductions().maximum(StepSlots::volume_error, most);
  });
  TaskBuilder save = list.task("save " + labels().volume_error.name(), effect);
  const In error = save.read(v.error.solve.error);
  const Out saved = save.write(list.output(labels().volume_error, 0));
  save.kernel([=](const Row& row) { std::copy_n(row(error), row.count(), row(saved)); });
}

}  // namespace

void add_cut_cell_error(TaskList& list, const CutCellErrorInput& v, const SchemeOptions& o,
                        VariableId p_L, int effect) {
  dispatch(o.grid.axes.count, o.grid.components,
           [&]<int D, int C>() { add_error<D>(list, v, o, p_L, effect); });
}

void add_cut_cell_system(TaskList& list, const CutCellErrorInput& v, const SchemeOptions& o,
                         int effect) {
  for (int axis = 0; axis < o.grid.axes.count; ++axis)
    add_open_coefficient(list, v, o, axis, effect);
  add_cell_coefficient(list, v, o, effect);
  dispatch(o.grid.axes.count, o.grid.components,
           [&]<int D, int C>() { add_right_side<D>(list, v, o, effect); });
}

// Of cells that solids meet X - p follows when their state does, behind the sweep.
void add_cut_cell_end_of_step(TaskList& list, const CutCellErrorInput& v, const EndOfOneInput& end,
                              const SchemeOptions& o, int effect) {
  add_cut_cell_error(list, v, o,
                     add_pressure(list, o, end.rho_L, end.energy_L, "Lagrangian pressure",
                                  LawsOfCells::When::old_state, effect),
                     effect);
  add_offset(list, v.error.solve,
             add_pressure(list, o, end.after.rho, end.after.energy, "pressure of the new state",
                          LawsOfCells::When::new_state, effect),
             effect);
}

}  // namespace sluice::ice::pressure
