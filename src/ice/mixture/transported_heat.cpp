// Friction and conduction with several materials: who gets the heat (the viscosity of a cell:
// viscosity.cpp).
//
//   mu = sum V_m mu_m + mu_t                               (faces: harmonic mean of two cells)
//   Q_m = D s_m + sum_d l_d (taken_m- - given_m+),   s_m = (V_m mu_m + mu_t M_m/rho)/mu
// mu_m one number, or a function of the material's own temperature and place; mu_t the subgrid
// viscosity of the mixture's motion, rho C Delta^2 |S|: of each material rho_m C Delta^2 |S|.
// D: the viscous work defect of the cell, what friction turns into heat in its half of each face.
// One velocity strains all materials alike, so that each dissipates by its viscosity; mean shares
// in the cell keep the stress where an inviscid material leaves a trace. Between cells the stress
// is the same on both sides of what lies between their centres: an inviscid fluid slides along a
// viscous one. A share s_m is at most 1000 M_m/rho: what is next to nothing cannot hold the heat.
// The rest, and a defect below zero (where a wave accelerates the cell), goes by mass. Absent
// without friction and conduction.
#include "ice/fluid/limiters.hpp"
#include "ice/mixture/tasks.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {
namespace {

// threshold: largest heat of friction of a material per mass, relative to the mean of the cell;
//   unit: 1; test: none
constexpr double max_by_mass = 1000;

struct Handles {
  In pure, presence, dissipation, viscosity, inverse_rho, own_viscosity, eddy_viscosity;
  std::vector<In> mass, volume;
  std::array<In, 3> heat_flux;
  Out heat;
};

void friction_rows(const Row& row, const Handles& h, const SchemeOptions& o, std::uint64_t set) {
  const int n = row.count();
  const double* mu = row(h.viscosity);
  const double* w = row(h.inverse_rho);
  const double* work = row(h.dissipation, friction_of_mixture);
  const double *M[max_materials], *V[max_materials], *own[max_materials];
  double *heat[max_materials], viscosity[max_materials], share[max_materials];
  const bool varies = o.own_viscosity_varies(),
             turbulent = o.transport.models.turbulence.has_value();
  const double* mu_t = turbulent ? row(h.eddy_viscosity) : nullptr;
  int count = 0;
  for_each_of(set, [&](int m) {
    M[count] = row(h.mass[m]);
    V[count] = row(h.volume[m]);
    viscosity[count] = o.transport.viscosities[m];
    own[count] = varies ? row(h.own_viscosity, m) : nullptr;
    heat[count++] = row(h.heat, m);
  });
  for (int i = 0; i < n; ++i) {
    const bool rubs = mu[i] > 0.0 && work[i] > 0.0;
    const double inverse = rubs ? 1.0 / mu[i] : 0.0;
    double rest = 1;
    for (int m = 0; m < count; ++m) {
      const double by_mass = M[m][i] * w[i];
      double rubbing = V[m][i] * (varies ? own[m][i] : viscosity[m]);
      if (turbulent) rubbing += mu_t[i] * by_mass;
      share[m] = smaller(rubbing * inverse, max_by_mass * by_mass);
      rest -= share[m];
    }
    for (int m = 0; m < count; ++m) heat[m][i] = work[i] * (share[m] + rest * (M[m][i] * w[i]));
  }
}

template <int D>
void conduction_row(const Row& row, const Handles& h, const SchemeOptions& o, int m) {
  const int n = row.count();
  double l[D];
  const double *taken[D], *given[D];
  for (int d = 0; d < D; ++d) {
    const In flux = h.heat_flux[d];
    l[d] = row.step().dt / row.step().spacing[o.grid.axes.direction[d]];
    taken[d] = row(flux, 2 * m + 1);
    given[d] = row(flux, 2 * m, d, 1);
  }
  double* __restrict heat = row(h.heat, m);
  for (int i = 0; i < n; ++i) {
    double gain = 0;
    for (int d = 0; d < D; ++d) gain += l[d] * (taken[d][i] - given[d][i]);
    heat[i] += gain;
  }
}

template <int D>
void heat_rows(const Row& row, const Handles& h, const SchemeOptions& o, std::uint64_t set) {
  if (o.transport.viscous) friction_rows(row, h, o, set);
  for_each_of(set, [&](int m) {
    double* heat = row(h.heat, m);
    for (int i = 0; !o.transport.viscous && i < row.count(); ++i) heat[i] = 0.0;
    if (o.transport.conducting && o.conducts(m)) conduction_row<D>(row, h, o, m);
  });
}

template <int D>
void heat_cells(const Row& row, const Handles& h, const SchemeOptions& o) {
  for_each_run(runs_of(row, h.pure), row.count(), [&](int first, int count, double pure) {
    if (pure >= 0.0) return;  // the mixture's own energy has it
    const Row part = row.part(first, count);
    for_each_run(runs_of(part, h.presence), count, [&](int begin, int some, double presence) {
      heat_rows<D>(part.part(begin, some), h, o, as_set(presence));
    });
  });
}

}  // namespace

void add_transported_heat(TaskList& list, const TransportedHeatInput& v, const SchemeOptions& o,
                          int effect) {
  if (!o.transport.viscous && !o.transport.conducting) return;
  TaskBuilder task = list.task("heat of friction and conduction", effect);
  Handles h;
  h.pure = task.read(v.pure);
  h.presence = task.read(v.presence);
  if (o.transport.viscous) {
    h.dissipation = task.read(v.lagrangian_mixture);
    h.viscosity = task.read(v.viscosity);
    h.inverse_rho = task.read(v.inverse_rho);
    if (o.own_viscosity_varies()) h.own_viscosity = task.read(v.own_viscosity);
    if (o.transport.models.turbulence) h.eddy_viscosity = task.read(v.eddy_viscosity);
    for (std::size_t m = 0; m < v.state.mass.size(); ++m) {
      h.mass.push_back(task.read(v.state.mass[m]));
      h.volume.push_back(task.read(v.state.volume[m]));
    }
  }
  for (int axis = 0; o.transport.conducting && axis < o.grid.axes.count; ++axis) {
    h.heat_flux[axis] =
        task.read(v.heat_flux[axis], Stencil::along(o.grid.axes.direction[axis], 0, 1));
  }
  h.heat = task.write(v.heat);
  dispatch(o.grid.axes.count, o.grid.components,
           [&]<int D, int C>() { task.kernel([=](const Row& row) { heat_cells<D>(row, h, o); }); });
}

}  // namespace sluice::ice::mixture
