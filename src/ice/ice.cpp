// The time step of ICE, readable as a table; and what the run loop asks of the component.
#include "ice/ice.hpp"

#include <algorithm>
#include <cmath>

#include "ice/classic/classic.hpp"
#include "ice/initial_state.hpp"
#include "ice/labels.hpp"
#include "ice/refine/criteria.hpp"

namespace sluice::ice {
namespace {

SchemeOptions make_options(const Scene& scene, const IceScene& ice) {
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
  o.classic = ice.classic;
  o.second_order = ice.second_order;
  o.compatible_fluxes = ice.compatible_fluxes;
  o.sound_speed_knob = ice.sound_speed_knob;
  o.gravity = scene.constants.gravity;
  o.gravity_on = !(o.gravity == Vec3{});
  o.viscosity = m.viscosity;
  o.viscous = m.viscosity > 0;
  o.diffusion_knob = ice.diffusion_knob;
  o.conservative_time_step = ice.conservative_time_step;
  o.cfl = ice.cfl;
  o.domain = level.domain;
  o.periodic = level.periodic;
  return o;
}

}  // namespace

// One conservative step. Each line is a task (one for each axis where it says "faces" or "remap"),
// in the file of its name under conservative/; when it is absent is said there in its first line.
void Ice::declare_conservative(TaskList& list, const SchemeOptions& o) const {
  const SchemeVariables v = declare_conservative_variables(list, o);
  // task                    reads                              writes
  add_primitives(list, v, o, effect_flow);           // state                    u, p, c
  add_slopes(list, v, o, effect_second_order);       // u, p                     su, sp, P, UT
  add_faces(list, v, o, effect_flow);                // u, p, c, slopes          u_f, p_f
  add_viscous_stress(list, v, o, effect_viscosity);  // u                        t_f
  add_lagrangian(list, v, o, effect_flow);           // state, u_f, p_f, t_f     rho_L, E_L, v, E*
  add_remap_bases(list, v, o, effect_second_order);  // state, slopes, Lagrange  bases
  add_remap_fluxes(list, v, o, effect_flow);         // u_f, Lagrange, bases     F, G, U
  add_update(list, v, o, effect_flow);               // Lagrange, fluxes         new state, rates
  if (effects_.on(effect_boundary_account))
    add_boundary_account(list, v, o, effect_boundary_account);  // fluxes       sums
  add_gravity_account(list, v, o, effect_gravity);              // m, dp                    sums
  add_flux_record(list, v, o, effect_flux_record);  // fluxes                   face tables
  declare_step_outputs(list, v, o);                 // whatever a deck saves    outputs
}

Ice::Ice(const Scene& scene, IceScene ice_scene)
    : scene_(&scene),
      ice_(std::move(ice_scene)),
      effects_(find_effects(scene, ice_)),
      options_(make_options(scene, ice_)),
      transfer_(options_.components, options_.classic, matches_fluxes(scene, ice_)),
      estimates_(wanted_estimates(scene.refinement.errors)) {
  StateSlots slots;
  slots.mass = labels().mass;
  slots.momentum = labels().momentum;
  slots.energy = labels().energy;
  for (int c = 0; c < options_.components; ++c)
    slots.directions.push_back(options_.direction[static_cast<std::size_t>(c)]);
  for (int level = 0; level < static_cast<int>(scene.grid.levels.size()); ++level)
    boundary_.push_back(
        std::make_unique<BoundaryFill>(scene, ice_.materials.front(), slots, level));
}

SchemeOptions Ice::at_level(int level) const {
  SchemeOptions o = options_;
  o.domain = scene_->grid.levels[static_cast<std::size_t>(level)].domain;
  o.boundary = boundary_[static_cast<std::size_t>(level)].get();
  return o;
}

std::vector<SlotInfo> Ice::state_slots() const {
  const int ghosts = options_.classic ? classic_ghost_layers(options_) : 3;
  return {{labels().mass, 0, 1, ghosts},
          {labels().momentum, 0, options_.components, ghosts},
          {labels().energy, 0, 1, ghosts}};
}

std::vector<std::vector<Label>> Ice::checkpoint_labels() const {
  std::vector<Label> momentum;
  for (int c = 0; c < options_.components; ++c)
    momentum.push_back(
        labels().momentum_component[options_.direction[static_cast<std::size_t>(c)]]);
  return {{labels().mass}, momentum, {labels().energy}};
}

Label Ice::refine_flag() const {
  return labels().refine_flag;
}

Label Ice::mask_label() const {
  return labels().mask;
}

void Ice::initialise(Warehouse& state) const {
  const IceMaterial& m = ice_.materials.front();
  const int mass = state.find(labels().mass, 0), momentum = state.find(labels().momentum, 0),
            energy = state.find(labels().energy, 0);
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const IndexBox cells = state.local_boxes()[static_cast<std::size_t>(b)].cells;
    const PrimitiveFill fill = fill_primitives(ice_, scene_->constants, m,
                                               scene_->grid.levels.front(), state.level(), cells);
    std::size_t n = 0;
    for_each_cell(cells, [&](IntVec3 cell) {
      state.view(mass, 0, b)(cell) = fill.density[n];
      state.view(energy, 0, b)(cell) =
          m.fluid.energy_from_pressure(fill.density[n], fill.pressure[n], fill.temperature[n]);
      for (int c = 0; c < options_.components; ++c)
        state.view(momentum, c, b)(cell) =
            fill.density[n] * fill.velocity[options_.direction[static_cast<std::size_t>(c)]][n];
      ++n;
    });
  }
}

void Ice::fill_boundary(Warehouse& state, double /*time*/, const ThreadTeam& team) const {
  const BoundaryFill& boundary = *boundary_[static_cast<std::size_t>(state.level().index)];
  boundary.fill(state, team);
  if (state.find(labels().mask, 0) >= 0) boundary.copy_outward(state, labels().mask, 0);
}

void Ice::declare_step(TaskList& list, const StepVariant& variant) const {
  SchemeOptions o = at_level(variant.level);
  o.masked = variant.masked;
  o.coverage = variant.coverage;
  o.recorder = transfer_.flux_quantities() > 0 ? variant.recorder : nullptr;
  if (o.classic)
    declare_classic(list, o, effects_);
  else
    declare_conservative(list, o);
}

void Ice::declare_diagnostics(TaskList& list, int level) const {
  declare_diagnostic_outputs(list, at_level(level), ice_, estimates_);
}

int Ice::reduction_sums() const {
  return options_.gravity_on && scene_->grid.levels.size() > 1 ? StepSlots::sums_with_gravity
                                                               : StepSlots::sums;
}

bool Ice::quiet_blocks_allowed() const {
  return !options_.gravity_on;
}

void Ice::measure_rates(const Warehouse& state, Reductions& rates) const {
  const int mass = state.find(labels().mass, 0), momentum = state.find(labels().momentum, 0),
            energy = state.find(labels().energy, 0);
  double dx_g = 0;
  for (int a = 0; a < options_.axes.count; ++a) {
    const int d = options_.axes.direction[a];
    dx_g += state.level().spacing[d] * std::fabs(options_.gravity[d]);
  }
  const double gravity_speed = std::sqrt(dx_g);
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView r = state.view(mass, 0, b), E = state.view(energy, 0, b);
    for_each_cell(state.local_boxes()[static_cast<std::size_t>(b)].cells, [&](IntVec3 cell) {
      const double rho = r(cell);
      const double c = options_.fluid.sound_speed(rho, options_.fluid.pressure(rho, E(cell)));
      double deck = 0, outflow = 0, flow = 0, sound = 0;
      for (int a = 0; a < options_.axes.count; ++a) {
        const double dx = state.level().spacing[options_.axes.direction[a]];
        const double u = std::fabs(state.view(momentum, a, b)(cell)) / rho;
        const double margin = options_.sound_speed_knob * c + gravity_speed;
        outflow += (std::max(0.0, u + margin) + std::max(0.0, margin - u)) / dx;
        const double deck_rate = (u + options_.sound_speed_knob * c) / dx;
        deck = std::max(deck, deck_rate);
        flow += u / dx;
        sound = std::max(sound, (u + c) / dx);
      }
      const double rate = options_.conservative_time_step ? outflow : deck;
      rates.maximum(StepSlots::deck_rate, ordered_bits(rate));
      rates.maximum(StepSlots::flow_rate, ordered_bits(flow));
      rates.maximum(StepSlots::sound_rate, ordered_bits(sound));
      if (!options_.viscous) return;
      double inverse_dx2 = 0;
      for (int a = 0; a < options_.axes.count; ++a) {
        const double dx = state.level().spacing[options_.axes.direction[a]];
        inverse_dx2 += 1.0 / (dx * dx);
      }
      rates.maximum(
          StepSlots::diffusion_rate,
          ordered_bits(2.0 * options_.diffusion_knob * options_.viscosity * inverse_dx2 / rho));
    });
  }
}

StepLimit Ice::step_limit(const std::vector<double>& maxima) const {
  constexpr double flow_share = 0.9;
  const double sound_share = options_.classic ? classic_sound_share(options_.axes.count) : 0.8;
  StepLimit limit{options_.cfl / maxima[StepSlots::deck_rate], options_.conservative_time_step
                                                                   ? "deck: conservative rule"
                                                                   : "deck: cfl dx/(|u| + knob c)"};
  auto at_most = [&](double dt, const char* reason) {
    if (dt < limit.dt) limit = {dt, reason};
  };
  at_most(flow_share / maxima[StepSlots::flow_rate], "scheme: 0.9/sum |u|/dx");
  at_most(sound_share / maxima[StepSlots::sound_rate],
          options_.classic ? "scheme: 0.98/sqrt(2 axes) dx/(|u| + c)" : "scheme: 0.8 dx/(|u| + c)");
  at_most(options_.cfl / maxima[StepSlots::diffusion_rate], "deck: cfl rho/(2 knob mu sum 1/dx^2)");
  return limit;
}

std::string Ice::describe_fault(int kind) const {
  switch (kind) {
    case fault_density:
      return "density (kg/m^3, must be above 0)";
    case fault_energy:
      return "internal energy per volume (J/m^3, must be above 0)";
    case fault_volume:
      return "relative volume after the Lagrangian phase (must be above 0)";
    case fault_outflow:
      return "share of a cell's volume that flows out in the step (must be below 1)";
    default:
      return "value";
  }
}

}  // namespace sluice::ice
