// The time step of ICE, readable as a table; and what the run loop asks of the component.
#include "ice/ice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ice/account/rates.hpp"
#include "ice/account/step_limit.hpp"
#include "ice/account/totals.hpp"
#include "ice/classic/classic.hpp"
#include "ice/classic/variables.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/levels/interface_seeds.hpp"
#include "ice/levels/scalar_transfer.hpp"
#include "ice/mixture/slip.hpp"
#include "ice/mixture/surface.hpp"
#include "ice/one_material/leaving_shocks.hpp"
#include "ice/saved/criteria.hpp"
#include "ice/saved/step_labels.hpp"
#include "ice/scalars/heat_release.hpp"
#include "ice/scalars/variables.hpp"
#include "ice/start/initialise.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/step/mixed_fraction.hpp"
#include "ice/step/scheme_options.hpp"
#include "ice/tracers/tracers.hpp"
#include "ice/transport/viscosity.hpp"

namespace sluice::ice {
namespace {

std::unique_ptr<TransferOperators> make_transfer(const Scene& scene, const IceScene& ice,
                                                 const SchemeOptions& o) {
  const bool matches = matches_fluxes(scene, ice);
  std::unique_ptr<TransferOperators> flow;
  std::vector<std::size_t> by_volume;  // views of scalars
  const std::size_t materials = o.fluids.size();
  const auto components = static_cast<std::size_t>(o.components);
  const std::size_t views = components + (materials == 1 ? 2 : 3 * materials) +
                            (o.own_velocities ? materials * components : 0);
  for (std::size_t s = 0; s < ice.models.scalars.size(); ++s)
    if (ice.models.scalars[s].by_volume) by_volume.push_back(views + s);
  if (materials == 1)
    flow = std::make_unique<IceTransfer>(o.components, o.classic, matches, o.fluid, by_volume);
  else
    flow = std::make_unique<MixtureTransfer>(
        o.fluids, o.components, matches, o.own_velocities,
        by_volume.empty() ? MixedGasView{} : MixedGasView{o.mixed, by_volume.front()});
  if (ice.models.scalars.empty()) return flow;
  std::vector<std::size_t> mass;
  for (const models::TransportedScalar& s : ice.models.scalars)
    mass.push_back(static_cast<std::size_t>(s.material));
  return std::make_unique<scalars::ScalarTransfer>(std::move(flow), std::move(mass), views,
                                                   std::move(by_volume));
}

}  // namespace

// One conservative step. Each line is a task (one for each axis where it says "faces" or "remap"),
// in the file of its name under one_material/; when it is absent is said there in its first line.
void Ice::declare_conservative(TaskList& list, const SchemeOptions& o) const {
  SchemeVariables v = declare_conservative_variables(list, o);
  scalars::declare_variables(list, o, v, {std::span(&v.rho, 1), std::span(&v.rho_remap, 1), {}});
  // task                    reads                              writes
  add_primitives(list, v, o, effect_flow);      // state                    u, p, c
  add_slopes(list, v, o, effect_second_order);  // u, p                     su, sp, P, UT
  add_faces(list, v, o, effect_flow);           // u, p, c, slopes          u_f, p_f
  add_transport(list, v, o, effect_viscosity, effect_turbulence);  // rho, E, u  mu, k of cells
  add_viscous_stress(list, v, o, effect_viscosity);                // u                        t_f
  add_heat_flux(list, v, o, effect_conduction);      // rho, E                   T, q_f
  add_lagrangian(list, v, o, effect_flow);           // state, u_f, p_f, t_f, q  rho_L, E_L, v, E*
  add_remap_bases(list, v, o, effect_second_order);  // state, slopes, Lagrange  bases
  add_remap_fluxes(list, v, o, effect_flow);         // u_f, Lagrange, bases     F, G, U
  add_update(list, v, o, effect_flow);               // Lagrange, fluxes         new state, rates
  scalars::add_tasks(list, v, o, effect_scalars);    // u, u_f, F, 1/J, N        new scalars
  scalars::add_heat_release(list, v, o, effect_sources);  // f, q, remap         new state, rates
  if (effects_.on(effect_boundary_account))
    add_boundary_account(list, v, o, effect_boundary_account);  // fluxes       sums
  add_gravity_account(list, v, o, effect_of_forces(o));         // m, dp                    sums
  add_source_account(list, v, o, effect_sources);               // change                   sums
  add_volume_account(list, v, o, effect_diagnostics);           // fluxes, m, dp            sums
  add_flux_record(list, v, o, effect_flux_record);  // fluxes                   face tables
  declare_step_outputs(list, v, o, material_alone(list, v, o));  // whatever a deck saves  outputs
}

// The same where several materials may meet; the tasks of that name under mixture/, but for those
// of the mixture as a whole.
void Ice::declare_mixture(TaskList& list, const SchemeOptions& o) const {
  if (o.own_velocities) return declare_slip(list, o);
  mixture::Variables m = mixture::declare_variables(list, o);
  SchemeVariables& v = m.common;
  scalars::declare_variables(list, o, v, {m.mass, m.mass_remap, m.volume});
  // task                            reads                              writes
  mixture::add_primitives(list, m, o, effect_equilibration);   // state      who is where, u, p, c
  add_slopes(list, v, o, effect_second_order);                 // u, p       su, sp, P, UT
  add_faces(list, v, o, effect_flow);                          // slopes     u_f, p_f
  mixture::add_surface(list, m, o, effect_momentum_exchange);  // V_m       where gas slips
  mixture::add_friction(list, m, o);                           // V_m, T_m, u  mu, t_f
  mixture::add_heat_flux(list, m, o, effect_conduction);       // T_m        q_f, of each material
  mixture::add_transported_heat(list, m, o, o.conducting ? effect_conduction : effect_viscosity);
  mixture::add_lagrangian(list, m, o, effect_flow);             // u_f, p_f   E_mL, scales
  mixture::add_remap_bases(list, m, o, effect_second_order);    // Lagrange   bases
  mixture::add_remap_fluxes(list, m, o, effect_flow);           // bases      FV, FM, FE of each, U
  mixture::add_update(list, m, o, effect_equilibration);        // fluxes     new state, rates
  scalars::add_tasks(list, v, o, effect_scalars);               // u_f, fluxes  new scalars
  mixture::add_one_pressure(list, m, o, effect_equilibration);  // remap, f  new state, rates
  if (effects_.on(effect_boundary_account))
    add_boundary_account(list, v, o, effect_boundary_account);  // fluxes     sums
  add_gravity_account(list, v, o, effect_of_forces(o));         // m, dp      sums
  add_source_account(list, v, o, effect_sources);               // change     sums
  add_volume_account(list, v, o, effect_diagnostics);           // fluxes, dp sums
  add_flux_record(list, v, o, effect_flux_record);              // fluxes     face tables
  declare_step_outputs(list, v, o, mixture::materials_of_step(list, m, o));  // saved  outputs
}

// The same where each material has a velocity of its own: mixture/slip.hpp.
void Ice::declare_slip(TaskList& list, const SchemeOptions& o) const {
  mixture::Variables m = mixture::declare_variables(list, o);
  scalars::declare_variables(list, o, m.common, {m.mass, m.mass_new, m.volume});
  const SchemeVariables &v = m.common, &volume = m.slip.common;
  constexpr int slip = effect_momentum_exchange;
  // task                            reads                              writes
  mixture::add_primitives(list, m, o, effect_equilibration);  // state      who is where, u, p, c
  mixture::add_surface(list, m, o, slip);                     // V_m        where gas slips
  mixture::add_slip_motion(list, m, o, slip);                 // state      u_m, u, c of volume
  add_slopes(list, volume, o, effect_second_order);           // u, p       su, sp, P, UT
  add_faces(list, volume, o, effect_flow);                    // slopes     u_f, p_f
  mixture::add_friction(list, m, o);                          // V_m, T_m, u  mu, t_f
  mixture::add_slip_stress(list, m, o, effect_viscosity);     // u_m        t of each
  mixture::add_slip_phase(list, m, o, slip);                  // p_f        w_mL, drift, work
  mixture::add_heat_flux(list, m, o, effect_conduction);      // T_m        q_f, of each material
  mixture::add_transported_heat(list, m, o, o.conducting ? effect_conduction : effect_viscosity);
  mixture::add_lagrangian(list, m, o, effect_flow);            // u_f, p_f   E_mL, scales
  mixture::add_slip_faces(list, m, o, slip);                   // drift      u_fm, outflow
  mixture::add_remap_bases(list, m, o, effect_second_order);   // Lagrange   bases
  mixture::add_slip_bases(list, m, o, slip);                   // Lagrange   bases of u_m
  mixture::add_slip_fluxes(list, m, o, effect_flow);           // bases      FV, FM, FE, U of each
  mixture::add_slip_update(list, m, o, effect_equilibration);  // fluxes     new state, rates
  scalars::add_tasks(list, scalars::add_own_motion(list, m, o, effect_scalars), o, effect_scalars);
  if (effects_.on(effect_boundary_account))
    add_boundary_account(list, v, o, effect_boundary_account);  // fluxes     sums
  add_gravity_account(list, v, o, effect_of_forces(o));         // m, dp      sums
  mixture::add_slip_force_account(list, m, o, effect_of_forces(o));
  add_source_account(list, v, o, effect_sources);      // change     sums
  add_volume_account(list, v, o, effect_diagnostics);  // fluxes, dp sums
  add_flux_record(list, v, o, effect_flux_record);     // fluxes     face tables
  declare_step_outputs(list, v, o, mixture::materials_of_step(list, m, o));  // saved  outputs
}

Ice::Ice(const Scene& scene, IceScene ice_scene)
    : scene_(&scene),
      ice_(std::move(ice_scene)),
      effects_(find_effects(scene, ice_)),
      options_(scheme_options(scene, ice_)),
      transfer_(make_transfer(scene, ice_, options_)),
      estimates_(wanted_estimates(scene.refinement.errors)) {
  for (const models::TransportedScalar& s : ice_.models.scalars) s.declare_labels();
  StateSlots slots;
  slots.mass = labels().mass;
  slots.momentum = labels().momentum;
  slots.energy = labels().energy;
  if (material_count() > 1) slots.volume = labels().volume;
  if (options_.own_velocities) slots.slip = labels().slip;
  for (int c = 0; c < options_.components; ++c)
    slots.directions.push_back(options_.direction[static_cast<std::size_t>(c)]);
  for (int level = 0; level < static_cast<int>(scene.grid.levels.size()); ++level)
    boundary_.push_back(std::make_unique<BoundaryFill>(scene, std::span(ice_.materials), slots,
                                                       level, ice_.conditions, ice_.models.scalars,
                                                       options_.mixed));
  effects_.add(open_faces(ice_, *boundary_.front()));
  if (effects_.on(effect_tracers))
    tracers_ = std::make_unique<Tracers>(
        ice_.models.tracers, scene.grid, boundary_,
        FlowStorage{material_count(), slots.directions, options_.own_velocities},
        scene.time.max_time);
  if (!effects_.on(effect_sources)) return;
  for (const Level& level : scene.grid.levels)
    sources_.push_back(std::make_unique<Sources>(ice_.models, ice_.added_heat, options_.fluids,
                                                 level, options_.direction));
  options_.sources = sources_.front().get();
}

SchemeOptions Ice::at_level(int level) const {
  SchemeOptions o = options_;
  const Level& cells = scene_->grid.levels[static_cast<std::size_t>(level)];
  o.level = &cells;
  o.domain = cells.domain;
  o.transports = transport_models(ice_, cells);
  o.transport = o.transports.front();
  o.boundary = boundary_[static_cast<std::size_t>(level)].get();
  if (!sources_.empty()) o.sources = sources_[static_cast<std::size_t>(level)].get();
  return o;
}

// One material: mass, momentum, energy. Several: mass of each, one momentum, energy and volume of
// each.
std::vector<SlotInfo> Ice::state_slots() const {
  // LODI and slip each look one cell aside from the ghosts that they fill: slip into cells, LODI
  // into ghosts of slip and of LODI in other directions, and again where those meet. The dynamic
  // model filters twice. Materials with velocities of their own: what flows out of a donor follows
  // from faces of its neighbours, and interfaces are looked for around cells.
  const int waves = boundary_.front()->wave_directions();
  const int aside = waves + std::max(waves - 1, 0) + (ice_.conditions.slip ? 1 : 0);
  // Their friction follows what the dynamic model has filtered.
  const bool filtered = ice_.turbulence && ice_.turbulence->dynamic;
  const int around = options_.own_velocities ? (filtered ? 3 : 2) : filtered ? 2 : 0;
  const int ghosts = (options_.classic ? classic::ghost_layers(options_) : 3) + aside + around;
  std::vector<SlotInfo> slots;
  const auto of_each = [&](Label label) {
    for (int m = 0; m < material_count(); ++m) slots.push_back({label, m, 1, ghosts});
  };
  of_each(labels().mass);
  slots.push_back({labels().momentum, 0, options_.components, ghosts});
  of_each(labels().energy);
  if (material_count() > 1) of_each(labels().volume);
  if (options_.own_velocities)
    for (int m = 0; m < material_count(); ++m)
      slots.push_back({labels().slip, m, options_.components, ghosts});
  for (const models::TransportedScalar& s : ice_.models.scalars)
    slots.push_back({s.state(), s.material, 1, ghosts});
  return slots;
}

std::vector<std::vector<Label>> Ice::checkpoint_labels() const {
  std::vector<Label> momentum, slip;
  for (int c = 0; c < options_.components; ++c) {
    const int d = options_.direction[static_cast<std::size_t>(c)];
    momentum.push_back(labels().momentum_component[d]);
    slip.push_back(labels().slip_component[d]);
  }
  std::vector<std::vector<Label>> names;
  for (const SlotInfo& slot : state_slots())
    names.push_back(slot.label == labels().momentum ? momentum
                    : slot.label == labels().slip   ? slip
                                                    : std::vector{slot.label});
  return names;
}

Label Ice::refine_flag() const {
  return labels().refine_flag;
}

std::vector<FlagSeeds> Ice::flag_seeds(const Warehouse& state) const {
  return interface_seeds(state, material_count(), scene_->refinement.interfaces);
}

Label Ice::mask_label() const {
  return labels().mask;
}

void Ice::fill_boundary(Warehouse& state, double time, std::span<const double> sums,
                        const ThreadTeam& team) const {
  const BoundaryFill& boundary = *boundary_[static_cast<std::size_t>(state.level().index)];
  boundary.fill(state, team, time, sums);
}

int Ice::boundary_sums() const {
  return boundary_.front()->sum_count();
}

void Ice::add_boundary_sums(const Warehouse& state, std::span<ExactSum> sums) const {
  boundary_.front()->add_sums(state, sums);
}

void Ice::declare_step(TaskList& list, const StepVariant& variant) const {
  SchemeOptions o = at_level(variant.level);
  o.masked = variant.masked;
  o.coverage = variant.coverage;
  o.recorder = transfer_->flux_quantities() > 0 ? variant.recorder : nullptr;
  o.shocks_leave = o.recorder != nullptr && interface_depth(*o.level) != IntVec3{};
  o.volumes = variant.volumes;
  o.first_volume_sum = first_volume_sum();
  if (o.classic) return declare_classic(list, o, effects_);
  if (variant.kind == static_cast<int>(o.fluids.size())) {
    o.mixture = true;
    o.viscosity_varies = o.viscous;
    return declare_mixture(list, o);
  }
  o.material = variant.kind;
  const auto m = static_cast<std::size_t>(o.material);
  o.fluid = o.fluids[m];
  if (!is_mixed(o, m)) {
    o.mixed = nullptr;
    o.density_bound = DensityBound::sharp;
    o.conductivity_varies = ice_.turbulence.has_value();
  }
  if (o.fluids.size() > 1) {
    o.transport = o.transports[m];
    o.viscosity = o.viscosities[m];
    o.viscous = ice_.materials[m].viscous();
    o.viscosity_varies = o.transport.molecular_varies() || ice_.turbulence;
    o.conductivity = o.conductivities[m];
    o.conducting = o.conductivity > 0 || ice_.turbulence;
  }
  declare_conservative(list, o);
}

// A block with one material alone needs the graph of that material only.
int Ice::step_kinds() const {
  return material_count() == 1 ? 1 : material_count() + 1;
}

int Ice::step_kind(const Warehouse& old_state, int local_box,
                   const IndexBox& cells_with_halo) const {
  const int mixed = material_count();
  if (mixed == 1) return 0;
  int only = -1;
  for (int m = 0; m < mixed; ++m) {
    const int slot = old_state.find(labels().mass, m);
    if (!old_state.any_nonzero(slot, 0, local_box, cells_with_halo)) continue;
    if (only >= 0) return mixed;
    only = m;
  }
  // A source may bring others in.
  if (only >= 0 && !sources_.empty() && sources_.front()->takes_from(only)) return mixed;
  return only >= 0 ? only : mixed;
}

std::optional<double> Ice::absent_value(Label label, int material, int kind) const {
  return label == labels().volume && material == kind ? 1.0 : 0.0;
}

void Ice::declare_diagnostics(TaskList& list, int level) const {
  declare_diagnostic_outputs(list, at_level(level), ice_.criteria, estimates_);
}

int Ice::step_sums() const {
  return options_.first_source_sum + (sources_.empty() ? 0 : SourceSums::count(material_count()));
}

int Ice::first_volume_sum() const {
  return step_sums();
}

int Ice::reduction_sums() const {
  const VolumeSums of_volumes(first_volume_sum(), material_count());
  return step_sums() + of_volumes.count(static_cast<int>(control_volumes(scene_->analysis).size()));
}

bool Ice::diffusive() const {
  return ice::diffusive(options_);
}

void Ice::initialise(Warehouse& state) const {
  ice::initialise(state, *scene_, ice_, options_);
}

void Ice::measure_rates(const Warehouse& state, Reductions& rates) const {
  ice::measure_rates(state, at_level(state.level().index), rates);
}

StepLimit Ice::step_limit(const std::vector<double>& maxima) const {
  return ice::step_limit(options_, maxima);
}

void Ice::add_totals(const Warehouse& state, const LevelCoverage& coverage, Totals& totals) const {
  ice::add_totals(state, coverage, options_, totals);
}

StepBalance Ice::balance(const std::vector<double>& sums, const StepStart* start, double dt) const {
  return ice::balance(options_, sums, start, dt);
}

std::vector<std::string> Ice::tally_names() const {
  return ice::tally_names(options_);
}

std::vector<double> Ice::tallies(const std::vector<double>& sums) const {
  return ice::tallies(options_, sums);
}

double Ice::history_value(Label label, const Totals& totals) const {
  return ice::history_value(options_, label, totals);
}

Vec3 Ice::history_vector(Label label, const Totals& totals) const {
  return ice::history_vector(label, totals);
}

// What passes through a control volume's side must be counted in uniform flow as well. Materials
// that exchange heat change where nothing flows; so may those that a finer level left at pressures
// of their own.
bool Ice::quiet_blocks_allowed() const {
  if (material_count() > 1 &&
      (options_.heat_exchange.any() || options_.own_velocities || scene_->grid.levels.size() > 1))
    return false;
  for (const models::TransportedScalar& s : ice_.models.scalars)
    if (s.grows()) return false;
  return !options_.gravity_on && sources_.empty() && control_volumes(scene_->analysis).empty();
}

// Shocks do not leave levels that follow them.
IntVec3 Ice::interface_depth(const Level& level) const {
  const RefinementSettings& r = scene_->refinement;
  const bool follow =
      r.adaptive && !r.once && !(ice_.criteria.empty() && r.errors.empty() && r.interfaces.empty());
  if (options_.classic || !options_.second_order || follow) return {};
  return leaving_depth(level);
}

std::string Ice::describe_fault(int kind) const {
  if (kind >= fault_of_material) {
    const auto m = static_cast<std::size_t>(kind / fault_of_material - 1);
    return fmt::format(
        "energy of material {} ('{}', J/m^3 of the cell; with its mass and volume it must be a "
        "state of its law: pressure above {:g} Pa, sound speed squared above 0)",
        m, ice_.materials[m].name, ice_.materials[m].fluid.lowest_pressure());
  }
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
