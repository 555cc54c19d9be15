// Friction and conduction with several materials: the viscosity of a cell, and who gets the heat.
//
//   mu = sum V_m mu_m                                      (faces: harmonic mean of two cells)
//   Q_m = D s_m + sum_d l_d (taken_m- - given_m+),   s_m = V_m mu_m/mu
// D: the viscous work defect of the cell, what friction turns into heat in its half of each face.
// One velocity strains all materials alike, so that each dissipates by its viscosity; mean shares
// in the cell keep the stress where an inviscid material leaves a trace. Between cells the stress
// is the same on both sides of what lies between their centres: an inviscid fluid slides along a
// viscous one. A share s_m is at most 1000 M_m/rho: what is next to nothing cannot hold the heat.
// The rest, and a defect below zero (where a wave accelerates the cell), goes by mass. Absent
// without friction and conduction.
#include "ice/limiters.hpp"
#include "ice/mixture/runs.hpp"
#include "ice/mixture/variables.hpp"

namespace sluice::ice::mixture {
namespace {

constexpr double most_by_mass = 1000;

struct Handles {
  In pure, presence, dissipation, viscosity, inverse_rho;
  std::vector<In> mass, volume;
  std::array<In, 3> heat_flux;
  Out heat;
};

void friction_row(const Row& row, const Handles& h, const SchemeOptions& o, std::uint64_t set,
                  int m) {
  const int n = row.count();
  const double* __restrict mu = row(h.viscosity);
  const double* __restrict w = row(h.inverse_rho);
  const double* __restrict work = row(h.dissipation, friction_of_mixture);
  double* __restrict heat = row(h.heat, m);
  // The share of each, from a row of its volume and one of its mass.
  const auto share = [&](int of, int i) {
    const auto k = static_cast<std::size_t>(of);
    const double by_mass = most_by_mass * (row(h.mass[k])[i] * w[i]);
    return smaller(row(h.volume[k])[i] * o.viscosities[k] / mu[i], by_mass);
  };
  const double* M = row(h.mass[static_cast<std::size_t>(m)]);
  for (int i = 0; i < n; ++i) {
    heat[i] = 0.0;
    if (!(mu[i] > 0.0)) continue;
    const double by_mass = M[i] * w[i];
    double own = 0, rest = 1;
    if (work[i] > 0.0)
      for_each_of(set, [&](int of) {
        const double s = share(of, i);
        rest -= s;
        if (of == m) own = s;
      });
    heat[i] = work[i] * (own + rest * by_mass);
  }
}

template <int D>
void conduction_row(const Row& row, const Handles& h, const SchemeOptions& o, int m) {
  const int n = row.count();
  double l[D];
  const double *taken[D], *given[D];
  for (int d = 0; d < D; ++d) {
    const In flux = h.heat_flux[static_cast<std::size_t>(d)];
    l[d] = row.step().dt / row.step().spacing[o.axes.direction[d]];
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
void heat_row(const Row& row, const Handles& h, const SchemeOptions& o, std::uint64_t set, int m) {
  if (o.viscous) {
    friction_row(row, h, o, set, m);
  } else {
    double* heat = row(h.heat, m);
    for (int i = 0; i < row.count(); ++i) heat[i] = 0.0;
  }
  if (o.conducting && o.conductivities[static_cast<std::size_t>(m)] > 0.0)
    conduction_row<D>(row, h, o, m);
}

template <int D>
void heat_cells(const Row& row, const Handles& h, const SchemeOptions& o) {
  for_each_run(row(h.pure), row.count(), [&](int first, int count, double pure) {
    if (pure >= 0.0) return;  // the mixture's own energy has it
    const Row part = row.part(first, count);
    for_each_run(part(h.presence), count, [&](int begin, int some, double presence) {
      for_each_of(as_set(presence),
                  [&](int m) { heat_row<D>(part.part(begin, some), h, o, as_set(presence), m); });
    });
  });
}

}  // namespace

void add_viscosity(TaskList& list, const Variables& v, const SchemeOptions& o, int effect) {
  if (!o.viscous) return;
  TaskBuilder task = list.task("viscosity of the mixture", effect);
  std::vector<In> volume;
  for (const VariableId each : v.volume) volume.push_back(task.read(each));
  const Out viscosity = task.write(v.common.viscosity);
  task.kernel([=, mu = o.viscosities](const Row& row) {
    const int n = row.count();
    double* __restrict sum = row(viscosity);
    for (int i = 0; i < n; ++i) sum[i] = 0.0;
    for (std::size_t m = 0; m < volume.size(); ++m) {
      if (!(mu[m] > 0.0)) continue;
      const double* __restrict V = row(volume[m]);
      for (int i = 0; i < n; ++i) sum[i] += V[i] * mu[m];
    }
  });
}

void add_transported_heat(TaskList& list, const Variables& v, const SchemeOptions& o, int effect) {
  if (!o.viscous && !o.conducting) return;
  TaskBuilder task = list.task("heat of friction and conduction", effect);
  Handles h;
  h.pure = task.read(v.pure);
  h.presence = task.read(v.presence);
  if (o.viscous) {
    h.dissipation = task.read(v.common.lagrangian_mixture);
    h.viscosity = task.read(v.common.viscosity);
    h.inverse_rho = task.read(v.common.inverse_rho);
    for (std::size_t m = 0; m < v.mass.size(); ++m) {
      h.mass.push_back(task.read(v.mass[m]));
      h.volume.push_back(task.read(v.volume[m]));
    }
  }
  for (int axis = 0; o.conducting && axis < o.axes.count; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    h.heat_flux[a] = task.read(v.heat_flux[a], Stencil::along(o.axes.direction[axis], 0, 1));
  }
  h.heat = task.write(v.heat);
  dispatch(o.axes.count, o.components,
           [&]<int D, int C>() { task.kernel([=](const Row& row) { heat_cells<D>(row, h, o); }); });
}

}  // namespace sluice::ice::mixture
