// From the settings of a deck to those of the scheme.
#include "ice/scheme_options.hpp"

#include "ice/scalars/mixed_gas.hpp"
#include "ice/transport/settings.hpp"

namespace sluice::ice {

std::vector<TransportModels> transport_models(const IceScene& ice, const Level& level) {
  std::vector<TransportModels> all;
  for (const IceMaterial& m : ice.materials)
    all.push_back({m.viscosity_models.sutherland, sponge_cells(m.viscosity_models, level),
                   ice.turbulence, ice.wall_shear, ice.models.mixed && m.viscosity > 0});
  return all;
}

SchemeOptions scheme_options(const Scene& scene, const IceScene& ice) {
  const Level& level = scene.grid.levels.front();
  SchemeOptions o;
  o.axes.count = 0;
  o.components = 0;
  for (int d = 0; d < 3; ++d)
    if (level.active[static_cast<std::size_t>(d)]) {
      o.axes.direction[o.axes.count++] = d;
      o.direction[static_cast<std::size_t>(o.components++)] = d;
    }
  for (int d = 0; d < 3; ++d)
    if (scene.directions[static_cast<std::size_t>(d)].velocity == VelocityComponent::carried)
      o.direction[static_cast<std::size_t>(o.components++)] = d;
  const IceMaterial& m = ice.materials.front();
  o.fluid = m.fluid;
  for (const IceMaterial& each : ice.materials) o.fluids.push_back(each.fluid);
  o.heat_exchange = ice.exchange.heat;
  o.own_velocities = !ice.one_velocity();
  o.drag = ice.exchange.momentum;
  if (ice.materials.size() > 1) {
    if (ice.exchange.slip && ice.exchange.slip->use_slip_coefficients)
      o.slip_exchange = ice.exchange.slip;
    o.convective = ice.exchange.convective;
  }
  o.classic = ice.classic;
  o.second_order = ice.second_order;
  o.compatible_fluxes = ice.compatible_fluxes;
  o.sound_speed_knob = ice.sound_speed_knob;
  o.gravity = scene.constants.gravity;
  o.force = ice.driving_force.force;
  o.force_on = ice.driving_force.on();
  o.gravity_on = !(o.gravity == Vec3{}) || o.force_on;
  for (const IceMaterial& each : ice.materials) {
    o.viscosities.push_back(each.viscosity);
    o.conductivities.push_back(each.conductivity);
    o.viscous = o.viscous || each.viscous();
    o.conducting = o.conducting || each.conductivity > 0;
  }
  o.viscosity = m.viscosity;
  o.conductivity = m.conductivity;
  o.transports = transport_models(ice, level);
  o.transport = o.transports.front();
  o.diffusion_knob = ice.diffusion_knob;
  o.conservative_time_step = ice.conservative_time_step;
  o.cfl = ice.cfl;
  o.scalars = ice.models.scalars;
  o.viscosity_varies = o.transport.molecular_varies() || ice.turbulence;
  o.conducting = o.conducting || ice.turbulence || o.convective;
  o.conductivity_varies = ice.turbulence.has_value();
  if (ice.models.mixed) scalars::take_mixed_gas(*ice.models.mixed, o);
  o.domain = level.domain;
  o.periodic = level.periodic;
  const bool summed = o.force_on || (o.gravity_on && scene.grid.levels.size() > 1);
  o.sums = summed ? StepSlots::sums_with_gravity : StepSlots::sums;
  return o;
}

}  // namespace sluice::ice
