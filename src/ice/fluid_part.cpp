#include "ice/fluid_part.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ice/fluid/labels.hpp"
#include "ice/internal_energy_form/variables.hpp"
#include "ice/levels/interface_seeds.hpp"
#include "ice/levels/mixture_transfer.hpp"
#include "ice/levels/offset_transfer.hpp"
#include "ice/levels/scalar_transfer.hpp"
#include "ice/one_material/leaving_shocks.hpp"
#include "ice/outputs/criteria.hpp"
#include "ice/pressure/finer_faces.hpp"
#include "ice/pressure/pressure_solve.hpp"
#include "ice/sources/source_tasks.hpp"
#include "ice/start/initialise.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/step/laws_of_cells.hpp"
#include "ice/step/scheme_options.hpp"
#include "ice/step_tables.hpp"
#include "ice/tracers/tracers.hpp"

namespace sluice::ice {
namespace {

std::unique_ptr<TransferOperators> make_flow_transfer(const Scene& scene, const IceScene& ice,
                                                      const SchemeOptions& o,
                                                      const std::vector<SlotInfo>& slots) {
  const bool matches = matches_fluxes(scene, ice);
  std::unique_ptr<TransferOperators> flow;
  std::vector<std::size_t> by_volume;  // views of scalars
  const std::size_t materials = o.materials.fluids.size();
  std::size_t views = 0;  // of the flow: the components of its slots, which scalars follow
  const std::size_t beside =
      ice.models.scalars.size() + (o.scheme.implicit ? 1 : 0) + (ice.solids > 0 ? 1 : 0);
  for (std::size_t s = 0; s + beside < slots.size(); ++s) views += slots[s].components;
  for (std::size_t s = 0; s < ice.models.scalars.size(); ++s)
    if (ice.models.scalars[s].by_volume) by_volume.push_back(views + s);
  if (materials == 1)
    flow = std::make_unique<IceTransfer>(o.grid.components, o.scheme.internal_energy_form, matches,
                                         o.materials.fluid, by_volume);
  else
    flow = std::make_unique<MixtureTransfer>(
        o.materials.fluids, o.grid.components, matches, o.materials.multi_velocity,
        by_volume.empty() ? MixedGasView{} : MixedGasView{o.materials.mixed, by_volume.front()});
  if (ice.models.scalars.empty()) return flow;
  std::vector<std::size_t> mass;
  for (const models::TransportedScalar& s : ice.models.scalars) mass.push_back(s.material);
  return std::make_unique<scalars::ScalarTransfer>(std::move(flow), std::move(mass), views,
                                                   std::move(by_volume));
}

std::unique_ptr<TransferOperators> make_transfer(const Scene& scene, const IceScene& ice,
                                                 const SchemeOptions& o,
                                                 const std::vector<SlotInfo>& slots) {
  auto flow = make_flow_transfer(scene, ice, o, slots);
  if (o.scheme.implicit) flow = std::make_unique<OffsetTransfer>(std::move(flow));
  if (ice.solids > 0) flow = std::make_unique<OffsetTransfer>(std::move(flow));  // theta
  return flow;
}

}  // namespace

FluidPart::FluidPart(const Scene& scene, IceScene ice_scene, IndexOffsets places)
    : scene_(&scene),
      ice_(std::move(ice_scene)),
      effects_(find_effects(scene, ice_)),
      options_(scheme_options(scene, ice_)),
      estimates_(wanted_estimates(scene.refinement.errors)) {
  for (const models::TransportedScalar& s : ice_.models.scalars) s.declare_labels();
  options_.accounts.places = std::move(places);
  StateSlots slots;
  slots.places = options_.accounts.places;
  slots.mass = labels().mass;
  slots.momentum = labels().momentum;
  slots.energy = labels().energy;
  if (material_count() > 1) slots.volume = labels().volume;
  if (options_.materials.multi_velocity) slots.slip = labels().slip;
  if (options_.scheme.implicit) slots.offset = labels().pressure_offset;
  for (int c = 0; c < options_.grid.components; ++c)
    slots.directions.push_back(options_.grid.direction[c]);
  for (int level = 0; level < static_cast<int>(scene.grid.levels.size()); ++level)
    boundary_.push_back(std::make_unique<BoundaryFill>(scene, std::span(ice_.materials), slots,
                                                       level, ice_.conditions, ice_.models.scalars,
                                                       options_.materials.mixed));
  effects_.add(open_faces(ice_, *boundary_.front()));
  if (ice_.solids > 0)
    effects_.add(
        {"solids in the flow", true,
         "cells cut by solids and faces that they cover; separated particles continue as blocks",
         ice_.materials.front().where});
  if (effects_.on(effect_tracers))
    tracers_ = std::make_unique<Tracers>(
        ice_.models.tracers, ice_.models.scalars, scene.grid, boundary_,
        FlowStorage{material_count(), slots.directions, options_.materials.multi_velocity,
                    options_.accounts.places, ice_.solids > 0},
        scene.time.max_time);
  transfer_ = make_transfer(scene, ice_, options_, state_slots());
  if (!effects_.on(effect_sources)) return;
  for (const Level& level : scene.grid.levels)
    sources_.push_back(std::make_unique<Sources>(
        ice_.models, ice_.added_heat, options_.materials.fluids, level, options_.grid.direction));
  options_.forces.sources = sources_.front().get();
}

SchemeOptions FluidPart::at_level(int level) const {
  SchemeOptions o = options_;
  const Level& cells = scene_->grid.levels[level];
  o.grid.level = &cells;
  o.grid.domain = cells.domain;
  o.transport.models_of_each = transport_models(ice_, cells);
  o.transport.models = o.transport.models_of_each.front();
  o.grid.boundary = boundary_[level].get();
  if (!sources_.empty()) o.forces.sources = sources_[level].get();
  return o;
}

// One material: mass, momentum, energy. Several: mass of each, one momentum, energy and volume of
// each.
std::vector<SlotInfo> FluidPart::state_slots() const {
  // LODI and slip each look one cell aside from the ghosts that they fill: slip into cells, LODI
  // into ghosts of slip and of LODI in other directions, and again where those meet. The dynamic
  // model filters twice. Materials with velocities of their own: what flows out of a donor follows
  // from faces of its neighbours, and interfaces are looked for around cells.
  const int waves = boundary_.front()->wave_directions();
  const int aside = waves + std::max(waves - 1, 0) + (ice_.conditions.slip ? 1 : 0);
  // Their friction follows what the dynamic model has filtered.
  const bool filtered = ice_.turbulence && ice_.turbulence->dynamic;
  const int around = options_.materials.multi_velocity ? (filtered ? 3 : 2) : filtered ? 2 : 0;
  // Slopes of the semi-implicit step reach one cell further.
  const int own = options_.scheme.internal_energy_form
                      ? internal_energy_form::ghost_layers(options_)
                  : options_.scheme.implicit ? 4
                                             : 3;
  // What cells without fluid close to is known of their neighbours' neighbours, and of several
  // fluids what they pass on is what the neighbours give.
  const int closing = ice_.solids == 0 ? 0 : material_count() == 1 ? 1 : 2;
  const int ghosts = own + aside + around + closing;
  std::vector<SlotInfo> slots;
  const auto of_each = [&](Label label) {
    for (int m = 0; m < material_count(); ++m)
      slots.push_back({label, options_.place(m), 1, ghosts});
  };
  of_each(labels().mass);
  slots.push_back({labels().momentum, options_.place(0), options_.grid.components, ghosts});
  of_each(labels().energy);
  if (material_count() > 1) of_each(labels().volume);
  if (options_.materials.multi_velocity)
    for (int m = 0; m < material_count(); ++m)
      slots.push_back({labels().slip, options_.place(m), options_.grid.components, ghosts});
  for (const models::TransportedScalar& s : ice_.models.scalars)
    slots.push_back({s.state(), options_.place(s.material), 1, ghosts});
  if (options_.scheme.implicit)
    slots.push_back({labels().pressure_offset, options_.place(0), 1, ghosts});
  if (ice_.solids > 0) slots.push_back({labels().solid_fraction, options_.place(0), 1, ghosts});
  return slots;
}

std::vector<std::vector<Label>> FluidPart::checkpoint_labels() const {
  std::vector<Label> momentum, slip;
  for (int c = 0; c < options_.grid.components; ++c) {
    const int d = options_.grid.direction[c];
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

std::vector<FlagSeeds> FluidPart::flag_seeds(const Warehouse& state) const {
  std::vector<int> numbers;
  for (int m = 0; m < material_count(); ++m) numbers.push_back(options_.place(m));
  return interface_seeds(state, numbers, scene_->refinement.interfaces);
}

SchemeOptions FluidPart::graph_options(const StepVariant& variant) const {
  SchemeOptions o = at_level(variant.level);
  o.scheme.masked = variant.masked;
  o.accounts.coverage = variant.coverage;
  o.grid.meets_coarser = o.scheme.implicit && variant.level > 0;
  o.grid.meets_finer =
      o.scheme.implicit && variant.level + 1 < static_cast<int>(scene_->grid.levels.size());
  o.accounts.recorder = transfer_->flux_quantities() > 0 ? variant.recorder : nullptr;
  o.grid.shocks_leave =
      o.accounts.recorder != nullptr && interface_depth(*o.grid.level) != IntVec3{};
  o.accounts.volumes = variant.volumes;
  o.accounts.first_volume_sum = first_volume_sum();
  if (o.scheme.internal_energy_form) return o;
  o.grid.solids = ice_.solids > 0;
  o.grid.has_cut_cells = has_cut_cells(variant.kind);
  const int materials = material_count();
  if (o.grid.has_cut_cells && materials == 1) return o;
  if (o.grid.has_cut_cells || variant.kind == materials)
    select_mixture(o);
  else
    select_material(o, ice_, variant.kind);
  return o;
}

void FluidPart::declare_step(TaskList& list, const StepVariant& variant) const {
  const SchemeOptions o = graph_options(variant);
  list.enter(o.accounts.places);
  if (o.scheme.internal_energy_form) return declare_step_of_internal_energy(list, o, effects_);
  if (o.grid.has_cut_cells) return declare_step_of_cut_cells(list, o, effects_);
  declare_step_of_full_cells(list, o, effects_);
}

// Semi-implicit: d by passes over a system that is made once, then the step with what came out.
void FluidPart::shape_step(StepShape& shape) const {
  if (!options_.scheme.implicit) return;
  declare_passes(shape, nullptr);
  shape.commit();
}

void FluidPart::declare_passes(StepShape& shape,
                               const std::function<void(StepShape&)>& behind_solve) const {
  const Labels& l = labels();
  const auto pressure = std::make_shared<pressure::PressureSolve>(
      *ice_.implicit, options_.accounts.places.maximum, solves_);
  std::vector<Label> system{l.matrix_cell, l.right_side}, stored{l.volume_error};
  const bool several = scene_->grid.levels.size() > 1;
  for (int a = 0; a < options_.grid.axes.count; ++a) {
    const int d = options_.grid.axes.direction[a];
    system.push_back(l.matrix_face[d]);
    if (!several) continue;
    for (auto* labels_of_sweep : {&system, &stored}) {
      labels_of_sweep->push_back(l.face_velocity[d]);
      labels_of_sweep->push_back(l.face_pressure[d]);
    }
  }
  if (several) shape.link_levels(pressure::take_finer_faces);
  // On several levels passes also correct the matrix where they meet.
  constexpr int max_corrections = 8;
  const int most =
      several ? std::max(ice_.implicit->max_passes, max_corrections) : ice_.implicit->max_passes;
  shape.solve("start", [pressure](const StageScope& scope) { return pressure->start(scope); });
  if (several) {
    shape.prepare("work pressure", {l.work_pressure});
    shape.solve("work pressure where levels meet",
                [pressure](const StageScope& scope) { return pressure->join(scope); });
  }
  shape.prepare("pressure system", system);
  shape.iterate(
      "pressure", most, [pressure](const StageScope& scope) { return pressure->judge(scope); },
      [&](StepShape& pass) {
        pass.solve("pressure",
                   [pressure](const StageScope& scope) { return pressure->solve(scope); });
        if (behind_solve) behind_solve(pass);
        pass.sweep("step", stored);
      });
}

std::vector<SlotInfo> FluidPart::wall_slots() const {
  std::vector<SlotInfo> slots;
  if (ice_.solids == 0) return slots;
  const Labels& l = labels();
  for (const Label label : {l.solid_fraction_next, l.wall_pressure})
    slots.push_back({label, options_.place(0), 1, 0});
  for (int a = 0; a < options_.grid.axes.count; ++a) {
    const int d = options_.grid.axes.direction[a];
    for (const Label label :
         {l.covered[d], l.mean_covered[d], l.swept[d], l.solid_face_velocity[d]})
      slots.push_back({label, options_.place(0), 1, 0});
  }
  return slots;
}

std::vector<SlotInfo> FluidPart::work_slots() const {
  std::vector<SlotInfo> slots = wall_slots();
  if (!options_.scheme.implicit) return slots;
  slots.insert(slots.end(), {{labels().pressure_increment, options_.place(0), 1, 0},
                             {labels().pressure_correction, options_.place(0), 1, 0}});
  if (scene_->grid.levels.size() == 1) return slots;
  slots.push_back({labels().interface_pressure, options_.place(0), 1, 0});
  for (int a = 0; a < options_.grid.axes.count; ++a) {
    const int d = options_.grid.axes.direction[a];
    for (const Label label : {labels().finer_face_velocity[d], labels().finer_face_pressure[d]})
      slots.push_back({label, options_.place(0), 1, 0});
  }
  return slots;
}

// A block with one material alone needs the graph of that material only.
int FluidPart::step_kinds() const {
  const int of_fluids = material_count() == 1 ? 1 : material_count() + 1;
  return of_fluids + (ice_.solids > 0 ? 1 : 0);
}

// Does a solid meet these cells in this step.
bool FluidPart::meets_solid(const Warehouse& state, int box, const IndexBox& cells) const {
  for (const Label label : {labels().solid_fraction, labels().solid_fraction_next})
    if (state.any_nonzero(state.find(label, options_.place(0)), 0, box, cells)) return true;
  return false;
}

int FluidPart::step_kind(const Warehouse& old_state, int local_box,
                         const IndexBox& cells_with_halo) const {
  if (ice_.solids > 0 && meets_solid(old_state, local_box, cells_with_halo)) return cut_kind();
  const int mixed = material_count();
  if (mixed == 1) return 0;
  int only = -1;
  for (int m = 0; m < mixed; ++m) {
    const int slot = old_state.find(labels().mass, options_.place(m));
    if (!old_state.any_nonzero(slot, 0, local_box, cells_with_halo)) continue;
    if (only >= 0) return mixed;
    only = m;
  }
  // A source may bring others in.
  if (only >= 0 && !sources_.empty() && sources_.front()->takes_from(only)) return mixed;
  return only >= 0 ? only : mixed;
}

void FluidPart::declare_diagnostics(TaskList& list, int level) const {
  list.enter(options_.accounts.places);
  declare_diagnostic_outputs(list, at_level(level), ice_.criteria, estimates_);
}

int FluidPart::first_volume_sum() const {
  return options_.accounts.first_source_sum +
         (sources_.empty() ? 0 : SourceSums::count(material_count()));
}

int FluidPart::reduction_sums() const {
  const VolumeSums of_volumes(first_volume_sum(), material_count());
  return first_volume_sum() +
         of_volumes.count(static_cast<int>(control_volumes(scene_->analysis).size()));
}

void FluidPart::initialise(Warehouse& state) const {
  ice::initialise(state, *scene_, ice_, options_);
  if (ice_.solids > 0) {
    const int fraction = state.find(labels().solid_fraction, options_.place(0));
    for (int box = 0; box < static_cast<int>(state.local_boxes().size()); ++box)
      fill(state.view(fraction, 0, box), state.view(fraction, 0, box).box, 0.0);
  }
  if (!options_.scheme.implicit) return;
  solve::start_library(ice_.implicit->linear);  // here, and not in the first step
  // The work pressure begins as that of the state.
  const int offset = state.find(labels().pressure_offset, options_.place(0));
  for (int box = 0; box < static_cast<int>(state.local_boxes().size()); ++box) {
    const RealView v = state.view(offset, 0, box);
    fill(v, v.box, 0.0);
  }
}

// What passes through a control volume's side must be counted in uniform flow as well. Materials
// that exchange heat change where nothing flows; so may those that a finer level left at pressures
// of their own.
bool FluidPart::skipping_allowed() const {
  if (material_count() > 1 && (options_.materials.heat_exchange.any() ||
                               options_.materials.multi_velocity || scene_->grid.levels.size() > 1))
    return false;
  for (const models::TransportedScalar& s : ice_.models.scalars)
    if (s.grows()) return false;
  return !options_.forces.on && !options_.scheme.implicit && sources_.empty() &&
         control_volumes(scene_->analysis).empty();
}

// Shocks do not leave levels that follow them.
IntVec3 FluidPart::interface_depth(const Level& level) const {
  const RefinementSettings& r = scene_->refinement;
  const bool follow =
      r.adaptive && !r.once && !(ice_.criteria.empty() && r.errors.empty() && r.interfaces.empty());
  if (options_.scheme.internal_energy_form || !options_.scheme.second_order || follow) return {};
  return leaving_depth(level);
}

std::string FluidPart::describe_fault(int kind) const {
  if (kind >= fault_of_material) {
    const std::size_t m = kind / fault_of_material - 1;
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
    case fault_reactions:
      return "temperature (K) at which the reactions of the cell could not be integrated (to the "
             "tolerances <rtol>, <atol_Y> and <atol_T>)";
    default:
      return "value";
  }
}

}  // namespace sluice::ice
