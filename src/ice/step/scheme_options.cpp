// From the settings of a deck to those of the scheme.
#include "ice/step/scheme_options.hpp"

#include "framework/refine/face_table.hpp"
#include "ice/deck/transport_settings.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice::ice {

namespace {

void take_directions(const Scene& scene, SchemeOptions& o) {
  const Level& level = scene.grid.levels.front();
  o.axes = active_axes(level);
  o.components = 0;
  for (int a = 0; a < o.axes.count; ++a) o.direction[o.components++] = o.axes.direction[a];
  for (int d = 0; d < 3; ++d)
    if (scene.directions[d].velocity == VelocityComponent::carried) o.direction[o.components++] = d;
  o.domain = level.domain;
  o.periodic = level.periodic;
}

void take_exchange(const IceScene& ice, SchemeOptions& o) {
  o.heat_exchange = ice.exchange.heat;
  o.multi_velocity = !ice.one_velocity();
  o.drag = ice.exchange.momentum;
  if (ice.materials.size() < 2) return;
  if (ice.exchange.slip && ice.exchange.slip->use_slip_coefficients)
    o.multi_velocity_exchange = ice.exchange.slip;
  o.convective = ice.exchange.convective;
}

void take_forces(const Scene& scene, const IceScene& ice, SchemeOptions& o) {
  o.gravity = scene.constants.gravity;
  o.force = ice.driving_force.force;
  o.force_on = ice.driving_force.on();
  o.gravity_on = !(o.gravity == Vec3{}) || o.force_on;
  const bool summed = o.force_on || (o.gravity_on && scene.grid.levels.size() > 1);
  o.sums = summed ? StepSlots::sums_with_gravity : StepSlots::sums;
}

// After the exchange: what passes between materials is conducted too.
void take_friction_and_conduction(const IceScene& ice, const Level& level, SchemeOptions& o) {
  for (const IceMaterial& each : ice.materials) {
    o.viscosities.push_back(each.viscosity);
    o.conductivities.push_back(each.conductivity);
    o.viscous = o.viscous || each.viscous();
    o.conducting = o.conducting || each.conductivity > 0;
  }
  o.viscosity = o.viscosities.front();
  o.conductivity = o.conductivities.front();
  o.transports = transport_models(ice, level);
  o.transport = o.transports.front();
  o.viscosity_varies = o.transport.molecular_varies() || ice.turbulence;
  o.conducting = o.conducting || ice.turbulence || o.convective;
  o.conductivity_varies = ice.turbulence.has_value();
}

// Sets what the gas changes; `o` has the scalars and coefficients of the deck.
void take_mixed_gas(const models::MixedGas& gas, SchemeOptions& o) {
  o.mixed = &gas;
  o.releases_heat = gas.releases_heat();
  o.density_bound = DensityBound::as_energy;
  Fluid& fluid = o.fluids[gas.material];
  fluid = ideal_gas(gas.highest_gamma(), gas.lowest_specific_heat());
  if (o.fluids.size() == 1) o.fluid = fluid;
  // What spreads of the fractions carries enthalpy.
  o.spreads_species = gas.species && gas.species->diffuses;
  if (o.spreads_species) o.viscous = o.viscosity_varies = true;
  o.conducting = o.conducting || o.spreads_species || fraction_of(o).diffusivity > 0;
  const bool several = o.fluids.size() > 1;
  const bool conducts = several ? o.conductivities[gas.material] > 0 : o.conducting;
  o.conductivity_varies = o.conductivity_varies || (gas.species ? o.spreads_species : conducts);
}

}  // namespace

std::vector<TransportModels> transport_models(const IceScene& ice, const Level& level) {
  std::vector<TransportModels> all;
  for (const IceMaterial& m : ice.materials)
    all.push_back({m.viscosity_models.sutherland, sponge_cells(m.viscosity_models, level),
                   ice.turbulence, ice.wall_shear,
                   ice.models.mixed && !ice.models.mixed->species &&
                       ice.models.mixed->material == m.index && m.viscosity > 0});
  return all;
}

// With several materials or levels the accounts of fluxes do not hold what it exchanges: refused.
bool shears_shocks(const Scene& scene, const IceScene& ice) {
  return ice.shears_shocks && !ice.internal_energy_form && !ice.implicit &&
         active_axes(scene.grid.levels.front()).count > 1;
}

SchemeOptions scheme_options(const Scene& scene, const IceScene& ice) {
  SchemeOptions o;
  take_directions(scene, o);
  o.fluid = ice.materials.front().fluid;
  for (const IceMaterial& each : ice.materials) o.fluids.push_back(each.fluid);
  o.scalars = ice.models.scalars;
  take_exchange(ice, o);
  take_forces(scene, ice, o);
  take_friction_and_conduction(ice, scene.grid.levels.front(), o);
  o.first_source_sum = o.sums + static_cast<int>(o.fluids.size()) - 1;
  o.internal_energy_form = ice.internal_energy_form;
  o.implicit = ice.implicit.has_value();
  o.second_order = ice.second_order;
  o.shears_shocks = shears_shocks(scene, ice);
  o.compatible_fluxes = ice.compatible_fluxes;
  o.cfl = ice.cfl;
  o.sound_speed_factor = ice.sound_speed_factor;
  o.diffusion_factor = ice.diffusion_factor;
  o.conservative_time_step = ice.conservative_time_step;
  if (ice.models.mixed) take_mixed_gas(*ice.models.mixed, o);
  return o;
}

}  // namespace sluice::ice
