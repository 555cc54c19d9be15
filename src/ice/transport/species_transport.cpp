#include "ice/transport/species_transport.hpp"

#include <algorithm>
#include <memory>

#include "framework/base/lending_pool.hpp"
#include "ice/fluid/shared_mass.hpp"
#include "ice/fluid/species_rows.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "kinetics/transport.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice::ice {
namespace {

using kinetics::SpeciesGas;
using kinetics::Transport;

struct Handles {
  std::vector<In> fractions;
  In rho, energy;
  Out viscosity, conductivity, diffusivity;
};

void transport_row(const Row& row, const Handles& h, const SpeciesGas& gas, Transport& transport) {
  const double *rho = row(h.rho), *E = row(h.energy);
  double *mu = row(h.viscosity), *lambda = row(h.conductivity);
  double carried[models::max_species], Y[models::max_species + 1], D[models::max_species + 1];
  for (int i = 0; i < row.count(); ++i) {
    for (std::size_t k = 0; k < gas.carried(); ++k) carried[k] = row(h.fractions[k])[i];
    gas.all_fractions(carried, Y);
    const eos::Nasa7Heat heat = gas.heat([&](std::size_t k) { return carried[k]; });
    const double T = heat.temperature(E[i] / rho[i]);
    transport.set(T, Y);
    mu[i] = transport.viscosity();
    lambda[i] = transport.conductivity();
    if (h.diffusivity.index < 0) continue;
    transport.diffusion(rho[i] * heat.gas_constant * T, D);
    for (std::size_t k = 0; k < gas.carried(); ++k)
      row(h.diffusivity, static_cast<int>(k))[i] = D[gas.species_of(k)];
  }
}

void save_diffusivities(TaskList& list, VariableId diffusivity, const SchemeOptions& o) {
  int place = 0;
  for (const models::TransportedScalar* s : fractions_of(o)) {
    TaskBuilder task = list.task("save " + s->diffusion().name(), effect_saved_intermediates);
    const In in = task.read(diffusivity);
    const Out out = task.write(list.output(s->diffusion(), s->material));
    task.kernel([=](const Row& row) {
      const double* from = row(in, place);
      double* to = row(out);
      for (int i = 0; i < row.count(); ++i) to[i] = from[i];
    });
    ++place;
  }
}

}  // namespace

void add_species_coefficients(TaskBuilder task, TaskList& list, const SchemeOptions& o,
                              const SpeciesCoefficients& v) {
  Handles h;
  for (const models::TransportedScalar* f : fractions_of(o))
    h.fractions.push_back(task.read(list.old_state(f->state(), f->material, 1)));
  h.rho = task.read(v.rho);
  h.energy = task.read(v.energy);
  h.viscosity = task.write(v.viscosity);
  h.conductivity = task.write(v.conductivity);
  if (v.diffusivity.has_value()) h.diffusivity = task.write(*v.diffusivity);
  const std::shared_ptr<const SpeciesGas> gas = o.materials.mixed->species->gas;
  const auto pool =
      std::make_shared<LendingPool<Transport>>([gas] { return std::make_unique<Transport>(*gas); });
  task.kernel([=](const Row& row) {
    pool->lend([&](Transport& transport) { transport_row(row, h, *gas, transport); });
  });
}

void add_species_transport(TaskList& list, const TransportInput& v, const SchemeOptions& o,
                           int effect) {
  if (!o.transport.spreads_species) return;
  add_species_coefficients(list.task("transport of species", effect), list, o,
                           {v.rho, v.energy, v.viscosity, v.conductivity, v.diffusivity});
  save_diffusivities(list, v.diffusivity, o);
}

double species_coefficient(const SpeciesGas& gas, Transport& transport, double rho, double rho_e,
                           const FractionRows& rows) {
  double carried[models::max_species], Y[models::max_species + 1], D[models::max_species + 1];
  for (std::size_t k = 0; k < gas.carried(); ++k) carried[k] = *rows.of[k];
  gas.all_fractions(carried, Y);
  const eos::Nasa7Heat heat = blend(gas, rows, 0);
  const double T = heat.temperature(rho_e / rho);
  transport.set(T, Y);
  transport.diffusion(rho * heat.gas_constant * T, D);
  double most = std::max(transport.viscosity(), transport.conductivity() / heat.specific_heat(T));
  for (std::size_t k = 0; k < gas.carried(); ++k) most = std::max(most, rho * D[gas.species_of(k)]);
  return most;
}

SpeciesFluxHandles read_species_flux(TaskBuilder& task, TaskList& list, const SpeciesFluxInput& v,
                                     const SchemeOptions& o, int axis) {
  SpeciesFluxHandles h;
  if (!o.transport.spreads_species) return h;
  const Stencil both = Stencil::along(o.grid.axes.direction[axis], 1, 0);
  for (const models::TransportedScalar* f : fractions_of(o))
    h.fractions.push_back(task.read(list.old_state(f->state(), f->material, 1), both));
  h.mass = task.read(v.rho, both);
  h.diffusivity = task.read(v.diffusivity, both);
  return h;
}

void add_species_enthalpy(const Row& row, const SpeciesFluxHandles& h, In temperature,
                          const SchemeOptions& o, int axis, double* __restrict q) {
  if (h.fractions.empty()) return;
  const SpeciesGas& gas = *o.materials.mixed->species->gas;
  const double inverse = 1.0 / row.step().spacing[o.grid.axes.direction[axis]];
  const double *Ta = row(temperature, 0, axis, -1), *Tb = row(temperature);
  const double *Ma = row(h.mass, 0, axis, -1), *Mb = row(h.mass);
  for (std::size_t k = 0; k < h.fractions.size(); ++k) {
    const double *Ya = row(h.fractions[k], 0, axis, -1), *Yb = row(h.fractions[k]);
    const double* Da = row(h.diffusivity, static_cast<int>(k), axis, -1);
    const double* Db = row(h.diffusivity, static_cast<int>(k));
    for (int i = 0; i < row.count(); ++i) {
      const double flux =
          0.5 * (Da[i] + Db[i]) * shared_mass(Ma[i], Mb[i]) * (Ya[i] - Yb[i]) * inverse;
      if (flux == 0) continue;
      const double T = 0.5 * (Ta[i] + Tb[i]);
      q[i] += flux * (gas.sensible_enthalpy(gas.species_of(k), T) -
                      gas.sensible_enthalpy(gas.closure(), T));
    }
  }
}

}  // namespace sluice::ice
