// Step 6 with velocities of their own: drag and pressure over the Lagrangian phase.
//
//   w_L = E w + R,   w_half = E w + R/2 of half a step,   drift = w_half - sum V_m w_half
// E: half a step of drag; R: what dm_m = -(V_m - M_m/rho) l (p_f+ - p_f-) gives under drag in a
// whole step. Work defect: W - (S - S_L), S = sum M_m |w_m|^2/2: what pressure does on the slip
// and drag takes from it is in it, so that total energy is kept and a drag without limit heats
// nothing.
// A driving force f is a pressure gradient: dp - dt f in place of dp, and what it works on the
// slip, dt f . sum V_m w_half, is added and counted.
// Ghosts from which comes in what a side prescribes (held_faces.hpp): w_L = w, drift = w - sum V w.
#include <cmath>

#include "ice/closure/drag.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/multi_velocity/tasks.hpp"
#include "ice/step/held_faces.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

struct Handles : RelativeVelocityReads {
  Bonds bonds;
  In lagrangian, velocity, sound;
  std::array<In, 3> face_pressure;
  Out velocity_L, drift, kick, work, force_work;
  bool force_on = false;
  FrictionOnSlip friction;
};

class Cells {
 public:
  Cells(const Row& row, const Handles& h, const Drag& drag, const SchemeOptions& o)
      : row_(row),
        h_(h),
        drag_(drag),
        components_(o.grid.components),
        axes_(o.grid.axes.count),
        materials_(static_cast<int>(h.mass.size())) {
    for (int c = 0; c < components_; ++c)
      force_[c] = row.step().dt * o.forces.driving[o.grid.direction[c]];
    for (int a = 0; a < axes_; ++a) {
      l_[a] = row.step().dt / row.step().spacing[o.grid.axes.direction[a]];
      low_[a] = row(h.face_pressure[a]);
      high_[a] = row(h.face_pressure[a], 0, a, 1);
    }
    for (std::size_t m = 0; m < h.mass.size(); ++m) {
      mass_[m] = row(h.mass[m]);
      volume_[m] = row(h.volume[m]);
    }
  }

  void alone() {
    const int n = row_.count();
    const auto clear = [&](Out out, int rows) {
      for (int c = 0; c < rows; ++c)
        for (int i = 0; i < n; ++i) row_(out, c)[i] = 0.0;
    };
    clear(h_.velocity_L, materials_ * components_);
    clear(h_.drift, materials_ * axes_);
    clear(h_.kick, materials_ * axes_);
    const double* W = row_(h_.lagrangian, 0);
    for (int i = 0; i < n; ++i) row_(h_.work)[i] = W[i];
    if (h_.force_on) clear(h_.force_work, 1);
  }
  void mixed(const SchemeOptions& o) {
    for (int i = 0; i < row_.count(); ++i) cell(i);
    for_each_prescribed_ghost(row_, o, h_.velocity, h_.sound, [&](int i) { given(i); });
  }

 private:
  void cell(int i) {
    const double dt = row_.step().dt;
    DragCell cell;
    find_present(materials_, mass_, volume_, i, cell);
    h_.bonds.put(row_, i, cell);
    for (int k = 0; k < cell.count; ++k) {
      double courant = 0;
      for (int a = 0; a < axes_; ++a) {
        const double S = row_(h_.slip[cell.index[k]], a)[i];
        courant = larger(courant, l_[a] * std::fabs(S) / cell.M[k]);
      }
      cell.bind[k] = binding(cell, k, courant);
    }
    double w[3][max_materials], push[3][max_materials];
    double R[3][max_materials], half[3][max_materials];
    double before = 0, after = 0, carried_before = 0, carried_after = 0, driven = 0;
    for (int c = 0; c < components_; ++c) {
      for (int k = 0; k < cell.count; ++k) w[c][k] = row_(h_.slip[cell.index[k]], c)[i] / cell.M[k];
      (c < axes_ ? before : carried_before) += Drag::energy(cell, w[c]);
      const double pressed = (c < axes_ ? l_[c] * (high_[c][i] - low_[c][i]) : 0.0) - force_[c];
      Drag::push(cell, pressed, push[c]);
      h_.friction.add(row_, cell, c, i, push[c]);
    }
    drag_.decay(cell, dt, 0.5, components_, w);
    drag_.respond(cell, dt, 1.0, components_, push, R);
    for (int c = 0; c < components_; ++c)
      for (int k = 0; k < cell.count; ++k) push[c][k] *= 0.5;
    drag_.respond(cell, dt, 0.5, components_, push, half);
    for (int c = 0; c < components_; ++c) {
      for (int k = 0; k < cell.count; ++k) half[c][k] += w[c][k];
      if (c < axes_) write_drift(cell, c, half[c], R[c], i);
      for (int k = 0; k < cell.count; ++k) driven += force_[c] * (cell.V[k] * half[c][k]);
      for (int k = 0; k < cell.count; ++k) w[c][k] += R[c][k];
      (c < axes_ ? after : carried_after) += Drag::energy(cell, w[c]);
      write(h_.velocity_L, cell, components_, c, w[c], i);
    }
    before += carried_before;
    after += carried_after;
    row_(h_.work)[i] = row_(h_.lagrangian, 0)[i] - (before - after) - driven;
    if (h_.force_on) row_(h_.force_work)[i] = driven;
  }
  // Comes in as it is.
  void given(int i) {
    DragCell cell;
    find_present(materials_, mass_, volume_, i, cell);
    const double unpushed[max_materials] = {};
    for (int c = 0; c < components_; ++c) {
      double w[max_materials];
      for (int k = 0; k < cell.count; ++k) w[k] = row_(h_.slip[cell.index[k]], c)[i] / cell.M[k];
      if (c < axes_) write_drift(cell, c, w, unpushed, i);
      write(h_.velocity_L, cell, components_, c, w, i);
    }
    row_(h_.work)[i] = row_(h_.lagrangian, 0)[i];
    if (h_.force_on) row_(h_.force_work)[i] = 0.0;
  }
  // `half`: in the middle of the step.
  void write_drift(const DragCell& cell, int axis, const double* half, const double* R, int i) {
    double drift[max_materials], mean = 0;
    for (int k = 0; k < cell.count; ++k) mean += cell.V[k] * half[k];
    for (int k = 0; k < cell.count; ++k) drift[k] = half[k] - mean;
    write(h_.drift, cell, axes_, axis, drift, i);
    write(h_.kick, cell, axes_, axis, R, i);
  }
  // Zero for those that are absent.
  void write(Out out, const DragCell& cell, int stride, int c, const double* values, int i) {
    for (int m = 0; m < materials_; ++m) row_(out, m * stride + c)[i] = 0.0;
    for (int k = 0; k < cell.count; ++k) row_(out, cell.index[k] * stride + c)[i] = values[k];
  }

  const Row& row_;
  const Handles& h_;
  const Drag& drag_;
  int components_, axes_, materials_;
  double l_[3], force_[3];
  const double *low_[3], *high_[3];
  const double *mass_[max_materials], *volume_[max_materials];
};

}  // namespace

void add_slip_phase(TaskList& list, const SlipPhaseInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("drag and pressure on each material", effect);
  Handles h;
  read_slip(task, v.state, o, h);
  h.bonds = read_bonds(task, v.bonds, o);
  h.lagrangian = task.read(v.lagrangian_mixture);
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    h.face_pressure[axis] =
        task.read(v.face_pressure[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  }
  if (holds_velocities(o)) {
    h.velocity = task.read(v.velocity);
    h.sound = task.read(v.sound);
  }
  h.velocity_L = task.write(v.velocity_L);
  h.drift = task.write(v.drift);
  h.kick = task.write(v.kick);
  h.work = task.write(v.work);
  h.friction = read_friction(task, v.stress, o);
  h.force_on = o.forces.driving_on;
  if (o.forces.driving_on) h.force_work = task.write(v.force_work);
  task.kernel(
      [=, drag = Drag(o.materials.drag, o.materials.multi_velocity_exchange)](const Row& row) {
        for_each_motion(
            row, h, [&](const Row& part) { Cells(part, h, drag, o).alone(); },
            [&](const Row& part) { Cells(part, h, drag, o).mixed(o); });
      });
}

}  // namespace sluice::ice::mixture
