// Momentum and velocity of each material in the Lagrangian phase, and what a step does to it.
//
// With u of the mixture, S_m = M_m (u_m - u), dp what the mixture loses (impulse.hpp) and
// q_c = l_c (p_f+ - p_f-) - dt f_c, the part of it that acts by volume:
//   mom_source = -dp M_m/rho - (V_m - M_m/rho) q + friction_m     mom_L = M_m u_m + mom_source
//   mom_L_ME   = (m - dp) M_m/rho + M_m w_mL
// Both sum to (m - dp), and so does what exchange makes of the one: the other. Where a material is
// alone M_m/rho and V_m are 1 to the bit.
#include <algorithm>

#include "ice/fluid/labels.hpp"
#include "ice/outputs/step_labels.hpp"
#include "ice/step/cell_sums.hpp"

namespace sluice::ice {
namespace {

enum class Part { source, before_exchange, after_exchange, velocity, velocity_before };

struct Handles {
  In mass, volume, rho, momentum, impulse, slip, velocity_L, friction;
  std::array<In, 3> face_pressure;
  bool own = false, rubs = false;
  int first = 0;
  Out out;
};

Handles read_motion(TaskBuilder& task, const OutputInput& v, const SchemeOptions& o,
                    const MaterialOfStep& m) {
  Handles h;
  h.mass = task.read(m.mass);
  h.volume = task.read(m.volume);
  h.rho = task.read(v.rho);
  h.momentum = task.read(v.momentum);
  h.impulse = task.read(v.impulse);
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    h.face_pressure[axis] =
        task.read(v.face_pressure[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  }
  h.own = m.motion.has_value();
  if (!h.own) return h;
  h.first = m.motion->first;
  h.slip = task.read(m.motion->slip);
  h.velocity_L = task.read(m.motion->velocity_L);
  h.rubs = m.motion->friction.has_value();
  if (h.rubs) h.friction = task.read(*m.motion->friction);
  return h;
}

// Of component c in cell i.
class MotionOfRow {
 public:
  MotionOfRow(const Row& row, const Handles& h, const SchemeOptions& o, int c)
      : mass_(row(h.mass)),
        volume_(row(h.volume)),
        rho_(row(h.rho)),
        momentum_(row(h.momentum, c)),
        impulse_(row(h.impulse, c)),
        slip_(h.own ? row(h.slip, c) : nullptr),
        velocity_L_(h.own ? row(h.velocity_L, h.first + c) : nullptr),
        friction_(h.rubs ? row(h.friction, c) : nullptr) {
    const int d = o.grid.direction[c];
    force_ = row.step().dt * o.forces.driving[d];
    if (c >= o.grid.axes.count) return;
    const In pressure = h.face_pressure[c];
    l_ = row.step().dt / row.step().spacing[d];
    low_ = row(pressure);
    high_ = row(pressure, 0, c, 1);
  }

  double of(Part part, int i) const {
    switch (part) {
      case Part::source:
        return source(i);
      case Part::before_exchange:
        return (momentum_[i] * share(i) + (slip_ != nullptr ? slip_[i] : 0.0)) + source(i);
      case Part::after_exchange:
        return (momentum_[i] - impulse_[i]) * share(i) + mass_[i] * slip_L(i);
      case Part::velocity:
        return present(i) ? (momentum_[i] - impulse_[i]) / rho_[i] + slip_L(i) : 0.0;
      default:
        return present(i) ? momentum_[i] / rho_[i] + (slip_ != nullptr ? slip_[i] / mass_[i] : 0.0)
                          : 0.0;
    }
  }

 private:
  bool present(int i) const { return mass_[i] > 0.0; }
  double share(int i) const { return mass_[i] / rho_[i]; }
  double slip_L(int i) const { return velocity_L_ != nullptr ? velocity_L_[i] : 0.0; }
  double source(int i) const {
    const double pressed = (low_ != nullptr ? l_ * (high_[i] - low_[i]) : 0.0) - force_;
    const double given = -impulse_[i] * share(i) - (volume_[i] - share(i)) * pressed;
    return friction_ != nullptr ? given + friction_[i] : given;
  }

  const double *mass_, *volume_, *rho_, *momentum_, *impulse_, *slip_, *velocity_L_, *friction_;
  const double *low_ = nullptr, *high_ = nullptr;
  double l_ = 0, force_ = 0;
};

void clear(const Row& row, Out out) {
  for (int d = 0; d < 3; ++d) std::fill_n(row(out, d), row.count(), 0.0);
}

void save_motion(TaskList& list, const OutputInput& v, const SchemeOptions& o,
                 const MaterialOfStep& m, Label label, Part part, int effect) {
  TaskBuilder task = list.task("save " + label.name(), effect);
  Handles h = read_motion(task, v, o, m);
  h.out = task.write(list.output(label, m.index));
  const bool amount = part != Part::velocity && part != Part::velocity_before;
  task.kernel([=](const Row& row) {
    clear(row, h.out);
    const double size = amount ? cell_volume(row) : 1.0;
    for (int c = 0; c < o.grid.components; ++c) {
      const MotionOfRow motion(row, h, o, c);
      double* to = row(h.out, o.grid.direction[c]);
      for (int i = 0; i < row.count(); ++i) to[i] = motion.of(part, i) * size;
    }
  });
}

// (u_m' - u_m)/dt.
void save_rate(TaskList& list, const OutputInput& v, const SchemeOptions& o,
               const MaterialsOfStep& materials, const MaterialOfStep& m, int effect) {
  struct Side {
    In rho, momentum, mass, slip;
    bool own;
  };
  struct Velocity {
    const double *rho, *momentum, *mass, *slip;
    Velocity(const Row& row, const Side& s, int c)
        : rho(row(s.rho)),
          momentum(row(s.momentum, c)),
          mass(row(s.mass)),
          slip(s.own ? row(s.slip, c) : nullptr) {}
    double at(int i) const {
      return momentum[i] / rho[i] + (slip != nullptr ? slip[i] / mass[i] : 0.0);
    }
  };
  TaskBuilder task = list.task("save " + labels().velocity_rate.name(), effect);
  const bool own = m.motion.has_value();
  const Side before{task.read(v.rho), task.read(v.momentum), task.read(m.mass),
                    own ? task.read(m.motion->slip) : In{}, own};
  const Side after{task.read(materials.density_new), task.read(v.after.momentum),
                   task.read(m.mass_new), own ? task.read(m.motion->slip_new) : In{}, own};
  const Out out = task.write(list.output(labels().velocity_rate, m.index));
  task.kernel([=](const Row& row) {
    clear(row, out);
    for (int c = 0; c < o.grid.components; ++c) {
      double* to = row(out, o.grid.direction[c]);
      const Velocity u(row, before, c), u_new(row, after, c);
      for (int i = 0; i < row.count(); ++i)
        if (u.mass[i] > 0.0 && u_new.mass[i] > 0.0) to[i] = (u_new.at(i) - u.at(i)) / row.step().dt;
    }
  });
}

}  // namespace

void declare_motion_labels(TaskList& list, const OutputInput& v, const SchemeOptions& o,
                           const MaterialsOfStep& materials, int effect) {
  const Labels& l = labels();
  const std::pair<Label, Part> all[] = {{l.momentum_source, Part::source},
                                        {l.momentum_before_exchange, Part::before_exchange},
                                        {l.lagrangian_momentum, Part::after_exchange},
                                        {l.lagrangian_velocity, Part::velocity},
                                        {l.stress_velocity, Part::velocity_before}};
  for (const MaterialOfStep& m : materials.each) {
    for (const auto& [label, part] : all) save_motion(list, v, o, m, label, part, effect);
    save_rate(list, v, o, materials, m, effect);
  }
}

}  // namespace sluice::ice
