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
  options_.places = std::move(places);
  register_reductions();
  StateSlots slots;
  slots.places = options_.places;
  slots.mass = labels().mass;
  slots.momentum = labels().momentum;
  slots.energy = labels().energy;
  if (material_count() > 1) slots.volume = labels().volume;
  if (options_.multi_velocity) slots.slip = labels().slip;
  if (options_.implicit) slots.offset = labels().pressure_offset;
  for (int c = 0; c < options_.components; ++c) slots.directions.push_back(options_.direction[c]);
  for (int level = 0; level < static_cast<int>(scene.grid.levels.size()); ++level)
    boundary_.push_back(std::make_unique<BoundaryFill>(scene, std::span(ice_.materials), slots,
                                                       level, ice_.conditions, ice_.models.scalars,
                                                       options_.mixed));
  effects_.add(open_faces(ice_, *boundary_.front()));
  if (ice_.solids > 0)
    effects_.add(
        {"solids in the flow", true,
         "cells cut by solids and faces that they cover; separated particles continue as blocks",
         ice_.materials.front().where});
  if (effects_.on(effect_tracers))
    tracers_ = std::make_unique<Tracers>(
        ice_.models.tracers, ice_.models.scalars, scene.grid, boundary_,
        FlowStorage{material_count(), slots.directions, options_.multi_velocity, options_.places,
                    ice_.solids > 0},
        scene.time.max_time);
  if (!effects_.on(effect_sources)) return;
  for (const Level& level : scene.grid.levels)
    sources_.push_back(std::make_unique<Sources>(ice_.models, ice_.added_heat, options_.fluids,
                                                 level, options_.direction));
  options_.sources = sources_.front().get();
}

// Sums: those of the flow, of sources, of control volumes.
void FluidPart::register_reductions() {
  const int volumes = static_cast<int>(control_volumes(scene_->analysis).size());
  options_.first_volume_sum =
      options_.first_source_sum +
      (effects_.on(effect_sources) ? SourceSums::count(material_count()) : 0);
  const VolumeSums of_volumes(options_.first_volume_sum, material_count());
  options_.places.sums =
      reductions_->add_sums(options_.first_volume_sum + of_volumes.count(volumes));
  options_.places.maxima =
      reductions_->add_maxima(options_.implicit ? StepSlots::maxima_with_solve : StepSlots::maxima);
}

VolumeSums FluidPart::volume_sums() const {
  return {sums().first() + options_.first_volume_sum, material_count()};
}

SchemeOptions FluidPart::at_level(int level) const {
  SchemeOptions o = options_;
  const Level& cells = scene_->grid.levels[level];
  o.level = &cells;
  o.domain = cells.domain;
  o.transports = transport_models(ice_, cells);
  o.transport = o.transports.front();
  o.boundary = boundary_[level].get();
  if (!sources_.empty()) o.sources = sources_[level].get();
  return o;
}

std::vector<SlotInfo> FluidPart::wall_slots() const {
  std::vector<SlotInfo> slots;
  if (ice_.solids == 0) return slots;
  const Labels& l = labels();
  for (const Label label : {l.solid_fraction_next, l.wall_pressure})
    slots.push_back({label, options_.place(0), 1, 0});
  for (int a = 0; a < options_.axes.count; ++a) {
    const int d = options_.axes.direction[a];
    for (const Label label :
         {l.covered[d], l.mean_covered[d], l.swept[d], l.solid_face_velocity[d]})
      slots.push_back({label, options_.place(0), 1, 0});
  }
  return slots;
}

}  // namespace sluice::ice
