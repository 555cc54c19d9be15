// Step 1 with velocities of their own: those velocities, and how the volume moves.
//
//   w_m = S_m/M_m,  u_m = u + w_m (u where absent),  u_V = u + sum V_m w_m(half a drag later)
//   1/rho_e = 1/rho + sum V_m r_m, r_m: what a unit of pressure force gives to w_m in half a step
//   c_e = sqrt(K/rho_e)
// Lock of an interface: with s the range of a volume fraction over a cell and its neighbours along
// an axis, the largest of all, 0 up to a quarter, 1 from three quarters on: s/(1 - s). There the
// materials lie side by side: one average gradient of pressure would tear the light one away.
#include <cmath>
#include <string>

#include "ice/closure/drag.hpp"
#include "ice/closure/interface_band.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/mixture/surface.hpp"
#include "ice/multi_velocity/tasks.hpp"
#include "ice/step/held_faces.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

void add_lock(TaskList& list, const SlipMotionInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("interfaces that bind materials", effect);
  std::vector<In> volume;
  for (const VariableId id : v.state.state.volume) volume.push_back(task.read(id, Stencil::box(1)));
  const In pure = task.read(v.pure);
  const Out lock = task.write(v.bonds.lock);
  const int axes = o.grid.axes.count;
  task.kernel([=](const Row& row) {
    const int n = row.count();
    const double* key = row(pure);
    double* to = row(lock);
    for (int i = 0; i < n; ++i) to[i] = 0.0;
    for (const In& fraction : volume)
      for (int a = 0; a < axes; ++a) {
        const double* low = row(fraction, 0, a, -1);
        const double* here = row(fraction);
        const double* high = row(fraction, 0, a, 1);
        for (int i = 0; i < n; ++i) {
          const double most = larger(larger(low[i], high[i]), here[i]);
          const double least = smaller(smaller(low[i], high[i]), here[i]);
          to[i] = larger(to[i], most - least);
        }
      }
    for (int i = 0; i < n; ++i) {
      const double s = (to[i] - loose_jump) * (1.0 / (tight_jump - loose_jump));
      const double strength = s < 1.0 ? smaller(s / (1.0 - s), strongest_bond) : strongest_bond;
      to[i] = key[i] < 0.0 && s > 0.0 ? strength : 0.0;
    }
  });
}

struct Handles : RelativeVelocityReads {
  Bonds bonds;
  In rho, inverse_rho, velocity, sound;
  Out own, rho_e, inverse_rho_e, volume_velocity, sound_e;
};

// Where a material is alone, or all are bound, all of it is the mixture.
void alone(const Row& row, const Handles& h, int components) {
  const int n = row.count();
  const auto copy = [&](In from, int c, Out to, int d) {
    const double* q = row(from, c);
    double* p = row(to, d);
    for (int i = 0; i < n; ++i) p[i] = q[i];
  };
  copy(h.rho, 0, h.rho_e, 0);
  copy(h.inverse_rho, 0, h.inverse_rho_e, 0);
  copy(h.sound, 0, h.sound_e, 0);
  for (int c = 0; c < components; ++c) {
    copy(h.velocity, c, h.volume_velocity, c);
    for (int m = 0; m < static_cast<int>(h.mass.size()); ++m)
      copy(h.velocity, c, h.own, m * components + c);
  }
}

// What comes in through a side as it is given has felt no drag.
void keep_given(const Row& row, const Handles& h, const SchemeOptions& o) {
  for_each_prescribed_ghost(row, o, h.velocity, h.sound, [&](int i) {
    for (int c = 0; c < o.grid.components; ++c) {
      const double u = row(h.velocity, c)[i];
      double mean = 0;
      for (int m = 0; m < static_cast<int>(h.mass.size()); ++m)
        mean += row(h.volume[m])[i] * (row(h.own, m * o.grid.components + c)[i] - u);
      row(h.volume_velocity, c)[i] = u + mean;
    }
  });
}

class MixedCells {
 public:
  MixedCells(const Row& row, const Handles& h, const Drag& drag, const Axes& axes, int components)
      : row_(row), h_(h), drag_(drag), axes_(axes), components_(components) {
    for (std::size_t m = 0; m < h.mass.size(); ++m) {
      mass_[m] = row(h.mass[m]);
      volume_[m] = row(h.volume[m]);
    }
  }
  void run() {
    const int materials = static_cast<int>(h_.mass.size());
    const double dt = row_.step().dt;
    for (int i = 0; i < row_.count(); ++i) {
      DragCell cell;
      find_present(materials, mass_, volume_, i, cell);
      h_.bonds.put(row_, i, cell);
      for (int k = 0; k < cell.count; ++k) cell.bind[k] = binding(cell, k, courant(cell, k, i));
      velocities(cell, materials, dt, i);
      double push[max_materials], w[max_materials];
      Drag::push(cell, -1.0, push);
      drag_.respond(cell, dt, 0.5, push, w);
      double extra = 0;
      for (int k = 0; k < cell.count; ++k) extra += cell.V[k] * w[k];
      const double rho = row_(h_.rho)[i];
      const double inverse = row_(h_.inverse_rho)[i] + larger(extra, 0.0);
      row_(h_.inverse_rho_e)[i] = inverse;
      row_(h_.rho_e)[i] = 1.0 / inverse;
      row_(h_.sound_e)[i] = row_(h_.sound)[i] * std::sqrt(rho * inverse);
    }
  }

 private:
  double courant(const DragCell& cell, int k, int i) const {
    double most = 0;
    for (int a = 0; a < axes_.count; ++a) {
      const double S = row_(h_.slip[cell.index[k]], a)[i];
      const double dx = row_.step().spacing[axes_.direction[a]];
      most = larger(most, std::fabs(S) * row_.step().dt / (cell.M[k] * dx));
    }
    return most;
  }
  void velocities(const DragCell& cell, int materials, double dt, int i) {
    double w[3][max_materials];
    for (int c = 0; c < components_; ++c) {
      const double u = row_(h_.velocity, c)[i];
      for (int m = 0; m < materials; ++m) row_(h_.own, m * components_ + c)[i] = u;
      for (int k = 0; k < cell.count; ++k) {
        const int m = cell.index[k];
        w[c][k] = row_(h_.slip[m], c)[i] / cell.M[k];
        row_(h_.own, m * components_ + c)[i] = u + w[c][k];
      }
    }
    drag_.decay(cell, dt, 0.5, components_, w);
    for (int c = 0; c < components_; ++c) {
      double mean = 0;
      for (int k = 0; k < cell.count; ++k) mean += cell.V[k] * w[c][k];
      row_(h_.volume_velocity, c)[i] = row_(h_.velocity, c)[i] + mean;
    }
  }

  const Row& row_;
  const Handles& h_;
  const Drag& drag_;
  const Axes& axes_;
  int components_;
  const double *mass_[max_materials], *volume_[max_materials];
};

}  // namespace

Bonds read_bonds(TaskBuilder& task, const BondsInput& v, const SchemeOptions& o) {
  Bonds b;
  b.axes = o.grid.axes.count;
  b.slips = o.materials.multi_velocity_exchange.has_value();
  b.lock = task.read(v.lock);
  if (b.slips) b.surface = task.read(v.surface);
  return b;
}

void Bonds::put(const Row& row, int i, DragCell& cell) const {
  cell.lock = row(lock)[i];
  if (!slips) return;
  cell.surface = row(surface, SurfaceParts::share)[i];
  cell.passes = row(surface, SurfaceParts::momentum)[i];
  for (int a = 0; a < axes; ++a) cell.normal[a] = row(surface, SurfaceParts::normal + a)[i];
}

void declare_relative_velocities(TaskList& list, const SchemeOptions& o, Variables& v) {
  const int M = static_cast<int>(o.materials.fluids.size()), C = o.grid.components,
            D = o.grid.axes.count;
  RelativeVelocityVariables& s = v.slip;
  for (int m = 0; m < M; ++m) {
    s.slip.push_back(list.old_state(labels().slip, m, C));
    s.slip_new.push_back(list.new_state(labels().slip, m, C));
  }
  s.velocity = list.temporary("velocity of each material", M * C);
  s.lock = list.temporary("lock of interfaces");
  VolumeMotionVariables& moving = v.common.moving;
  moving.rho = list.temporary("inertia of the volume");
  moving.inverse_rho = list.temporary("1/inertia of the volume");
  moving.velocity = list.temporary("velocity of the volume", C);
  moving.sound = list.temporary("sound speed of the volume");
  s.velocity_L = list.temporary("Lagrangian slip of each material", M * C);
  s.drift = list.temporary("drift of each material", M * D);
  s.kick = list.temporary("slip by pressure of each material", M * D);
  s.work = list.temporary("work defect with slip");
  if (o.forces.driving_on) s.force_work = list.temporary("work of the driving force on slip");
  s.outflow = list.temporary("outflow and outlets of each material", 2 * M);
  for (int a = 0; a < D; ++a) {
    const std::string axis = " of axis " + std::to_string(a);
    s.face_velocity[a] =
        list.temporary("face velocity of each material" + axis, M, o.grid.axes.direction[a]);
    s.base[a] = list.temporary("remap base of each velocity" + axis, M * C);
    v.common.material_velocity[a] =
        list.temporary("remap velocity of each material" + axis, M * C, o.grid.axes.direction[a]);
  }
}

void read_slip(TaskBuilder& task, const RelativeStateInput& v, const SchemeOptions& o,
               RelativeVelocityReads& r) {
  r.presence = task.read(v.presence);
  r.has_cut_cells = o.grid.has_cut_cells;
  if (o.grid.has_cut_cells) r.cut = task.read(v.cut);
  for (std::size_t m = 0; m < v.state.mass.size(); ++m) {
    r.mass.push_back(task.read(v.state.mass[m]));
    r.volume.push_back(task.read(v.state.volume[m]));
    r.slip.push_back(task.read(v.slip[m]));
  }
}

void add_slip_motion(TaskList& list, const SlipMotionInput& v, const SchemeOptions& o, int effect) {
  add_lock(list, v, o, effect);
  TaskBuilder task = list.task("velocities of each material", effect);
  Handles h;
  read_slip(task, v.state, o, h);
  h.bonds = read_bonds(task, v.bonds, o);
  h.rho = task.read(v.rho);
  h.inverse_rho = task.read(v.inverse_rho);
  h.velocity = task.read(v.velocity);
  h.sound = task.read(v.sound);
  h.own = task.write(v.own_velocity);
  h.rho_e = task.write(v.moving.rho);
  h.inverse_rho_e = task.write(v.moving.inverse_rho);
  h.volume_velocity = task.write(v.moving.velocity);
  h.sound_e = task.write(v.moving.sound);
  task.kernel(
      [=, drag = Drag(o.materials.drag, o.materials.multi_velocity_exchange)](const Row& row) {
        for_each_motion(
            row, h, [&](const Row& part) { alone(part, h, o.grid.components); },
            [&](const Row& part) {
              MixedCells(part, h, drag, o.grid.axes, o.grid.components).run();
              keep_given(part, h, o);
            });
      });
}

}  // namespace sluice::ice::mixture
