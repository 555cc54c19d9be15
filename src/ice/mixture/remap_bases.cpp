// Step 7 (2-D and 3-D) with several materials: what each offers to the remap along axis d.
//
//   V_m:         V_m - sum_{t != d} h_t u_t L3_t(V_m)
//   rho_m:       rho_mL - sum_{t != d} [ h_t u_t L3_t(rho_m) - h_t rho_m su_t ]
//   (rho e)_m:   eps_mL - sum_{t != d} [ h_t u_t L3_t((rho e)_m) - h_t ((rho e)_m + p) su_t ]
// as for one material (one_material/remap_base_rows.hpp). Differences count only where the material
// fills more than a trace of the cell and of both neighbours. Density is floored at a tenth,
// energy .9 scales below the Lagrangian value.
#include <algorithm>

#include "ice/mixture/tasks.hpp"
#include "ice/mixture/trace_rules.hpp"
#include "ice/one_material/remap_base_rows.hpp"
#include "ice/step/material_runs.hpp"
#include "ice/step/remap_bounds.hpp"

namespace sluice::ice::mixture {
namespace {

struct Handles {
  RemapBaseHandles common;
  std::vector<In> volume, mass, energy;  // old state
  In pure, near, inverse_J, specific_energy_L, scale;
  In strain;  // where the materials of a cell relax before the remap
  In blend, blend_density, blend_energy;
  In own_velocity;              // of each material, where it has its own
  int velocity_components = 0;  // of one material in it; 0: all move with the mixture
  std::array<Out, 3> base;      // of each material
};

// What every material offers near several of them; in cells of pure neighbourhood it is what the
// mixture offers, or nothing. Rows are looked up once for all runs.
template <int D, bool Masked>
class MixedBases {
 public:
  MixedBases(const Row& row, const Handles& handles, const Axes& axes)
      : materials_(static_cast<int>(handles.volume.size())) {
    mixture_.p = row(handles.common.pressure);
    mixture_.iJ = row(handles.inverse_J);
    mixture_.mask = Masked ? row(handles.common.mask) : mixture_.p;
    mixture_.pure = row(handles.pure);
    for (int d = 0; d < D; ++d)
      for (int q = 0; q < 2; ++q) mixture_.base[q][d] = row(handles.common.base[d], q);
    for (int t = 0; t < D; ++t) {
      mixture_.su[t] = row(handles.common.velocity_slope, t);
      mixture_.h[t] = 0.5 * row.step().dt / row.step().spacing[axes.direction[t]];
      mixture_.put[t] = handles.common.solved ? 0.0 : mixture_.h[t];
      blend_[2 * t] = runs_of(row, handles.blend, t, -1);
      blend_[2 * t + 1] = runs_of(row, handles.blend, t, 1);
    }
    blend_[2 * D] = runs_of(row, handles.blend);
    for (int m = 0; m < materials_; ++m) bind(rows_[m], row, handles, m);
  }

  void run(int first, int count) const {
    const std::uint64_t blend = blend_around(first, count);
    for (int m = 0; m < materials_; ++m) {
      if (blend == 0)
        write<false>(rows_[m].from(first), mixture_.from(first), m, count);
      else if ((blend >> m & 1) != 0)
        write<true>(rows_[m].from(first), mixture_.from(first), m, count);
      else
        write_nothing(rows_[m].from(first), count);
    }
  }

 private:
  struct Material {
    Quantity V, M, E;
    Quantity r, e;  // per own volume, of blends alone
    const double *eps_L, *scale, *iJ;
    const double* u[D];  // its own velocity, or that of the mixture
    double* base[3][D];

    Material from(int first) const {
      Material k{V.template from<D>(first),
                 M.template from<D>(first),
                 E.template from<D>(first),
                 r.template from<D>(first),
                 e.template from<D>(first),
                 eps_L + first,
                 scale + first,
                 iJ + first,
                 {},
                 {}};
      for (int t = 0; t < D; ++t) k.u[t] = u[t] + first;
      for (int q = 0; q < 3; ++q)
        for (int d = 0; d < D; ++d) k.base[q][d] = base[q][d] + first;
      return k;
    }
  };

  struct Mixture {
    const double *p, *iJ, *mask, *pure;
    const double* base[2][D];  // of density and energy
    const double* su[D];
    double h[D], put[D];  // put: what squeezing gives back, see remap_base_rows.hpp

    Mixture from(int first) const {
      Mixture x = *this;
      for (const double** row : {&x.p, &x.iJ, &x.mask, &x.pure}) *row += first;
      for (int d = 0; d < D; ++d) {
        x.base[0][d] += first;
        x.base[1][d] += first;
        x.su[d] += first;
      }
      return x;
    }
  };

  void bind(Material& k, const Row& row, const Handles& handles, int m) const {
    k.V = quantity<D>(row, handles.volume[m], 0);
    k.M = quantity<D>(row, handles.mass[m], 0);
    k.E = quantity<D>(row, handles.energy[m], 0);
    k.r = quantity<D>(row, handles.blend_density, m);
    k.e = quantity<D>(row, handles.blend_energy, m);
    k.eps_L = row(handles.specific_energy_L, m);
    k.scale = row(handles.scale, m);
    k.iJ = handles.strain.index < 0 ? mixture_.iJ : row(handles.strain, materials_ + m);
    for (int t = 0; t < D; ++t)
      k.u[t] = handles.velocity_components > 0
                   ? row(handles.own_velocity, m * handles.velocity_components + t)
                   : row(handles.common.velocity, t);
    for (const Carried q : {of_volume, of_mass, of_energy})
      for (int d = 0; d < D; ++d) k.base[q][d] = row(handles.base[d], component(m, q));
  }

  // The materials of these cells and those beside them, if they are blends of the same; else 0.
  std::uint64_t blend_around(int first, int count) const {
    return as_set(key_of_all(blend_, 2 * D + 1, first, count));
  }

  // Density and energy per own volume.
  struct Values {
    double r, e;
  };
  static Values values(double M, double V, double E) {
    const double inverse = per_own_volume(V);
    return {M * inverse, E * inverse};
  }

  // What flow along axis t takes from volume, density and energy until the middle of the step.
  struct Changes {
    double V, r, e;
  };
  template <bool Blend>
  [[gnu::always_inline]] static Changes changes(const Material& k, const Mixture& x,
                                                const Values& here, int t, int i) {
    const double V = k.V.centre[i], V_low = k.V.minus[t][i], V_high = k.V.plus[t][i];
    Values low, high;
    bool full = true;
    if constexpr (Blend) {
      low = {k.r.minus[t][i], k.e.minus[t][i]};
      high = {k.r.plus[t][i], k.e.plus[t][i]};
    } else {
      low = values(k.M.minus[t][i], V_low, k.E.minus[t][i]);
      high = values(k.M.plus[t][i], V_high, k.E.plus[t][i]);
      full = smaller(smaller(V_low, V), V_high) > min_sloped;
    }
    const double hu = x.h[t] * k.u[t][i], slopes = full ? hu : 0.0, squeeze = x.su[t][i];
    return {hu * central_slope(V - V_low, V_high - V),
            slopes * central_slope(here.r - low.r, high.r - here.r) - x.put[t] * here.r * squeeze,
            slopes * central_slope(here.e - low.e, high.e - here.e) -
                x.put[t] * (here.e + x.p[i]) * squeeze};
  }

  template <bool Blend>
  static void write(const Material& material, const Mixture& mixture, int m, int n) {
    const Material k = material;
    const Mixture x = mixture;
    const double which = m;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double V = k.V.centre[i];
      Values own;
      if constexpr (Blend)
        own = {k.r.centre[i], k.e.centre[i]};
      else
        own = values(k.M.centre[i], V, k.E.centre[i]);
      Changes along[D];
#pragma GCC unroll 3
      for (int t = 0; t < D; ++t) along[t] = changes<Blend>(k, x, own, t, i);
      const double weight = Masked ? x.mask[i] : 1.0;
      const double here = Blend || V > 0.0 ? weight : 0.0;
      const double rho_L = own.r * k.iJ[i], eps_L = k.eps_L[i];
      const double floor = eps_L - face_drop * k.scale[i];
#pragma GCC unroll 3
      for (int d = 0; d < D; ++d) {
        double by_V = 0, by_r = 0, by_e = 0;
#pragma GCC unroll 3
        for (int t = 0; t < D; ++t) {
          by_V += t == d ? 0.0 : along[t].V;
          by_r += t == d ? 0.0 : along[t].r;
          by_e += t == d ? 0.0 : along[t].e;
        }
        const double own_r = larger(rho_L - here * by_r, face_floor * rho_L);
        const double own_e = larger(eps_L - here * by_e, floor);
        k.base[of_volume][d][i] = V - weight * by_V;
        if constexpr (Blend) {
          k.base[of_mass][d][i] = own_r;
          k.base[of_energy][d][i] = own_e;
        } else {
          const bool mixed = x.pure[i] < 0.0, alone = x.pure[i] == which;
          const double r_alone = alone ? x.base[0][d][i] : 0.0;
          const double e_alone = alone ? x.base[1][d][i] : 0.0;
          k.base[of_mass][d][i] = mixed ? own_r : r_alone;
          k.base[of_energy][d][i] = mixed ? own_e : e_alone;
        }
      }
    }
  }

  static void write_nothing(const Material& k, int n) {
    for (const auto& of_axes : k.base)
      for (double* base : of_axes) std::fill_n(base, n, 0.0);
  }

  int materials_;
  Mixture mixture_;
  RunRow blend_[2 * D + 1];  // of the cells below and above along each axis, of these
  Material rows_[max_materials];
};

template <int D, int C, bool Masked>
void base_rows_of(const Row& row, const Handles& h, const SchemeOptions& o, Vec3 gravity) {
  const auto runs = [&](auto&& f) { for_each_run(runs_of(row, h.pure), row.count(), f); };
  const auto scaled = [&](std::size_t m) {
    return int{o.materials.fluids[m].gamma_law() == nullptr};
  };
  const RunRow pure_runs = runs_of(row, h.pure), near_runs = runs_of(row, h.near);
  if (pure_runs.key[0] < 0.0 && is_one_run(pure_runs, row.count()))
    velocity_base_rows<D, C, Masked>(row, h.common, o.grid.axes, gravity);
  else
    for_each_piece(runs, row.count(), scaled, [&](int first, int count, int of) {
      base_rows<D, C, Masked>(row.part(first, count), h.common, o.grid.axes, gravity, of != 0);
    });
  if (near_runs.key[0] == 0.0 && is_one_run(near_runs, row.count())) return;
  const MixedBases<D, Masked> mixed(row, h, o.grid.axes);  // only where asked for: it is large
  for_each_run(near_runs, row.count(), [&](int first, int count, double near) {
    // Nobody reads what is computed for cells further away.
    if (near != 0.0) mixed.run(first, whole_vectors(count, row.count() - first));
  });
}

}  // namespace

void add_remap_bases(TaskList& list, const RemapBasesInput& v, const SchemeOptions& o, int effect) {
  if (!o.scheme.second_order || o.grid.axes.count == 1) return;  // the base is the Lagrangian value
  TaskBuilder task = list.task("remap bases", effect);
  Handles h;
  h.common = declare_remap_bases(task, v.mixture, o);
  h.pure = task.read(v.pure);
  h.near = task.read(v.near);
  for (const VariableId volume : v.state.volume)
    h.volume.push_back(task.read(volume, Stencil::box(1)));
  for (const VariableId mass : v.state.mass) h.mass.push_back(task.read(mass, Stencil::box(1)));
  for (const VariableId energy : v.state.energy)
    h.energy.push_back(task.read(energy, Stencil::box(1)));
  h.blend = task.read(v.blend, Stencil::box(1));
  h.blend_density = task.read(v.blend_density, Stencil::box(1));
  h.blend_energy = task.read(v.blend_energy, Stencil::box(1));
  if (o.materials.multi_velocity) {
    h.own_velocity = task.read(v.own_velocity);
    h.velocity_components = o.grid.components;
  }
  h.inverse_J = task.read(v.inverse_J);
  h.specific_energy_L = task.read(v.specific_energy_L);
  if (relaxes_before_remap(o)) h.strain = task.read(v.strain);
  h.scale = task.read(v.energy_scale);
  for (int d = 0; d < o.grid.axes.count; ++d) h.base[d] = task.write(v.base[d]);
  const Vec3 gravity = o.forces.on ? o.forces.gravity : Vec3{};
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    if constexpr (D > 1)
      task.kernel([=](const Row& row) {
        if (o.scheme.masked)
          base_rows_of<D, C, true>(row, h, o, gravity);
        else
          base_rows_of<D, C, false>(row, h, o, gravity);
      });
  });
}

}  // namespace sluice::ice::mixture
