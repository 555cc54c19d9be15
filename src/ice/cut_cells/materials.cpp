#include "ice/cut_cells/materials.hpp"

#include <cmath>
#include <string>

#include "ice/step/material_runs.hpp"

namespace sluice::ice::cut_cells {

MaterialVariables declare_materials(TaskList& list, const SchemeOptions& o, mixture::Variables& v) {
  const int M = static_cast<int>(o.materials.fluids.size());
  MaterialVariables x;
  x.energy_L = list.temporary("Lagrangian energy of each material beside solids", M);
  x.volume_L = list.temporary("Lagrangian volume beside solids");
  x.passed_on = list.temporary("what cells without fluid pass on", 3 * M);
  v.cut = list.temporary("cells that solids touch");
  v.cut_volume = x.volume_L;
  v.cut_energy = x.energy_L;
  v.old_momentum = v.common.momentum;
  for (int a = 0; a < o.grid.axes.count; ++a) {
    const std::string axis = " of whole cells, axis " + std::to_string(a);
    const int d = o.grid.axes.direction[a];
    x.whole_flux[a] = list.temporary("flux" + axis, 2 + o.grid.components, d);
    x.full_face_material_flux[a] = list.temporary("flux of each material" + axis, 3 * M, d);
    if (o.transport.conducting)
      x.full_face_material_heat[a] = list.temporary("heat through contacts" + axis, 2 * M, d);
    if (!o.materials.multi_velocity) continue;
    x.full_face_velocity[a] =
        list.temporary("velocity of each material" + axis, M * o.grid.components, d);
    if (o.transport.viscous)
      v.slip.stress[a] =
          list.temporary("friction of each material on open faces, axis " + std::to_string(a),
                         M * o.grid.components, d);
  }
  return x;
}

void add_cut_cells(TaskList& list, const WhichCutInput& v, const SchemeOptions&, int effect) {
  TaskBuilder task = list.task("cells that solids touch", effect);
  const In theta = task.read(v.fraction), after = task.read(v.next);
  const Out cut = task.write(v.cut);
  task.kernel([=](const Row& row) {
    const double *before = row(theta), *next = row(after);
    double* here = row(cut);
    for (int i = 0; i < row.count(); ++i) here[i] = before[i] > 0 || next[i] > 0;
  });
}

void add_open_stresses(TaskList& list, const OpenShareInput& v, const SchemeOptions& o,
                       int effect) {
  const int components = static_cast<int>(o.materials.fluids.size()) * o.grid.components;
  for (int axis = 0; axis < o.grid.axes.count && o.transport.viscous; ++axis)
    add_open_share(list, v, o, axis, components,
                   "friction of each material on open faces " + std::to_string(axis), effect);
}

void add_open_heats(TaskList& list, const OpenShareInput& v, const SchemeOptions& o, int effect) {
  const int components = 2 * static_cast<int>(o.materials.fluids.size());
  for (int axis = 0; axis < o.grid.axes.count && o.transport.conducting; ++axis)
    add_open_share(list, v, o, axis, components,
                   "heat through contacts of open faces " + std::to_string(axis), effect);
}

namespace {

// Kinetic energy of what moves against the mixture, sum |S_m|^2/(2 M_m).
double energy_of_slip(const Row& row, const mixture::StateReads& state, const std::vector<In>& slip,
                      const SchemeOptions& o, int i) {
  double sum = 0;
  for (std::size_t m = 0; m < slip.size(); ++m) {
    const double M = row(state.mass[m])[i];
    double squares[3] = {0, 0, 0};
    for (int c = 0; c < o.grid.components; ++c)
      squares[c] = row(slip[m], c)[i] * row(slip[m], c)[i];
    if (M > 0) sum += 0.5 / M * ((squares[0] + squares[1]) + squares[2]);
  }
  return sum;
}

}  // namespace

void add_material_shares(TaskList& list, const MaterialSharesInput& v, const SchemeOptions& o,
                         int effect) {
  TaskBuilder task = list.task("Lagrangian phase of each material beside solids", effect);
  const mixture::StateReads state = mixture::read_state(task, v.state);
  const In theta = task.read(v.fraction), after = task.read(v.next);
  const In p_in = task.read(v.pressure), w_in = task.read(v.inverse_rho);
  const In star = task.read(v.energy_star), energy = task.read(v.energy);
  std::array<In, 3> flow;
  for (int a = 0; a < o.grid.axes.count; ++a)
    flow[a] = task.read(v.flow[a], Stencil::along(o.grid.axes.direction[a], 0, 1));
  const Out volume = task.write(v.volume_L), E_L = task.write(v.energy_L);
  const int materials = static_cast<int>(o.materials.fluids.size());
  std::vector<In> slip;
  for (int m = 0; m < materials && o.materials.multi_velocity; ++m)
    slip.push_back(task.read(v.slip[m]));
  task.kernel([=](const Row& row) {
    const int n = row.count();
    const double *before = row(theta), *next = row(after), *p = row(p_in), *inverse = row(w_in);
    const double *Es = row(star), *E = row(energy);
    double* V_L = row(volume);
    for (int i = 0; i < n; ++i) V_L[i] = 1.0 - next[i];
    for (int a = 0; a < o.grid.axes.count; ++a) {
      const double l = row.step().dt / row.step().spacing[o.grid.axes.direction[a]];
      const In f = flow[a];
      const double *low = row(f), *high = row(f, 0, a, 1);
      for (int i = 0; i < n; ++i) V_L[i] += l * (high[i] - low[i]);
    }
    for (int m = 0; m < materials; ++m) {
      const double *M_m = row(state.mass[m]), *V_m = row(state.volume[m]),
                   *E_m = row(state.energy[m]);
      double* to = row(E_L, m);
      for (int i = 0; i < n; ++i) {
        const double V = 1.0 - before[i];
        const double pdV = p[i] * (V_L[i] - V), W = V * E[i] - Es[i];
        to[i] = V * E_m[i] - (V_m[i] * pdV + (W - pdV) * (M_m[i] * inverse[i]));
      }
    }
    if (slip.empty()) return;
    for (int i = 0; i < n; ++i) {
      const double heat = (1.0 - before[i]) * inverse[i] * energy_of_slip(row, state, slip, o, i);
      if (heat == 0) continue;
      for (int m = 0; m < materials; ++m) row(E_L, m)[i] += heat * row(state.mass[m])[i];
    }
  });
}

namespace {

struct FluxHandles {
  mixture::StateReads state;
  In cut, theta, volume_L, inverse_J, flow, pure, whole, whole_each, velocity_L, energy_L;
  In gives_old, passed_on;
  Out flux, each;
  In full_face_velocity;  // of each fluid, where they move apart
  Out velocity;
};

// Volume, mass and energy of one fluid.
struct Carried {
  double volume = 0, mass = 0, energy = 0;
};

// Low faces of cells `shift` further along the axis, between cells a (low) and b.
class TouchedFaces {
 public:
  TouchedFaces(const Row& row, const FluxHandles& h, const SchemeOptions& o, int axis,
               int shift = 0)
      : row_(row),
        h_(h),
        axis_(axis),
        shift_(shift),
        materials_(static_cast<int>(o.materials.fluids.size())),
        l_(row.step().dt / row.step().spacing[o.grid.axes.direction[axis]]) {}

  // The volume that passes, and whether b gives it.
  double volume(int i) const { return l_ * face(h_.flow)[i]; }
  bool left(int i) const { return face(h_.flow)[i] < 0; }
  bool meets_touched(int i) const {
    return cell(h_.cut, 0, true)[i] != 0 || cell(h_.cut, 0, false)[i] != 0;
  }
  bool donor_is_touched(int i) const { return cell(h_.cut, 0, left(i))[i] != 0; }
  bool donor_is_dry(int i) const { return !(cell(h_.theta, 0, left(i))[i] < 1); }
  double donor_velocity(int c, int i) const { return cell(h_.velocity_L, c, left(i))[i]; }

  // What a touched donor with fluid gives of each.
  template <class F>
  void give(int i, F&& take) const {
    const bool b = left(i);
    const double H = volume(i);
    const double V = 1.0 - cell(h_.theta, 0, b)[i];
    const double V_L = 1.0 / cell(h_.inverse_J, 0, b)[i];
    const bool old = cell(h_.gives_old, 0, b)[i] != 0;
    for (int m = 0; m < materials_; ++m) {
      const double share = cell(h_.state.volume[m], 0, b)[i];
      const double M = cell(h_.state.mass[m], 0, b)[i];
      const double E = old ? cell(h_.state.energy[m], 0, b)[i] : cell(h_.energy_L, m, b)[i] / V_L;
      const double density = old ? M : M * V / V_L;
      take(m, share > 0 ? Carried{H * share, H * density, H * E} : Carried{});
    }
  }
  // One without fluid: what it takes in.
  template <class F>
  void pass_on(int i, F&& take) const {
    const double H = volume(i);
    const auto per_volume = [&](int m, mixture::Carried q) {
      return cell(h_.passed_on, mixture::component(m, q), left(i))[i];
    };
    for (int m = 0; m < materials_; ++m)
      take(m, {H * per_volume(m, mixture::of_volume), H * per_volume(m, mixture::of_mass),
               H * per_volume(m, mixture::of_energy)});
  }
  // One that no solid touches: by the rules of whole cells, which do not tell fluids apart where
  // both cells hold the same one alone.
  bool tells_apart(int i) const {
    const double a = cell(h_.pure, 0, false)[i];
    return !(a >= 0 && a == cell(h_.pure, 0, true)[i]);
  }
  template <class F>
  void give_whole(int i, F&& take) const {
    const int pure = static_cast<int>(cell(h_.pure, 0, true)[i]);
    const bool apart = tells_apart(i);
    for (int m = 0; m < materials_; ++m) {
      const auto each = [&](mixture::Carried q) {
        return face(h_.whole_each, mixture::component(m, q))[i];
      };
      if (apart)
        take(m, {each(mixture::of_volume), each(mixture::of_mass), each(mixture::of_energy)});
      else
        take(m, m == pure ? Carried{volume(i), face(h_.whole, 0)[i], face(h_.whole, 1)[i]}
                          : Carried{});
    }
  }

 private:
  const double* face(In in, int c = 0) const { return row_(in, c, axis_, shift_); }
  const double* cell(In in, int c, bool b) const {
    return row_(in, c, axis_, b ? shift_ : shift_ - 1);
  }

  const Row& row_;
  const FluxHandles& h_;
  int axis_, shift_, materials_;
  double l_;
};

// `cells`, `faces`: around those of a row.
FluxHandles read_fluxes(TaskBuilder& task, const CutFluxInput& v, std::size_t axis,
                        const Stencil& cells, const Stencil& faces) {
  FluxHandles h;
  for (std::size_t m = 0; m < v.state.mass.size(); ++m) {
    h.state.mass.push_back(task.read(v.state.mass[m], cells));
    h.state.volume.push_back(task.read(v.state.volume[m], cells));
    h.state.energy.push_back(task.read(v.state.energy[m], cells));
  }
  h.cut = task.read(v.cut, cells);
  h.theta = task.read(v.fraction, cells);
  h.inverse_J = task.read(v.inverse_J, cells);
  h.flow = task.read(v.flow[axis], faces);
  h.pure = task.read(v.pure, cells);
  h.whole = task.read(v.whole.flux[axis], faces);
  h.whole_each = task.read(v.whole.of_each[axis], faces);
  h.velocity_L = task.read(v.donor_velocity, cells);
  h.energy_L = task.read(v.energy_L, cells);
  h.gives_old = task.read(v.gives_old, cells);
  return h;
}

// What cells without fluid take in of each fluid, per volume. Had they another mixture to give than
// that, of some fluid they would give what they do not have.
void add_passed_on(TaskList& list, const CutFluxInput& v, const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("what cells without fluid pass on", effect);
  std::vector<FluxHandles> of_axis;
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const int d = o.grid.axes.direction[axis];
    of_axis.push_back(read_fluxes(task, v, axis, Stencil::along(d, 1, 1), Stencil::along(d, 0, 1)));
  }
  const Out out = task.write(v.passed_on);
  const int materials = static_cast<int>(o.materials.fluids.size());
  task.kernel([=](const Row& row) {
    const double* theta = row(of_axis.front().theta);
    for (int c = 0; c < 3 * materials; ++c) std::fill_n(row(out, c), row.count(), 0.0);
    const auto to = [&](int m, mixture::Carried q, int i) -> double& {
      return row(out, mixture::component(m, q))[i];
    };
    for (int i = 0; i < row.count(); ++i) {
      if (theta[i] < 1) continue;
      double all = 0;
      const auto take_in = [&](const TouchedFaces& face, double into) {
        const bool enters = into * face.volume(i) > 0;
        if (!enters || face.donor_is_dry(i)) return;
        all += std::fabs(face.volume(i));
        const auto take = [&](int m, const Carried& q) {
          to(m, mixture::of_volume, i) += into * q.volume;
          to(m, mixture::of_mass, i) += into * q.mass;
          to(m, mixture::of_energy, i) += into * q.energy;
        };
        face.donor_is_touched(i) ? face.give(i, take) : face.give_whole(i, take);
      };
      for (int axis = 0; axis < o.grid.axes.count; ++axis) {
        const FluxHandles& h = of_axis[axis];
        take_in(TouchedFaces(row, h, o, axis, 0), 1);
        take_in(TouchedFaces(row, h, o, axis, 1), -1);
      }
      // From others without fluid alone: the mean of the states around, which is what they hold.
      const mixture::StateReads& state = of_axis.front().state;
      for (int m = 0; m < materials; ++m) {
        const In own[] = {state.volume[m], state.mass[m], state.energy[m]};
        for (const mixture::Carried q : {mixture::of_volume, mixture::of_mass, mixture::of_energy})
          to(m, q, i) = all > 0 ? to(m, q, i) / all : row(own[q])[i];
      }
    }
  });
}

// Fluids that move apart in whole cells.
void copy_velocities(const Row& row, const FluxHandles& h, const SchemeOptions& o) {
  const int count = static_cast<int>(o.materials.fluids.size()) * o.grid.components;
  for (int c = 0; c < count; ++c)
    std::copy_n(row(h.full_face_velocity, c), row.count(), row(h.velocity, c));
}
// All that passes face i has one velocity.
void one_velocity(const Row& row, const FluxHandles& h, const SchemeOptions& o, int i) {
  for (int m = 0; m < static_cast<int>(o.materials.fluids.size()); ++m)
    for (int c = 0; c < o.grid.components; ++c)
      row(h.velocity, m * o.grid.components + c)[i] = row(h.flux, 2 + c)[i];
}
// That of all, where each fluid has its own.
void mean_velocity(const Row& row, const FluxHandles& h, const SchemeOptions& o, int i) {
  const double F = row(h.flux, 0)[i];
  if (F == 0) return;
  for (int c = 0; c < o.grid.components; ++c) {
    double sum = 0;
    for (int m = 0; m < static_cast<int>(o.materials.fluids.size()); ++m)
      sum += row(h.each, mixture::component(m, mixture::of_mass))[i] *
             row(h.velocity, m * o.grid.components + c)[i];
    row(h.flux, 2 + c)[i] = sum / F;
  }
}

}  // namespace

void add_fluxes_of_cut_cells(TaskList& list, const CutFluxInput& v, const SchemeOptions& o,
                             int effect) {
  add_passed_on(list, v, o, effect);
  for (int axis = 0; axis < o.grid.axes.count; ++axis) {
    const Stencil both = Stencil::along(o.grid.axes.direction[axis], 1, 0);
    TaskBuilder task = list.task("fluxes beside solids " + std::to_string(axis), effect);
    FluxHandles h = read_fluxes(task, v, axis, both, Stencil::point());
    h.passed_on = task.read(v.passed_on, both);
    h.flux = task.write(v.flux[axis]);
    h.each = task.write(v.flux_of_each[axis]);
    if (o.materials.multi_velocity) {
      h.full_face_velocity = task.read(v.whole.velocity[axis]);
      h.velocity = task.write(v.material_velocity[axis]);
    }
    task.kernel([=](const Row& row) {
      const int n = row.count();
      for (int c = 0; c < 2 + o.grid.components; ++c)
        std::copy_n(row(h.whole, c), n, row(h.flux, c));
      for (int c = 0; c < 3 * static_cast<int>(o.materials.fluids.size()); ++c)
        std::copy_n(row(h.whole_each, c), n, row(h.each, c));
      if (o.materials.multi_velocity) copy_velocities(row, h, o);
      const TouchedFaces face(row, h, o, axis);
      for (int i = 0; i < n; ++i) {
        if (!face.meets_touched(i)) continue;
        double F = 0, G = 0;
        const auto take = [&](int m, const Carried& q) {
          row(h.each, mixture::component(m, mixture::of_volume))[i] = q.volume;
          row(h.each, mixture::component(m, mixture::of_mass))[i] = q.mass;
          row(h.each, mixture::component(m, mixture::of_energy))[i] = q.energy;
          F += q.mass;
          G += q.energy;
        };
        if (!face.donor_is_touched(i)) {
          if (!face.tells_apart(i)) {
            face.give_whole(i, take);
            if (o.materials.multi_velocity) one_velocity(row, h, o, i);
          } else if (o.materials.multi_velocity) {
            mean_velocity(row, h, o, i);
          }
          continue;
        }
        face.donor_is_dry(i) ? face.pass_on(i, take) : face.give(i, take);
        row(h.flux, 0)[i] = F;
        row(h.flux, 1)[i] = G;
        for (int c = 0; c < o.grid.components; ++c)
          row(h.flux, 2 + c)[i] = face.donor_velocity(c, i);
        if (o.materials.multi_velocity) one_velocity(row, h, o, i);
      }
    });
  }
}

}  // namespace sluice::ice::cut_cells
