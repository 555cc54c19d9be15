// The viscosity of a cell that several materials share.
//
//   mu = sum V_m mu_m + mu_t
// mu_m: one number, or Sutherland's law at the material's own temperature, at least that of sponge
// layers; mu_t: subgrid viscosity of the common motion. Where coefficients vary within a material,
// fronts between materials (face_mean.hpp) know another sum, with one number for each material: in
// one fluid friction works on the mean of two cells. Absent without friction.
#include <algorithm>
#include <string>

#include "ice/mixture/surface.hpp"
#include "ice/mixture/tasks.hpp"
#include "ice/one_material/tasks.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/step/material_runs.hpp"
#include "ice/transport/viscosity.hpp"

namespace sluice::ice::mixture {
namespace {

// One number for each material where it varies: that of its law at 300 K.
std::vector<double> usual_viscosities(const SchemeOptions& o) {
  // coefficient: temperature at which the viscosities of materials are compared; unit: K
  constexpr double usual_temperature = 300;
  std::vector<double> mu = o.transport.viscosities;
  for (std::size_t m = 0; m < mu.size(); ++m)
    if (const auto& law = o.transport.models_of_each[m].sutherland)
      mu[m] = law->viscosity(usual_temperature);
  return mu;
}

// sum V_m mu_m, mu_m one number each.
void add_shares(TaskList& list, const OwnViscosityInput& v, const std::vector<double>& mu,
                const std::string& name, VariableId sum_of_shares, int effect) {
  TaskBuilder task = list.task(name, effect);
  std::vector<In> volume;
  for (const VariableId each : v.state.volume) volume.push_back(task.read(each));
  const Out viscosity = task.write(sum_of_shares);
  task.kernel([=](const Row& row) {
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

// The same of the fields of each.
void add_shares_of_fields(TaskList& list, const OwnViscosityInput& v, VariableId sum_of_shares,
                          int effect) {
  TaskBuilder task = list.task("viscosity of the mixture", effect);
  std::vector<In> volume;
  for (const VariableId each : v.state.volume) volume.push_back(task.read(each));
  const In own = task.read(v.own_viscosity);
  const Out viscosity = task.write(sum_of_shares);
  task.kernel([=](const Row& row) {
    const int n = row.count();
    double* __restrict sum = row(viscosity);
    for (int i = 0; i < n; ++i) sum[i] = 0.0;
    for (std::size_t m = 0; m < volume.size(); ++m) {
      const double* __restrict V = row(volume[m]);
      const double* __restrict mu = row(own, static_cast<int>(m));
      for (int i = 0; i < n; ++i) sum[i] += V[i] * mu[i];
    }
  });
}

void add_total(TaskList& list, const FrictionInput& v, int effect) {
  TaskBuilder task = list.task("total viscosity", effect);
  const In molecular = task.read(v.mixture.molecular_viscosity), eddy = task.read(v.eddy_viscosity);
  const Out viscosity = task.write(v.mixture.viscosity);
  task.kernel([=](const Row& row) {
    const double* __restrict mu = row(molecular);
    const double* __restrict mu_t = row(eddy);
    double* __restrict total = row(viscosity);
    for (int i = 0; i < row.count(); ++i) total[i] = mu[i] + mu_t[i];
  });
}

// All fields of viscosity that the step needs.
void add_viscosity(TaskList& list, const FrictionInput& v, const SchemeOptions& o, int effect,
                   int turbulence_effect) {
  const ViscousStressInput& c = v.mixture;
  const bool turbulent = o.transport.models.turbulence.has_value();
  const VariableId molecular = turbulent ? c.molecular_viscosity : c.viscosity;
  if (o.own_viscosity_varies()) {
    add_own_viscosities(list, v.of_each, o, effect);
    add_shares_of_fields(list, v.of_each, molecular, effect);
    add_shares(list, v.of_each, usual_viscosities(o), "viscosity of fronts", v.front_viscosity,
               effect);
  } else {
    add_shares(list, v.of_each, o.transport.viscosities, "viscosity of the mixture", molecular,
               effect);
  }
  if (!turbulent) return;
  add_eddy_viscosity({list, o, turbulence_effect, ""}, {c.rho, v.energy, c.velocity},
                     v.eddy_viscosity);
  add_total(list, v, turbulence_effect);
}

}  // namespace

void add_own_viscosities(TaskList& list, const OwnViscosityInput& v, const SchemeOptions& o,
                         int effect) {
  TaskBuilder task = list.task("viscosity of each material", effect);
  const StateReads state = read_state(task, v.state);
  const In presence = task.read(v.presence);
  const Out viscosity = task.write(v.own_viscosity);
  const Out own = task.write(list.temporary("density and energy of a viscous material", 2));
  std::vector<MolecularViscosity> viscous;
  for (std::size_t m = 0; m < o.materials.fluids.size(); ++m)
    viscous.push_back(
        {o.transport.models_of_each[m], o.transport.viscosities[m], o.grid.axes.direction[0]});
  const LawsOfCells laws(task, list, o);
  task.kernel([=](const Row& row) {
    for (int m = 0; m < static_cast<int>(viscous.size()); ++m)
      std::fill_n(row(viscosity, m), row.count(), 0.0);
    for_each_run(runs_of(row, presence), row.count(), [&](int first, int count, double set) {
      const Row part = row.part(first, count);
      for_each_of(as_set(set), [&](int m) {
        double* __restrict r = part(own, 0);
        double* __restrict e = part(own, 1);
        state.divide(part, m, r, e);
        viscous[m](part, laws.of(part, m), r, e, part(viscosity, m));
      });
    });
  });
}

void add_friction(TaskList& list, const FrictionInput& v, const SchemeOptions& o) {
  if (!o.transport.viscous) return;
  add_viscosity(list, v, o, effect_viscosity, effect_turbulence);
  // With velocities of their own slip follows later: multi_velocity/stress.cpp.
  if (!o.materials.multi_velocity_exchange || o.materials.multi_velocity)
    return add_viscous_stress(list, v.mixture, o, effect_viscosity);
  ViscousStressInput raw = v.mixture;
  for (int a = 0; a < o.grid.axes.count; ++a)
    raw.stress[a] = list.temporary("stress without slip of axis " + std::to_string(a),
                                   o.grid.components, o.grid.axes.direction[a]);
  add_viscous_stress(list, raw, o, effect_viscosity);
  add_slip_of_friction(list, v, o, raw.stress, effect_momentum_exchange);
}

}  // namespace sluice::ice::mixture
