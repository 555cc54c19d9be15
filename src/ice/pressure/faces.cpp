// Step i4: velocities and pressures of the faces from X- and d, and the system that d solves.
//
//   u_f = u* - dt/(rho_f dx) [ (X-_b - X-_a)/2 + A (d_b - d_a) ],   rho_f = (rho_a + rho_b)/2
//   p_f = (rho_b X_a + rho_a X_b)/(rho_a + rho_b) + j + k,          X = X- + d
// Differences of X- and of d apart: their sum would lose in its last digit what the flow does at
// Mach 1e-4. On the sides of the domain, where the cell inside is a:
//   wall                u_f = 0                 p_f = X_a + rho_a g dx/2 outward + j
//   velocity given      u_f = that of the ghost     the same
//   all copied          u_f = u*                    the same
//   pressure given      as inside the domain; d of the ghost is 0
//   open (LODI)         open_faces.hpp
// The coefficient of a face, A dt^2/(rho_f dx^2), is 0 where its velocity does not depend on d.
// Beside solids walled_system.cpp makes the system of these coefficients.
#include "ice/fluid/labels.hpp"
#include "ice/pressure/finer_faces.hpp"
#include "ice/pressure/side_faces.hpp"
#include "ice/pressure/variables.hpp"

namespace sluice::ice::pressure {
namespace {

struct Handles {
  In rho, work, increment, velocity, sound, prediction;
  In finer_velocity, finer_pressure;
  Out face_velocity, face_pressure;
};

struct FaceConstants {
  double l = 0, A = 0;  // dt/dx
  double g_dx = 0, f_dx = 0;
};

FaceConstants face_constants(const Row& row, const SchemeOptions& o, int direction) {
  const double dx = row.step().spacing[direction];
  return {row.step().dt / dx, solve_constants(row.step()).A, o.forces.gravity[direction] * dx,
          o.forces.driving[direction] * dx};
}

void inner_faces(const Row& row, const Handles& h, int axis, const FaceConstants& k) {
  const int n = row.whole_vectors();
  const double* __restrict ra = row(h.rho, 0, axis, -1);
  const double* __restrict rb = row(h.rho);
  const double* __restrict Xa = row(h.work, 0, axis, -1);
  const double* __restrict Xb = row(h.work);
  const double* __restrict da = row(h.increment, 0, axis, -1);
  const double* __restrict db = row(h.increment);
  const double* __restrict star = row(h.prediction, star_velocity);
  const double* __restrict j = row(h.prediction, jump_pressure);
  const double* __restrict s = row(h.prediction, slope_pressure);
  double* __restrict uf = row(h.face_velocity);
  double* __restrict pf = row(h.face_pressure);
  const double l = k.l, A = k.A;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double per_r = 1.0 / (ra[i] + rb[i]);
    uf[i] = star[i] - l * (2.0 * per_r) * (0.5 * (Xb[i] - Xa[i]) + A * (db[i] - da[i]));
    pf[i] = (rb[i] * (Xa[i] + da[i]) + ra[i] * (Xb[i] + db[i])) * per_r + (j[i] + s[i]);
  }
}

// Where a finer level begins, what it has found.
void finer_faces(const Row& row, const Handles& h) {
  const int n = row.count();
  const double* __restrict u = row(h.finer_velocity);
  const double* __restrict p = row(h.finer_pressure);
  double* __restrict uf = row(h.face_velocity);
  double* __restrict pf = row(h.face_pressure);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    uf[i] = u[i] == not_given ? uf[i] : u[i];
    pf[i] = p[i] == not_given ? pf[i] : p[i];
  }
}

void side_faces(const Row& row, const Handles& h, int axis, const FaceConstants& k,
                const SchemeOptions& o) {
  for_each_side_face(row, o, axis, [&](int i, bool plus, SideKind kind) {
    if (kind == SideKind::pressure) return;
    const int inside = plus ? -1 : 0, outside = plus ? 0 : -1;
    const auto value = [&](In in, int c, int shift) { return row(in, c, axis, shift)[i]; };
    const double rho = value(h.rho, 0, inside);
    const double X = value(h.work, 0, inside) + value(h.increment, 0, inside);
    double& u = row(h.face_velocity)[i];
    double& p = row(h.face_pressure)[i];
    if (kind == SideKind::open) {
      const OpenFace face = open_face(row, o, axis, i, plus,
                                      {rho, value(h.sound, 0, inside),
                                       value(h.velocity, axis, inside), value(h.work, 0, inside)});
      const double star = row(h.prediction, star_velocity)[i];
      u = face.velocity(star, X);
      p = face.pressure(u);
      return;
    }
    const double weight = 0.5 * (rho * k.g_dx + k.f_dx);
    p = X + (plus ? weight : -weight) + row(h.prediction, jump_pressure)[i];
    if (kind == SideKind::wall)
      u = 0.0;
    else if (kind == SideKind::velocity)
      u = value(h.velocity, axis, outside);
    else
      u = row(h.prediction, star_velocity)[i];
  });
}

// What all cells lose by a rise of d, and R with dp of the faces.
template <int D>
void add_cell_system(TaskList& list, const SolvedFacesInput& v, const SchemeOptions& o,
                     int effect) {
  const auto modulus = [](double rho, double c) { return rho * (c * c); };
  {
    TaskBuilder task = list.task("compressibility of the system", effect);
    const In rho = task.read(v.cells.moving.rho), sound = task.read(v.cells.moving.sound);
    const Out out = task.write(list.output(labels().matrix_cell, 0));
    task.kernel([=](const Row& row) {
      const double al = solve_constants(row.step()).al;
      const double *r = row(rho), *c = row(sound);
      double* to = row(out);
      for (int i = 0; i < row.count(); ++i) to[i] = 1.0 / (al * modulus(r[i], c[i]));
    });
  }
  TaskBuilder task = list.task("right-hand side of the system", effect);
  const ErrorReads in = read_error(task, v.cells, o);
  const In rho = task.read(v.cells.moving.rho), sound = task.read(v.cells.moving.sound);
  std::array<In, 3> face_velocity;
  for (int axis = 0; axis < D; ++axis) {
    face_velocity[axis] =
        task.read(v.face_velocity[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  }
  const Out out = task.write(list.output(labels().right_side, 0));
  task.kernel([=, axes = o.grid.axes](const Row& row) {
    const int n = row.count();
    const double *r = row(rho), *c = row(sound);
    const double *low[D], *high[D];
    double l[D];
    for (int d = 0; d < D; ++d) {
      low[d] = row(face_velocity[d]);
      high[d] = row(face_velocity[d], 0, d, 1);
      l[d] = row.step().dt / row.step().spacing[axes.direction[d]];
    }
    double* R = row(out);
    const ErrorRows<D> error(row, in, axes);
    for (int i = 0; i < n; ++i) {
      double stretch = 0;
      for (int d = 0; d < D; ++d) stretch += l[d] * (high[d][i] - low[d][i]);
      const double K = modulus(r[i], c[i]);
      R[i] = error.at(i, -K * stretch, K);
    }
  });
}

}  // namespace

// What multiplies differences of d across the face in the volume that a cell loses.
void add_face_coefficient(TaskList& list, const ErrorInput& v, const SchemeOptions& o, int axis,
                          VariableId to_write, int effect) {
  const int direction = o.grid.axes.direction[axis];
  const Stencil both = Stencil::along(direction, 1, 0);
  TaskBuilder task = list.task("coefficients of axis " + std::to_string(axis), effect);
  Handles h;
  h.rho = task.read(v.moving.rho, both);
  h.sound = task.read(v.moving.sound, both);
  h.velocity = task.read(v.moving.velocity, both);
  h.work = task.read(v.solve.work, both);
  const Out out = task.write(to_write);
  task.kernel([=](const Row& row) {
    const FaceConstants k = face_constants(row, o, direction);
    const double *ra = row(h.rho, 0, axis, -1), *rb = row(h.rho);
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i) to[i] = k.A * k.l * k.l * 2.0 / (ra[i] + rb[i]);
    for_each_side_face(row, o, axis, [&](int i, bool plus, SideKind kind) {
      if (kind == SideKind::pressure) return;
      to[i] = 0.0;
      if (kind != SideKind::open) return;
      const int inside = plus ? -1 : 0;
      const auto value = [&](In in, int c) { return row(in, c, axis, inside)[i]; };
      to[i] = k.l * open_face(row, o, axis, i, plus,
                              {value(h.rho, 0), value(h.sound, 0), value(h.velocity, axis),
                               value(h.work, 0)})
                        .slope();
    });
  });
}

void add_solved_face_states(TaskList& list, const SolvedFacesInput& v, const SchemeOptions& o,
                            int effect) {
  static const char* names[] = {"solved faces of axis 0", "solved faces of axis 1",
                                "solved faces of axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const int direction = o.grid.axes.direction[axis];
    const Stencil both = Stencil::along(direction, 1, 0);
    TaskBuilder task = list.task(names[axis], effect);
    Handles h;
    h.rho = task.read(v.cells.moving.rho, both);
    h.work = task.read(v.cells.solve.work, both);
    h.increment = task.read(v.cells.solve.increment, both);
    h.velocity = task.read(v.cells.moving.velocity, both);
    h.sound = task.read(v.cells.moving.sound, both);
    h.prediction = task.read(v.cells.solve.prediction[axis]);
    if (o.grid.meets_finer) {
      h.finer_velocity = task.read(v.cells.solve.finer_velocity[axis]);
      h.finer_pressure = task.read(v.cells.solve.finer_pressure[axis]);
    }
    h.face_velocity = task.write(v.face_velocity[axis]);
    h.face_pressure = task.write(v.face_pressure[axis]);
    task.kernel([=](const Row& row) {
      const FaceConstants k = face_constants(row, o, direction);
      inner_faces(row, h, axis, k);
      side_faces(row, h, axis, k, o);
      if (o.grid.meets_finer) finer_faces(row, h);
    });
    if (!o.grid.has_cut_cells)
      add_face_coefficient(list, v.cells, o, axis, list.output(labels().matrix_face[direction], 0),
                           effect);
  }
  if (o.grid.has_cut_cells) return;
  dispatch(o.grid.axes.count, o.grid.components,
           [&]<int D, int C>() { add_cell_system<D>(list, v, o, effect); });
}

}  // namespace sluice::ice::pressure
