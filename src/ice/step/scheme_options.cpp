// From the settings of a deck to those of the scheme.
#include "ice/step/scheme_options.hpp"

#include "framework/refine/face_table.hpp"
#include "ice/deck/ice_scene.hpp"
#include "ice/deck/transport_settings.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/step/variables.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice::ice {

namespace {

GridOptions grid_options(const Scene& scene) {
  const Level& level = scene.grid.levels.front();
  GridOptions g;
  g.axes = active_axes(level);
  g.components = 0;
  for (int a = 0; a < g.axes.count; ++a) g.direction[g.components++] = g.axes.direction[a];
  for (int d = 0; d < 3; ++d)
    if (scene.directions[d].velocity == VelocityComponent::carried) g.direction[g.components++] = d;
  g.domain = level.domain;
  g.periodic = level.periodic;
  return g;
}

// As the fluids are counted; none where a solid, which decks count first, has the surface.
std::optional<ConvectiveExchange> among_fluids(std::optional<ConvectiveExchange> of, int solids) {
  if (!of || of->fluid < solids || of->solid < solids) return {};
  of->fluid -= solids;
  of->solid -= solids;
  return of;
}

MaterialOptions material_options(const IceScene& ice) {
  MaterialOptions m;
  m.fluid = ice.materials.front().fluid;
  for (const IceMaterial& each : ice.materials) m.fluids.push_back(each.fluid);
  m.scalars = ice.models.scalars;
  m.heat_exchange = ice.exchange.heat;
  m.multi_velocity = !ice.one_velocity();
  m.drag = ice.exchange.momentum;
  if (ice.materials.size() > 1) {
    if (ice.exchange.slip && ice.exchange.slip->use_slip_coefficients)
      m.multi_velocity_exchange = ice.exchange.slip;
    m.convective = among_fluids(ice.exchange.convective, ice.solids);
  }
  if (ice.models.mixed) {
    const models::MixedGas& gas = *ice.models.mixed;
    m.mixed = &gas;
    m.releases_heat = gas.releases_heat();
    Fluid& fluid = m.fluids[gas.material];
    fluid = ideal_gas(gas.highest_gamma(), gas.lowest_specific_heat());
    if (m.fluids.size() == 1) m.fluid = fluid;
  }
  return m;
}

MethodOptions method_options(const Scene& scene, const IceScene& ice) {
  MethodOptions s;
  s.internal_energy_form = ice.internal_energy_form;
  s.implicit = ice.implicit.has_value();
  s.second_order = ice.second_order;
  s.third_order = ice.third_order;
  s.shears_shocks = shears_shocks(scene, ice);
  s.compatible_fluxes = ice.compatible_fluxes;
  s.cfl = ice.courant_number(scene);
  s.sound_speed_factor = ice.sound_speed_factor;
  s.diffusion_factor = ice.diffusion_factor;
  s.conservative_time_step = ice.conservative_time_step;
  if (ice.models.mixed) s.density_bound = FaceDensityLimiter::as_energy;
  return s;
}

ForceOptions force_options(const Scene& scene, const IceScene& ice) {
  ForceOptions f;
  f.gravity = scene.constants.gravity;
  f.driving = ice.driving_force.force;
  f.driving_on = ice.driving_force.on();
  f.on = !(f.gravity == Vec3{}) || f.driving_on;
  return f;
}

// `o` has its materials: what passes between them is conducted too.
TransportOptions transport_options(const IceScene& ice, const Level& level,
                                   const SchemeOptions& o) {
  TransportOptions t;
  for (const IceMaterial& each : ice.materials) {
    t.viscosities.push_back(each.viscosity);
    t.conductivities.push_back(each.conductivity);
    t.viscous = t.viscous || each.viscous();
    t.conducting = t.conducting || each.conductivity > 0;
  }
  t.viscosity = t.viscosities.front();
  t.conductivity = t.conductivities.front();
  t.models_of_each = transport_models(ice, level);
  t.models = t.models_of_each.front();
  t.viscosity_varies = t.models.molecular_varies() || ice.turbulence;
  t.conducting = t.conducting || ice.turbulence || o.materials.convective;
  t.conductivity_varies = ice.turbulence.has_value();
  if (!ice.models.mixed) return t;
  const models::MixedGas& gas = *ice.models.mixed;
  // What spreads of the fractions carries enthalpy.
  t.spreads_species = gas.species && gas.species->diffuses;
  if (t.spreads_species) t.viscous = t.viscosity_varies = true;
  t.conducting = t.conducting || t.spreads_species || fraction_of(o).diffusivity > 0;
  const bool several = o.materials.fluids.size() > 1;
  const bool conducts = several ? t.conductivities[gas.material] > 0 : t.conducting;
  t.conductivity_varies = t.conductivity_varies || (gas.species ? t.spreads_species : conducts);
  return t;
}

// `o` has its materials and forces, which are summed up.
BudgetOptions budget_options(const Scene& scene, const SchemeOptions& o) {
  BudgetOptions a;
  const bool summed = o.forces.driving_on || (o.forces.on && scene.grid.levels.size() > 1);
  a.sums = summed ? StepSlots::sums_with_gravity : StepSlots::sums;
  return a;
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
  o.grid = grid_options(scene);
  o.materials = material_options(ice);
  o.scheme = method_options(scene, ice);
  o.forces = force_options(scene, ice);
  o.transport = transport_options(ice, scene.grid.levels.front(), o);
  o.budgets = budget_options(scene, o);
  return o;
}

void select_material(SchemeOptions& o, const IceScene& ice, int index) {
  MaterialOptions& m = o.materials;
  m.index = index;
  m.fluid = m.fluids[index];
  TransportOptions& t = o.transport;
  if (!is_mixed(o, index)) {
    m.mixed = nullptr;
    o.scheme.density_bound = FaceDensityLimiter::sharp;
    t.conductivity_varies = ice.turbulence.has_value();
  }
  if (m.fluids.size() == 1) return;
  t.models = t.models_of_each[index];
  t.viscosity = t.viscosities[index];
  t.viscous = ice.materials[index].viscous();
  t.viscosity_varies = t.models.molecular_varies() || ice.turbulence;
  t.conductivity = t.conductivities[index];
  t.conducting = t.conductivity > 0 || ice.turbulence;
}

void select_mixture(SchemeOptions& o) {
  o.materials.mixture = true;
  o.transport.viscosity_varies = o.transport.viscous;
}

}  // namespace sluice::ice
