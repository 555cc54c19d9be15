// Molecular viscosity, and the sums of molecular and subgrid coefficients.
#include "ice/transport/viscosity.hpp"

#include <algorithm>
#include <cmath>

#include "ice/fluid/limiters.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/transport/species_transport.hpp"

namespace sluice::ice {
namespace {

void sponge_row(const Row& row, int direction, const TransportModels::Sponge& sponge, double* mu) {
  const IntVec3 first = row.cell();
  for (int d = 0; d < 3; ++d)
    if (d != direction && (first[d] < sponge.cells.lower[d] || first[d] >= sponge.cells.upper[d]))
      return;
  const int low = std::max(0, sponge.cells.lower[direction] - first[direction]);
  const int high = std::min(row.count(), sponge.cells.upper[direction] - first[direction]);
  for (int i = low; i < high; ++i) mu[i] = larger(mu[i], sponge.viscosity);
}

// The total viscosity, and k + cp mu_t/Pr_t.
void add_totals(const TransportTask& t, const TransportInput& v) {
  TaskBuilder task = t.list.task(t.name + "total viscosity", t.effect);
  const In eddy = task.read(v.eddy_viscosity), rho = task.read(v.rho), E = task.read(v.energy);
  const bool varies = t.options.molecular_varies();
  const In molecular = varies ? task.read(v.molecular_viscosity) : In{};
  const LawsOfCells laws(task, t.list, t.options);
  const Out viscosity = task.write(v.viscosity), conductivity = task.write(v.conductivity);
  task.kernel([=, o = t.options](const Row& row) {
    const int n = row.count();
    const double* __restrict mu_t = row(eddy);
    const double* __restrict mu = varies ? row(molecular) : nullptr;
    double* __restrict total = row(viscosity);
    for (int i = 0; i < n; ++i) total[i] = (varies ? mu[i] : o.transport.viscosity) + mu_t[i];
    laws.of_one(row).conductivity_with_eddies(n, o.transport.conductivity,
                                              o.transport.models.turbulence->prandtl, row(rho),
                                              row(E), mu_t, row(conductivity));
  });
}

}  // namespace

double filter_width(const SchemeOptions& o, Vec3 spacing) {
  double volume = 1;
  for (int a = 0; a < o.grid.axes.count; ++a) volume *= spacing[o.grid.axes.direction[a]];
  const double cell = o.grid.axes.count == 1   ? volume
                      : o.grid.axes.count == 2 ? std::sqrt(volume)
                                               : std::cbrt(volume);
  return o.transport.models.turbulence->filter_width * cell;
}

void MolecularViscosity::operator()(const Row& row, const LawRow& law, const double* rho,
                                    const double* energy, double* mu) const {
  const int n = row.count();
  if (models.sutherland) {
    law.temperature(n, rho, energy, mu);
    for (int i = 0; i < n; ++i) mu[i] = models.sutherland->viscosity(mu[i]);
  } else {
    law.viscosity(n, constant, mu);
  }
  for (const TransportModels::Sponge& sponge : models.sponges) sponge_row(row, along, sponge, mu);
}

void add_molecular_viscosity(const TransportTask& t, const StateVariables& state,
                             VariableId viscosity) {
  TaskBuilder task = t.list.task(t.name + "molecular viscosity", t.effect);
  const In rho = task.read(state.rho), E = task.read(state.energy);
  const Out out = task.write(viscosity);
  const SchemeOptions& o = t.options;
  const MolecularViscosity viscous{o.transport.models, o.transport.viscosity,
                                   o.grid.axes.direction[0]};
  const LawsOfCells laws(task, t.list, o);
  task.kernel([=](const Row& row) { viscous(row, laws.of_one(row), row(rho), row(E), row(out)); });
}

void add_transport(TaskList& list, const TransportInput& v, const SchemeOptions& o,
                   int viscosity_effect, int turbulence_effect) {
  if (o.transport.spreads_species) return add_species_transport(list, v, o, viscosity_effect);
  const bool turbulent = o.transport.models.turbulence.has_value();
  const StateVariables state{v.rho, v.energy, v.velocity};
  if (o.molecular_varies())
    add_molecular_viscosity({list, o, viscosity_effect, ""}, state,
                            turbulent ? v.molecular_viscosity : v.viscosity);
  if (!turbulent) return;
  const TransportTask task{list, o, turbulence_effect, ""};
  add_eddy_viscosity(task, state, v.eddy_viscosity);
  add_totals(task, v);
}

}  // namespace sluice::ice
