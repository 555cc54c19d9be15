#include "ice/walls/materials.hpp"

#include <string>

#include "ice/step/material_runs.hpp"

namespace sluice::ice::walls {

MaterialVariables declare_materials(TaskList& list, const SchemeOptions& o, mixture::Variables& v) {
  const int M = static_cast<int>(o.fluids.size());
  MaterialVariables x;
  x.energy_L = list.temporary("Lagrangian energy of each material beside solids", M);
  x.volume_L = list.temporary("Lagrangian volume beside solids");
  v.touched = list.temporary("cells that solids touch");
  v.touched_volume = x.volume_L;
  v.touched_energy = x.energy_L;
  v.old_momentum = v.common.momentum;
  for (int a = 0; a < o.axes.count; ++a) {
    const auto n = static_cast<std::size_t>(a);
    const std::string axis = " of whole cells, axis " + std::to_string(a);
    const int d = o.axes.direction[a];
    x.whole_flux[n] = list.temporary("flux" + axis, 2 + o.components, d);
    x.whole_flux_of_each[n] = list.temporary("flux of each material" + axis, 3 * M, d);
  }
  return x;
}

mixture::Variables of_whole_cells(const mixture::Variables& v) {
  mixture::Variables whole = v;
  whole.common.face_velocity = v.common.walls.flow;
  return whole;
}

mixture::Variables of_whole_remap(const mixture::Variables& v, const MaterialVariables& x,
                                  int axis) {
  mixture::Variables remap = v;
  remap.common = of_remap(v.common, axis);
  remap.common.flux = x.whole_flux;
  remap.flux = x.whole_flux_of_each;
  return remap;
}

void add_shares_of_each(TaskList& list, const mixture::Variables& v, const MaterialVariables& x,
                        const SchemeOptions& o, int effect) {
  TaskBuilder task = list.task("Lagrangian phase of each material beside solids", effect);
  const WallVariables& w = v.common.walls;
  const mixture::StateReads state = mixture::read_state(task, v);
  const In theta = task.read(w.fraction), after = task.read(w.next);
  const In p_in = task.read(v.common.pressure), w_in = task.read(v.common.inverse_rho);
  const In star = task.read(v.common.energy_star), energy = task.read(v.common.energy);
  std::array<In, 3> flow;
  for (int a = 0; a < o.axes.count; ++a)
    flow[static_cast<std::size_t>(a)] =
        task.read(w.flow[static_cast<std::size_t>(a)], Stencil::along(o.axes.direction[a], 0, 1));
  const Out touched = task.write(v.touched), volume = task.write(x.volume_L),
            E_L = task.write(x.energy_L);
  const int materials = static_cast<int>(o.fluids.size());
  task.kernel([=](const Row& row) {
    const int n = row.count();
    const double *before = row(theta), *next = row(after), *p = row(p_in), *inverse = row(w_in);
    const double *Es = row(star), *E = row(energy);
    double *here = row(touched), *V_L = row(volume);
    for (int i = 0; i < n; ++i) {
      here[i] = before[i] > 0 || next[i] > 0;
      V_L[i] = 1.0 - next[i];
    }
    for (int a = 0; a < o.axes.count; ++a) {
      const double l = row.step().dt / row.step().spacing[o.axes.direction[a]];
      const In f = flow[static_cast<std::size_t>(a)];
      const double *low = row(f), *high = row(f, 0, a, 1);
      for (int i = 0; i < n; ++i) V_L[i] += l * (high[i] - low[i]);
    }
    for (int m = 0; m < materials; ++m) {
      const auto k = static_cast<std::size_t>(m);
      const double *M_m = row(state.mass[k]), *V_m = row(state.volume[k]),
                   *E_m = row(state.energy[k]);
      double* to = row(E_L, m);
      for (int i = 0; i < n; ++i) {
        const double V = 1.0 - before[i];
        const double pdV = p[i] * (V_L[i] - V), W = V * E[i] - Es[i];
        to[i] = V * E_m[i] - (V_m[i] * pdV + (W - pdV) * (M_m[i] * inverse[i]));
      }
    }
  });
}

namespace {

struct FluxHandles {
  mixture::StateReads state;
  In touched, theta, volume_L, inverse_J, flow, pure, whole, whole_each, velocity_L, energy_L;
  In rho_L, energy_of_donor, energy_of_mixture;
  Out flux, each;
};

// The face of cells a (low) and b.
class TouchedFace {
 public:
  TouchedFace(const Row& row, const FluxHandles& h, const SchemeOptions& o, int axis)
      : row_(row), h_(h), o_(o), axis_(axis), materials_(static_cast<int>(o.fluids.size())) {}

  // What a touched donor gives.
  void give(int i, bool left) const {
    const double l = row_.step().dt / row_.step().spacing[o_.axes.direction[axis_]];
    const double H = l * row_(h_.flow)[i];
    const double V = 1.0 - cell(h_.theta, 0, left)[i];
    const double V_L = 1.0 / cell(h_.inverse_J, 0, left)[i];
    const double rho_L = cell(h_.rho_L, 0, left)[i], eps_L = cell(h_.energy_of_donor, 0, left)[i];
    const double old_E = cell(h_.energy_of_mixture, 0, left)[i];
    double rho = 0;
    for (const In mass : h_.state.mass) rho += cell(mass, 0, left)[i];
    // A donor that gives its old state gives that of each fluid.
    const bool old = rho_L == rho && eps_L == old_E;
    double F = 0, G = 0;
    for (int m = 0; m < materials_; ++m) {
      const auto k = static_cast<std::size_t>(m);
      const double share = cell(h_.state.volume[k], 0, left)[i];
      const double M = cell(h_.state.mass[k], 0, left)[i];
      const double E =
          old ? cell(h_.state.energy[k], 0, left)[i] : cell(h_.energy_L, m, left)[i] / V_L;
      const double density = old ? M : M * V / V_L;
      const bool there = share > 0;
      put(m, mixture::of_volume, i, there ? H * share : 0.0);
      put(m, mixture::of_mass, i, there ? H * density : 0.0);
      put(m, mixture::of_energy, i, there ? H * E : 0.0);
      F += there ? H * density : 0.0;
      G += there ? H * E : 0.0;
    }
    row_(h_.flux, 0)[i] = F;
    row_(h_.flux, 1)[i] = G;
    for (int c = 0; c < o_.components; ++c)
      row_(h_.flux, 2 + c)[i] = cell(h_.velocity_L, c, left)[i];
  }
  // A whole donor that holds one fluid, as its neighbour does.
  void tell_apart(int i, int pure) const {
    const double l = row_.step().dt / row_.step().spacing[o_.axes.direction[axis_]];
    for (int m = 0; m < materials_; ++m) {
      const bool own = m == pure;
      put(m, mixture::of_volume, i, own ? l * row_(h_.flow)[i] : 0.0);
      put(m, mixture::of_mass, i, own ? row_(h_.flux, 0)[i] : 0.0);
      put(m, mixture::of_energy, i, own ? row_(h_.flux, 1)[i] : 0.0);
    }
  }

 private:
  const double* cell(In in, int c, bool left) const {
    return left ? row_(in, c) : row_(in, c, axis_, -1);
  }
  void put(int m, mixture::Carried q, int i, double value) const {
    row_(h_.each, mixture::component(m, q))[i] = value;
  }

  const Row& row_;
  const FluxHandles& h_;
  const SchemeOptions& o_;
  int axis_, materials_;
};

}  // namespace

void add_fluxes_of_touched(TaskList& list, const mixture::Variables& v, const MaterialVariables& x,
                           const SchemeOptions& o, int effect) {
  for (int axis = 0; axis < o.axes.count; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const Stencil both = Stencil::along(o.axes.direction[axis], 1, 0);
    TaskBuilder task = list.task("fluxes beside solids " + std::to_string(axis), effect);
    FluxHandles h;
    for (std::size_t m = 0; m < v.mass.size(); ++m) {
      h.state.mass.push_back(task.read(v.mass[m], both));
      h.state.volume.push_back(task.read(v.volume[m], both));
      h.state.energy.push_back(task.read(v.energy[m], both));
    }
    h.touched = task.read(v.touched, both);
    h.theta = task.read(v.common.walls.fraction, both);
    h.inverse_J = task.read(v.common.inverse_J, both);
    h.flow = task.read(v.common.walls.flow[a]);
    h.pure = task.read(v.pure, both);
    h.whole = task.read(x.whole_flux[a]);
    h.whole_each = task.read(x.whole_flux_of_each[a]);
    h.velocity_L = task.read(v.common.walls.donor_velocity, both);
    h.energy_L = task.read(x.energy_L, both);
    h.rho_L = task.read(v.common.rho_L, both);
    h.energy_of_donor = task.read(v.common.energy_L, both);
    h.energy_of_mixture = task.read(v.common.energy, both);
    h.flux = task.write(v.common.flux[a]);
    h.each = task.write(v.flux[a]);
    task.kernel([=](const Row& row) {
      const int n = row.count();
      for (int c = 0; c < 2 + o.components; ++c) std::copy_n(row(h.whole, c), n, row(h.flux, c));
      for (int c = 0; c < 3 * static_cast<int>(o.fluids.size()); ++c)
        std::copy_n(row(h.whole_each, c), n, row(h.each, c));
      const TouchedFace face(row, h, o, axis);
      const double *ta = row(h.touched, 0, axis, -1), *tb = row(h.touched);
      const double *pa = row(h.pure, 0, axis, -1), *pb = row(h.pure), *w = row(h.flow);
      for (int i = 0; i < n; ++i) {
        if (ta[i] == 0 && tb[i] == 0) continue;
        const bool left = w[i] < 0;
        if ((left ? tb[i] : ta[i]) != 0)
          face.give(i, left);
        else if (pa[i] >= 0 && pa[i] == pb[i])
          face.tell_apart(i, static_cast<int>(pa[i]));
      }
    });
  }
}

}  // namespace sluice::ice::walls
