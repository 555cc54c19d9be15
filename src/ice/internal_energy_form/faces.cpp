// Steps 2 and 4 of the classic form: face velocity and face pressure.
//
//   u_f = (rho_a u_a + rho_b u_b)/(rho_a + rho_b) - 2 l (p_b - p_a)/(rho_a + rho_b) + dt g'
//         with g' = g + 2 f/(rho_a + rho_b) under a driving force f
//   p_f = (rho_a p_b + rho_b p_a)/(rho_a + rho_b)          with p the pressure after its change
// Both means are written as the plain mean plus half the difference times a weight, so that equal
// values give their own bits and mirrored states mirrored ones. On a wall u_f = 0; where the
// velocity through a side is given, u_f is that, and p_f the pressure of the cell inside, carried
// to the face by its weight.
#include "ice/internal_energy_form/variables.hpp"
#include "ice/step/held_faces.hpp"
#include "ice/step/wall_faces.hpp"

namespace sluice::ice::internal_energy_form {
namespace {

struct VelocityHandles {
  In rho, velocity, pressure, sound;
  Out face_velocity;
};

void velocity_row(const Row& row, const VelocityHandles& h, int axis, double l, double kick,
                  double push) {
  const int n = row.count();
  const double* __restrict ra = row(h.rho, 0, axis, -1);
  const double* __restrict rb = row(h.rho);
  const double* __restrict ua = row(h.velocity, axis, axis, -1);
  const double* __restrict ub = row(h.velocity, axis);
  const double* __restrict pa = row(h.pressure, 0, axis, -1);
  const double* __restrict pb = row(h.pressure);
  double* __restrict uf = row(h.face_velocity);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double w = 1.0 / (ra[i] + rb[i]);
    const double mean = 0.5 * (ua[i] + ub[i]) + 0.5 * (ub[i] - ua[i]) * ((rb[i] - ra[i]) * w);
    uf[i] = (mean - 2.0 * l * (pb[i] - pa[i]) * w) + (kick + 2.0 * push * w);
  }
}

struct PressureHandles {
  In rho, pressure, velocity, sound;
  Out face_pressure;
};

// `per_rho`, `push`: weight over half a cell of a unit of density, and of a driving force.
void held_pressures(const Row& row, const PressureHandles& h, const SchemeOptions& o, int axis,
                    double per_rho, double push) {
  double* pf = row(h.face_pressure);
  for_each_prescribed_face(row, o, axis, h.velocity, h.sound, [&](int i, bool plus, double) {
    const int inside = plus ? -1 : 0;
    const double weight = per_rho * row(h.rho, 0, axis, inside)[i] + push;
    pf[i] = row(h.pressure, 0, axis, inside)[i] + (plus ? weight : -weight);
  });
}

void pressure_row(const Row& row, const PressureHandles& h, int axis) {
  const int n = row.count();
  const double* __restrict ra = row(h.rho, 0, axis, -1);
  const double* __restrict rb = row(h.rho);
  const double* __restrict pa = row(h.pressure, 0, axis, -1);
  const double* __restrict pb = row(h.pressure);
  double* __restrict pf = row(h.face_pressure);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i)
    pf[i] = 0.5 * (pa[i] + pb[i]) + 0.5 * (pb[i] - pa[i]) * ((ra[i] - rb[i]) / (ra[i] + rb[i]));
}

}  // namespace

void add_face_velocity(TaskList& list, const FaceVelocityInput& v, const SchemeOptions& o,
                       int effect) {
  static const char* names[] = {"face velocity of axis 0", "face velocity of axis 1",
                                "face velocity of axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const int direction = o.grid.axes.direction[axis];
    const Stencil both = Stencil::along(direction, 1, 0);
    TaskBuilder task = list.task(names[axis], effect);
    VelocityHandles h;
    h.rho = task.read(v.rho, both);
    h.velocity = task.read(v.velocity, both);
    h.pressure = task.read(v.pressure, both);
    if (holds_velocities(o)) h.sound = task.read(v.sound, both);
    h.face_velocity = task.write(v.face_velocity[axis]);
    const double gravity = o.forces.gravity[direction], force = o.forces.driving[direction];
    task.kernel([=](const Row& row) {
      const double dt = row.step().dt;
      velocity_row(row, h, axis, dt / row.step().spacing[direction], dt * gravity, dt * force);
      double* uf = row(h.face_velocity);
      for_each_wall_face(row, o, axis, [&](int i, bool) { uf[i] = 0.0; });
      for_each_prescribed_face(row, o, axis, h.velocity, h.sound,
                               [&](int i, bool, double u) { uf[i] = u; });
    });
  }
}

void add_face_pressure(TaskList& list, const FacePressureInput& v, const SchemeOptions& o,
                       int effect) {
  static const char* names[] = {"face pressure of axis 0", "face pressure of axis 1",
                                "face pressure of axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 1, 0);
    TaskBuilder task = list.task(names[axis], effect);
    PressureHandles h;
    h.rho = task.read(v.rho, both);
    h.pressure = task.read(v.pressure, both);
    if (holds_velocities(o)) {
      h.velocity = task.read(v.velocity, both);
      h.sound = task.read(v.sound, both);
    }
    h.face_pressure = task.write(v.face_pressure[axis]);
    const int direction = o.grid.axes.direction[axis];
    task.kernel([=](const Row& row) {
      pressure_row(row, h, axis);
      const double half = 0.5 * row.step().spacing[direction];
      held_pressures(row, h, o, axis, half * o.forces.gravity[direction],
                     half * o.forces.driving[direction]);
    });
  }
}

}  // namespace sluice::ice::internal_energy_form
