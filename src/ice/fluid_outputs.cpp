#include "ice/fluid_outputs.hpp"

#include "ice/budgets/totals.hpp"
#include "ice/outputs/criteria.hpp"

namespace sluice::ice {

void FluidOutputs::declare_diagnostics(TaskList& list, int level) const {
  list.begin_part(part_->options().budgets.places);
  declare_diagnostic_outputs(list, part_->at_level(level), part_->scene().criteria,
                             levels_->error_estimates());
}

double FluidOutputs::history_value(Label label, const Totals& totals) const {
  if (const auto found = part_->solves().value(label)) return *found;
  return ice::history_value(part_->options(), label, totals);
}

Vec3 FluidOutputs::history_vector(Label label, const Totals& totals) const {
  return ice::history_vector(label, totals);
}

}  // namespace sluice::ice
