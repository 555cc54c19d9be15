// Friction of each material on itself, with velocities of their own.
//
//   t_m = (mu_m/mu) t + tau_m,   tau_m the stress of w_m = u_m - u with mu_m,   t' = t + sum tau_m
// t: the stress of the mixture's motion (one_material/viscous_stress.cpp), mu_m: harmonic mean of
// V_m mu_m of both cells, mu: that of the mixture. What is no material's own, of eddies and between
// fluids that lie side by side, moves all alike. mu_m is at most 3 M_m/(8 dt sum 1/dx^2): a trace
// with little mass takes the friction that it can bear in a step. Absent without friction.
// Where a gas slips along a surface (surface.hpp), friction and slip act one after the other in
// what touches it, t_c (mu - sum mu_m)/mu; what of it cells take is theirs (drag.hpp).
#include <algorithm>
#include <cmath>
#include <string>

#include "ice/closure/drag.hpp"
#include "ice/fluid/face_mean.hpp"
#include "ice/fluid/limiters.hpp"
#include "ice/mixture/surface.hpp"
#include "ice/multi_velocity/tasks.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

// threshold: largest viscosity of a material, relative to M/(dt sum 1/dx^2): the limit of an
//   explicit step; unit: 1; test: none
constexpr double max_viscous_share = 0.375;

struct Handles {
  std::vector<In> mass, volume;
  In pure, own, velocity, viscosity, own_viscosity, stress, surface;
  Out total, each;
};

template <int D, int C>
class Faces {
 public:
  Faces(const Row& row, const Handles& h, const SchemeOptions& o, int axis)
      : row_(row), h_(h), o_(o), axis_(axis), materials_(static_cast<int>(h.mass.size())) {
    double sum = 0;
    for (int t = 0; t < D; ++t) {
      inverse_[t] = 1.0 / row.step().spacing[o.grid.axes.direction[t]];
      sum += inverse_[t] * inverse_[t];
    }
    bearable_ = max_viscous_share / (row.step().dt * sum);
  }
  void run() const {
    for (int i = 0; i < row_.count(); ++i) face(i);
  }

 private:
  double at(In in, int c, int shift, int i) const { return row_(in, c, axis_, shift)[i]; }
  double viscosity(int m, int shift, int i) const {
    const double mu = h_.own_viscosity.index < 0 ? o_.transport.viscosities[m]
                                                 : at(h_.own_viscosity, m, shift, i);
    return at(h_.volume[m], 0, shift, i) * mu;
  }
  // Of a material against the mixture, in a cell of the face or `step` cells from it along t.
  double drift(int m, int c, int shift, int t, int step, int i) const {
    return row_.at_corner(h_.own, m * C + c, axis_, shift, t, step)[i] -
           row_.at_corner(h_.velocity, c, axis_, shift, t, step)[i];
  }
  double across(int m, int c, int t, int i) const {
    const double a = drift(m, c, -1, t, 1, i) - drift(m, c, -1, t, -1, i);
    const double b = drift(m, c, 0, t, 1, i) - drift(m, c, 0, t, -1, i);
    return 0.25 * inverse_[t] * (a + b);
  }
  double strain(int m, int c, int i) const {
    const double normal =
        (drift(m, c, 0, axis_, 0, i) - drift(m, c, -1, axis_, 0, i)) * inverse_[axis_];
    if (c >= D) return normal;
    if (c != axis_) return normal + across(m, axis_, c, i);
    double divergence = 0;
    for (int d = 0; d < D; ++d)
      if (d != axis_) divergence += across(m, d, d, i);
    return 2.0 * normal - (2.0 / 3.0) * (normal + divergence);
  }

  // Of the friction along the face.
  double left_by_slip(double mu, int i) const {
    double own = 0;
    for (int m = 0; m < materials_; ++m)
      own += harmonic_mean(viscosity(m, -1, i), viscosity(m, 0, i));
    const double rest = 1.0 - own / mu;
    if (!(rest > 0.0)) return 1.0;
    FaceOfSurface at_face;
    for (const int side : {0, 1}) {
      const auto share = [&](int m) { return at(h_.volume[m], 0, side - 1, i); };
      at_face.gas[side] = share(o_.materials.multi_velocity_exchange->fluid);
      at_face.solid[side] = share(o_.materials.multi_velocity_exchange->solid);
      at_face.transfer[side] = at(h_.surface, SurfaceParts::momentum_per_area, side - 1, i);
    }
    double touches = 0;
    for (int m = 0; m < materials_; ++m) {
      const In V = h_.volume[m];
      touches += 0.5 * std::fabs(at(V, 0, 0, i) - at(V, 0, -1, i));
    }
    const double surface = smaller(at_face.contact(), touches);
    if (!(surface > 0.0)) return 1.0;
    const double passes = at_face.left_to_face() * at_face.passes(1.0 / inverse_[axis_], mu);
    return 1.0 - rest * (surface / touches) * (1.0 - passes);
  }

  void face(int i) const {
    const double mu = harmonic_mean(at(h_.viscosity, 0, -1, i), at(h_.viscosity, 0, 0, i));
    const double left = o_.materials.multi_velocity_exchange ? left_by_slip(mu, i) : 1.0;
    for (int c = 0; c < C; ++c)
      row_(h_.total, c)[i] = row_(h_.stress, c)[i] * (c == axis_ ? 1.0 : left);
    for (int m = 0; m < materials_; ++m) {
      const double borne = bearable_ * smaller(at(h_.mass[m], 0, -1, i), at(h_.mass[m], 0, 0, i));
      const double own = smaller(harmonic_mean(viscosity(m, -1, i), viscosity(m, 0, i)), borne);
      for (int c = 0; c < C; ++c) {
        double& t = row_(h_.each, m * C + c)[i];
        t = 0.0;
        if (!(own > 0.0)) continue;
        const double tau = own * strain(m, c, i);
        t = own / mu * row_(h_.stress, c)[i] + tau;
        row_(h_.total, c)[i] += tau;
      }
    }
  }

  const Row& row_;
  const Handles& h_;
  const SchemeOptions& o_;
  int axis_, materials_;
  double inverse_[D], bearable_;
};

}  // namespace

SlipStress add_slip_stress(TaskList& list, const SlipStressInput& v, const SchemeOptions& o,
                           int effect) {
  SlipStress written;
  static const char* names[] = {"stress of each material on axis 0",
                                "stress of each material on axis 1",
                                "stress of each material on axis 2"};
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const int direction = o.grid.axes.direction[axis];
    const Stencil both = Stencil::along(direction, 1, 0);
    TaskBuilder task = list.task(names[axis], effect);
    Handles h;
    for (std::size_t m = 0; m < v.state.mass.size(); ++m) {
      h.mass.push_back(task.read(v.state.mass[m], both));
      h.volume.push_back(task.read(v.state.volume[m], both));
    }
    h.pure = task.read(v.pure, both);
    h.own = task.read(v.own_velocity, Stencil::box(1));
    h.velocity = task.read(v.velocity, Stencil::box(1));
    h.viscosity = task.read(v.viscosity, both);
    if (o.own_viscosity_varies()) h.own_viscosity = task.read(v.own_viscosity, both);
    h.stress = task.read(v.stress[axis]);
    if (o.materials.multi_velocity_exchange) h.surface = task.read(v.surface, both);
    written.total[axis] =
        list.temporary(std::string("sum of ") + names[axis], o.grid.components, direction);
    written.each[axis] = list.temporary(
        names[axis], static_cast<int>(v.state.mass.size()) * o.grid.components, direction);
    h.total = task.write(written.total[axis]);
    h.each = task.write(written.each[axis]);
    dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
      task.kernel([=](const Row& row) {
        for_each_face_run(runs_of(row, h.pure, axis, -1), runs_of(row, h.pure), row.count(),
                          [&](int first, int count, double pure) {
                            const Row part = row.part(first, count);
                            if (pure < 0.0) return Faces<D, C>(part, h, o, axis).run();
                            for (int c = 0; c < C; ++c)
                              std::copy_n(part(h.stress, c), count, part(h.total, c));
                          });
      });
    });
  }
  return written;
}

FrictionOnSlip read_friction(TaskBuilder& task, const std::array<VariableId, 3>& stress,
                             const SchemeOptions& o) {
  FrictionOnSlip f;
  f.on = o.transport.viscous;
  f.axes = o.grid.axes;
  f.components = o.grid.components;
  for (int axis = 0; axis < o.grid.axes.count && o.transport.viscous; ++axis) {
    f.stress[axis] = task.read(stress[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  }
  return f;
}

void FrictionOnSlip::add(const Row& row, const DragCell& cell, int c, int i, double* push) const {
  if (!on) return;
  double sum = 0, pull[max_materials];
  for (int k = 0; k < cell.count; ++k) {
    pull[k] = 0;
    for (int d = 0; d < axes.count; ++d) {
      const In t = stress[d];
      const int q = cell.index[k] * components + c;
      const double l = row.step().dt / row.step().spacing[axes.direction[d]];
      pull[k] += l * (row(t, q, d, 1)[i] - row(t, q)[i]);
    }
    sum += pull[k];
  }
  for (int k = 0; k < cell.count; ++k) push[k] += pull[k] - cell.M[k] / cell.total * sum;
}

}  // namespace sluice::ice::mixture
