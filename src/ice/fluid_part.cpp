#include "ice/fluid_part.hpp"

#include "ice/fluid/labels.hpp"
#include "ice/sources/source_tasks.hpp"
#include "ice/step/effect_ids.hpp"
#include "ice/step/scheme_options.hpp"
#include "ice/tracers/tracers.hpp"

namespace sluice::ice {

FluidPart::FluidPart(const Scene& scene, IceScene ice_scene, IndexOffsets places,
                     std::shared_ptr<ReductionLayout> reductions)
    : scene_(&scene),
      ice_(std::move(ice_scene)),
      effects_(find_effects(scene, ice_)),
      options_(scheme_options(scene, ice_)),
      reductions_(std::move(reductions)) {
  for (const models::TransportedScalar& s : ice_.models.scalars) s.declare_labels();
  options_.budgets.places = std::move(places);
  register_reductions();
  StateSlots slots;
  slots.places = options_.budgets.places;
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
                    options_.budgets.places, ice_.solids > 0},
        scene.time.max_time);
  if (!effects_.on(effect_sources)) return;
  for (const Level& level : scene.grid.levels)
    sources_.push_back(std::make_unique<Sources>(
        ice_.models, ice_.added_heat, options_.materials.fluids, level, options_.grid.direction));
  options_.forces.sources = sources_.front().get();
}

void FluidPart::register_reductions() {
  BudgetOptions& a = options_.budgets;
  const int materials = material_count();
  a.places.sums = reductions_->add_sums(a.sums + materials - 1);
  if (effects_.on(effect_sources))
    a.source_sums = reductions_->add_sums(SourceSums::count(materials));
  const int volumes = static_cast<int>(control_volumes(scene_->analysis).size());
  a.volume_sums = reductions_->add_sums(VolumeSums(0, materials).count(volumes));
  a.places.maxima = reductions_->add_maxima(options_.scheme.implicit ? StepSlots::maxima_with_solve
                                                                     : StepSlots::maxima);
}

VolumeSums FluidPart::volume_sums() const {
  return {options_.budgets.volume_sums.first(), material_count()};
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

}  // namespace sluice::ice
