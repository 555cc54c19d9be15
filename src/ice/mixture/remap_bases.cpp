// Step 7 (2-D and 3-D) with several materials: what each offers to the remap along axis d.
//
//   V_m:         V_m - sum_{t != d} h_t u_t L3_t(V_m)
//   rho_m:       rho_mL - sum_{t != d} [ h_t u_t L3_t(rho_m) - h_t rho_m su_t ]
//   (rho e)_m:   eps_mL - sum_{t != d} [ h_t u_t L3_t((rho e)_m) - h_t ((rho e)_m + p) su_t ]
// as for one material (conservative/remap_base_rows.hpp). Differences count only where the material
// fills more than a trace of the cell and of both neighbours. Density is floored at a tenth,
// energy .9 scales below the Lagrangian value.
#include <algorithm>

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
  std::array<Out, 3> base;  // of each material
};

constexpr int most_cells = 64;  // of a part of a row

// Rows of one material, and the three components that they write for axis d.
template <int D>
class MaterialRows {
 public:
  Quantity V, r, e;
  const double *iJ, *eps_L, *scale, *p, *mask;
  const double *u[3], *su[3];
  double h[3];

  MaterialRows(const Row& row, const Handles& handles, const Axes& axes, int m) {
    V = quantity<D>(row, handles.volume[static_cast<std::size_t>(m)], 0);
    r = around(row, handles, handles.density, handles.mixture_density, m);
    e = around(row, handles, handles.specific_energy, handles.mixture_energy, m);
    iJ = row(handles.inverse_J);
    eps_L = row(handles.specific_energy_L, m);
    scale = row(handles.scale, m);
    p = row(handles.common.pressure);
    for (int t = 0; t < D; ++t) {
      u[t] = row(handles.common.velocity, t);
      su[t] = row(handles.common.velocity_slope, t);
      h[t] = 0.5 * row.step().dt / row.step().spacing[axes.direction[t]];
    }
  }

  // The cell and its neighbours; where the neighbourhood is pure the values of the mixture.
  Quantity around(const Row& row, const Handles& handles, In own, In mixture, int m) {
    Quantity q;
    q.centre = row(own, m);
    const auto neighbour = [&](int t, int shift) {
      double* to = work[used++];
      pick_row(row.count(), row(handles.pure, 0, t, shift), m, row(own, m, t, shift),
               row(mixture, 0, t, shift), to);
      return to;
    };
    for (int t = 0; t < D; ++t) {
      q.minus[t] = neighbour(t, -1);
      q.plus[t] = neighbour(t, 1);
    }
    return q;
  }

  double slope(const Quantity& q, int t, int i) const {
    return central_slope(q.centre[i] - q.minus[t][i], q.plus[t][i] - q.centre[i]);
  }
  void write(int d, int n, const double* mask_row, double* __restrict volume,
             double* __restrict mass, double* __restrict energy) const {
    for (int i = 0; i < n; ++i) {
      double dV = 0, dr = 0, de = 0;
      for (int t = 0; t < D; ++t) {
        if (t == d) continue;
        const double full =
            V.minus[t][i] > trace && V.centre[i] > trace && V.plus[t][i] > trace ? 1.0 : 0.0;
        const double hu = h[t] * u[t][i];
        dV += hu * slope(V, t, i);
        dr += full * hu * slope(r, t, i) - h[t] * r.centre[i] * su[t][i];
        de += full * hu * slope(e, t, i) - h[t] * (e.centre[i] + p[i]) * su[t][i];
      }
      const double m = mask_row != nullptr ? mask_row[i] : 1.0;
      const double here = V.centre[i] > 0.0 ? m : 0.0;
      const double rho_L = r.centre[i] * iJ[i];
      volume[i] = V.centre[i] - m * dV;
      mass[i] = larger(rho_L - here * dr, 0.1 * rho_L);
      energy[i] = larger(eps_L[i] - here * de, eps_L[i] - 0.9 * scale[i]);
    }
  }
  static constexpr double trace = 1e-10;

 private:
  int used = 0;
  double work[4 * D][most_cells];
};

template <int D>
void material_bases(const Row& row, const Handles& h, const SchemeOptions& o) {
  const double* mask = o.masked ? row(h.common.mask) : nullptr;
  for (int m = 0; m < static_cast<int>(h.volume.size()); ++m) {
    const MaterialRows<D> rows(row, h, o.axes, m);
    for (int d = 0; d < D; ++d) {
      const Out base = h.base[static_cast<std::size_t>(d)];
      rows.write(d, row.count(), mask, row(base, component(m, of_volume)),
                 row(base, component(m, of_mass)), row(base, component(m, of_energy)));
    }
  }
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
  h.inverse_J = task.read(v.common.inverse_J);
  h.specific_energy_L = task.read(v.specific_energy_L);
  h.scale = task.read(v.energy_scale);
  for (int d = 0; d < o.axes.count; ++d)
    h.base[static_cast<std::size_t>(d)] = task.write(v.base[static_cast<std::size_t>(d)]);
  const Vec3 gravity = o.gravity_on ? o.gravity : Vec3{};
  dispatch(o.axes.count, o.components, [&]<int D, int C>() {
    if constexpr (D > 1)
      task.kernel([=](const Row& row) {
        for_each_run(row(h.pure), row.count(), [&](int first, int count, double pure) {
          const Row part = row.part(first, count);
          const bool scaled =
              pure < 0 || o.fluids[static_cast<std::size_t>(pure)].ideal() == nullptr;
          if (o.masked)
            base_rows<D, C, true>(part, h.common, o.axes, gravity, scaled);
          else
            base_rows<D, C, false>(part, h.common, o.axes, gravity, scaled);
          if (pure >= 0) return;
          for (int begin = 0; begin < count; begin += most_cells)
            material_bases<D>(part.part(begin, std::min(most_cells, count - begin)), h, o);
        });
      });
  });
}

}  // namespace sluice::ice::mixture
