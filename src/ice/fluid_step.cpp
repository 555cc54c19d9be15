#include "ice/fluid_step.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ice/budgets/rates.hpp"
#include "ice/budgets/step_limit.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/pressure/finer_faces.hpp"
#include "ice/pressure/pressure_solve.hpp"
#include "ice/step/scheme_options.hpp"
#include "ice/step_tables.hpp"

namespace sluice::ice {

SchemeOptions FluidStep::options_of(const StepVariant& variant) const {
  const int levels = static_cast<int>(part_->run_scene().grid.levels.size());
  SchemeOptions o = part_->at_level(variant.level);
  o.scheme.masked = variant.masked;
  o.budgets.coverage = variant.coverage;
  o.grid.meets_coarser = o.scheme.implicit && variant.level > 0;
  o.grid.meets_finer = o.scheme.implicit && variant.level + 1 < levels;
  o.budgets.recorder = levels_->transfer().flux_quantities() > 0 ? variant.recorder : nullptr;
  o.grid.shocks_leave =
      o.budgets.recorder != nullptr && levels_->interface_depth(*o.grid.level) != IntVec3{};
  o.budgets.volumes = variant.volumes;
  if (o.scheme.internal_energy_form) return o;
  o.grid.solids = part_->scene().solids > 0;
  o.grid.has_cut_cells = blocks_->has_cut_cells(variant.kind);
  const int materials = part_->material_count();
  if (o.grid.has_cut_cells && materials == 1) return o;
  if (o.grid.has_cut_cells || variant.kind == materials)
    select_mixture(o);
  else
    select_material(o, part_->scene(), variant.kind);
  return o;
}

void FluidStep::declare(TaskList& list, const StepVariant& variant) const {
  const SchemeOptions o = options_of(variant);
  list.begin_part(o.budgets.places);
  if (o.scheme.internal_energy_form)
    return declare_step_of_internal_energy(list, o, part_->effects());
  if (o.grid.has_cut_cells) return declare_step_of_cut_cells(list, o, part_->effects());
  declare_step_of_full_cells(list, o, part_->effects());
}

// Semi-implicit: d by passes over a system that is made once, then the step with what came out.
void FluidStep::declare_stages(StepShape& shape) const {
  if (!part_->options().scheme.implicit) return;
  declare_passes(shape, nullptr);
  shape.commit();
}

void FluidStep::declare_passes(StepShape& shape,
                               const std::function<void(StepShape&)>& behind_solve) const {
  const Labels& l = labels();
  const auto pressure = std::make_shared<pressure::PressureSolve>(
      *part_->scene().implicit, part_->maxima().first(), part_->solve_history());
  std::vector<Label> system{l.matrix_cell, l.right_side}, stored{l.volume_error};
  const bool several = part_->run_scene().grid.levels.size() > 1;
  for (int a = 0; a < part_->options().grid.axes.count; ++a) {
    const int d = part_->options().grid.axes.direction[a];
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
  const int most = several ? std::max(part_->scene().implicit->max_passes, max_corrections)
                           : part_->scene().implicit->max_passes;
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

void FluidStep::measure_rates(const Warehouse& state, Reductions& rates) const {
  const SchemeOptions o = part_->at_level(state.level().index);
  ice::measure_rates(state, o, {rates, o.budgets.places.reduction_offsets()});
}

StepLimit FluidStep::limit(const std::vector<double>& maxima) const {
  return step_limit(part_->options(), part_->maxima().of(maxima));
}

bool FluidStep::diffusive() const {
  return ice::diffusive(part_->options());
}

Label FluidStep::mask_label() const {
  return labels().mask;
}

std::string FluidStep::describe_fault(int kind) const {
  if (kind >= fault_of_material) {
    const std::size_t m = kind / fault_of_material - 1;
    return fmt::format(
        "energy of material {} ('{}', J/m^3 of the cell; with its mass and volume it must be a "
        "state of its equation of state: pressure above {:g} Pa, sound speed squared above 0)",
        m, part_->scene().materials[m].name, part_->scene().materials[m].fluid.lowest_pressure());
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
