// Step 7 (2-D and 3-D) with several materials: what each offers to the remap along axis d.
//
//   V_m:         V_m - sum_{t != d} h_t u_t L3_t(V_m)
//   rho_m:       rho_mL - sum_{t != d} [ h_t u_t L3_t(rho_m) - h_t rho_m su_t ]
//   (rho e)_m:   eps_mL - sum_{t != d} [ h_t u_t L3_t((rho e)_m) - h_t ((rho e)_m + p) su_t ]
// as for one material (conservative/remap_base_rows.hpp). Differences count only where the material
// fills more than a trace of the cell and of both neighbours. Density is floored at a tenth,
// energy .9 scales below the Lagrangian value.
#include <algorithm>
#include <optional>

#include "ice/conservative/remap_base_rows.hpp"
#include "ice/mixture/runs.hpp"
#include "ice/mixture/variables.hpp"

namespace sluice::ice::mixture {
namespace {

struct Handles {
  RemapBaseHandles common;
  std::vector<In> volume;
  In pure, density, specific_energy, inverse_J, specific_energy_L, scale;
  In mixture_density, mixture_energy;
  In own_velocity;              // of each material, where it has its own
  int velocity_components = 0;  // of one material in it; 0: all move with the mixture
  std::array<Out, 3> base;      // of each material
};

constexpr double trace = 1e-10;

// What every material offers in cells that are not of pure neighbourhood; rows are looked up once
// for all of them.
template <int D, bool Masked>
class MixedBases {
 public:
  MixedBases(const Row& row, const Handles& handles, const Axes& axes)
      : materials_(static_cast<int>(handles.volume.size())),
        p_(row(handles.common.pressure)),
        iJ_(row(handles.inverse_J)),
        mask_(Masked ? row(handles.common.mask) : nullptr),
        rho_(quantity<D>(row, handles.mixture_density, 0)),
        energy_(quantity<D>(row, handles.mixture_energy, 0)),
        pure_(quantity<D>(row, handles.pure, 0)) {
    for (int t = 0; t < D; ++t) {
      su_[t] = row(handles.common.velocity_slope, t);
      h_[t] = 0.5 * row.step().dt / row.step().spacing[axes.direction[t]];
    }
    for (int m = 0; m < materials_; ++m) bind(rows_[m], row, handles, m);
  }

  void run(int first, int count) {
    for (int done = 0; done < count; done += most_cells) {
      const int from = first + done, some = std::min(most_cells, count - done);
      const bool any_pure = has_pure_neighbours(from, some);
      for (int m = 0; m < materials_; ++m) {
        Material k = rows_[m].from(from);
        if (any_pure) {
          pick(k.r, rho_.template from<D>(from), m, from, some, work_[0]);
          pick(k.e, energy_.template from<D>(from), m, from, some, work_[1]);
        }
        write(k, from, some);
      }
    }
  }

 private:
  static constexpr int most_cells = 64;
  using Work = double[2 * D][most_cells];

  struct Material {
    Quantity V, r, e;
    const double *eps_L, *scale;
    const double* u[D];  // its own velocity, or that of the mixture
    double* base[3][D];

    Material from(int first) const {
      Material k{V.template from<D>(first),
                 r.template from<D>(first),
                 e.template from<D>(first),
                 eps_L + first,
                 scale + first,
                 {},
                 {}};
      for (int t = 0; t < D; ++t) k.u[t] = u[t] + first;
      for (int q = 0; q < 3; ++q)
        for (int d = 0; d < D; ++d) k.base[q][d] = base[q][d] + first;
      return k;
    }
  };

  static void bind(Material& k, const Row& row, const Handles& handles, int m) {
    k.V = quantity<D>(row, handles.volume[static_cast<std::size_t>(m)], 0);
    k.r = quantity<D>(row, handles.density, m);
    k.e = quantity<D>(row, handles.specific_energy, m);
    k.eps_L = row(handles.specific_energy_L, m);
    k.scale = row(handles.scale, m);
    for (int t = 0; t < D; ++t)
      k.u[t] = handles.velocity_components > 0
                   ? row(handles.own_velocity, m * handles.velocity_components + t)
                   : row(handles.common.velocity, t);
    for (const Carried q : {of_volume, of_mass, of_energy})
      for (int d = 0; d < D; ++d)
        k.base[q][d] = row(handles.base[static_cast<std::size_t>(d)], component(m, q));
  }

  bool has_pure_neighbours(int first, int n) const {
    int pure = 0;
    for (int t = 0; t < D; ++t)
      for (const double* key : {pure_.minus[t], pure_.plus[t]})
        for (int i = first; i < first + n; ++i) pure |= int{key[i] >= 0.0};
    return pure != 0;
  }

  // Neighbours of pure neighbourhood have the values of the mixture.
  void pick(Quantity& own, const Quantity& mixture, int m, int first, int n, Work& work) const {
    for (int t = 0; t < D; ++t) {
      double *low = work[2 * t], *high = work[2 * t + 1];
      pick_row(n, pure_.minus[t] + first, m, own.minus[t], mixture.minus[t], low);
      pick_row(n, pure_.plus[t] + first, m, own.plus[t], mixture.plus[t], high);
      own.minus[t] = low;
      own.plus[t] = high;
    }
  }

  static double slope(const Quantity& q, int t, int i) {
    return central_slope(q.centre[i] - q.minus[t][i], q.plus[t][i] - q.centre[i]);
  }

  void write(const Material& material, int first, int n) const {
    const Material k = material;
    const double *iJ = iJ_ + first, *p = p_ + first, *mask = Masked ? mask_ + first : nullptr;
    const double *u[D], *su[D];
    double h[D];
    for (int t = 0; t < D; ++t) {
      u[t] = k.u[t];
      su[t] = su_[t] + first;
      h[t] = h_[t];
    }
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double V = k.V.centre[i], r = k.r.centre[i], e = k.e.centre[i];
      double dV[D], dr[D], de[D];
#pragma GCC unroll 3
      for (int t = 0; t < D; ++t) {
        const bool full = smaller(smaller(k.V.minus[t][i], V), k.V.plus[t][i]) > trace;
        const double hu = h[t] * u[t][i], slopes = full ? hu : 0.0;
        dV[t] = hu * slope(k.V, t, i);
        dr[t] = slopes * slope(k.r, t, i) - h[t] * r * su[t][i];
        de[t] = slopes * slope(k.e, t, i) - h[t] * (e + p[i]) * su[t][i];
      }
      const double m = Masked ? mask[i] : 1.0, here = V > 0.0 ? m : 0.0;
      const double rho_L = r * iJ[i], eps_L = k.eps_L[i], floor = eps_L - 0.9 * k.scale[i];
#pragma GCC unroll 3
      for (int d = 0; d < D; ++d) {
        double by_V = 0, by_r = 0, by_e = 0;
#pragma GCC unroll 3
        for (int t = 0; t < D; ++t) {
          by_V += t == d ? 0.0 : dV[t];
          by_r += t == d ? 0.0 : dr[t];
          by_e += t == d ? 0.0 : de[t];
        }
        k.base[of_volume][d][i] = V - m * by_V;
        k.base[of_mass][d][i] = larger(rho_L - here * by_r, 0.1 * rho_L);
        k.base[of_energy][d][i] = larger(eps_L - here * by_e, floor);
      }
    }
  }

  int materials_;
  const double *p_, *iJ_, *mask_;
  Quantity rho_, energy_, pure_;
  const double* su_[D];
  double h_[D];
  Material rows_[most_materials];
  Work work_[2];
};

template <int D, int C, bool Masked>
void base_rows_of(const Row& row, const Handles& h, const SchemeOptions& o, Vec3 gravity) {
  const auto runs = [&](auto&& f) { for_each_run(row(h.pure), row.count(), f); };
  const auto scaled = [&](std::size_t m) { return int{o.fluids[m].ideal() == nullptr}; };
  const auto bases_of = [&](int first, int count, int of) {
    base_rows<D, C, Masked>(row.part(first, count), h.common, o.axes, gravity, of != 0);
  };
  for_each_pure_piece(runs, scaled, bases_of);
  std::optional<MixedBases<D, Masked>> mixed;
  runs([&](int first, int count, double pure) {
    if (pure >= 0) return;
    bases_of(first, count, 1);
    if (!mixed) mixed.emplace(row, h, o.axes);
    // Nobody reads what is computed for cells of pure neighbourhood.
    mixed->run(first, whole_vectors(count, row.count() - first));
  });
}

}  // namespace

void add_remap_bases(TaskList& list, const Variables& v, const SchemeOptions& o, int effect) {
  if (!o.second_order || o.axes.count == 1) return;  // the base is the Lagrangian value
  TaskBuilder task = list.task("remap bases", effect);
  Handles h;
  h.common = declare_remap_bases(task, v.common, o);
  h.pure = task.read(v.pure, Stencil::box(1));
  h.mixture_density = task.read(v.common.rho, Stencil::box(1));
  h.mixture_energy = task.read(v.common.energy, Stencil::box(1));
  for (const VariableId volume : v.volume) h.volume.push_back(task.read(volume, Stencil::box(1)));
  h.density = task.read(v.density, Stencil::box(1));
  h.specific_energy = task.read(v.specific_energy, Stencil::box(1));
  if (o.own_velocities) {
    h.own_velocity = task.read(v.slip.velocity);
    h.velocity_components = o.components;
  }
  h.inverse_J = task.read(v.common.inverse_J);
  h.specific_energy_L = task.read(v.specific_energy_L);
  h.scale = task.read(v.energy_scale);
  for (int d = 0; d < o.axes.count; ++d)
    h.base[static_cast<std::size_t>(d)] = task.write(v.base[static_cast<std::size_t>(d)]);
  const Vec3 gravity = o.gravity_on ? o.gravity : Vec3{};
  dispatch(o.axes.count, o.components, [&]<int D, int C>() {
    if constexpr (D > 1)
      task.kernel([=](const Row& row) {
        if (o.masked)
          base_rows_of<D, C, true>(row, h, o, gravity);
        else
          base_rows_of<D, C, false>(row, h, o, gravity);
      });
  });
}

}  // namespace sluice::ice::mixture
