#include "mpmice/mpmice_outputs.hpp"

#include <algorithm>

#include "ice/fluid/labels.hpp"
#include "ice/step/effect_ids.hpp"
#include "mpmice/mpmice.hpp"

namespace sluice::mpmice {

void MpmIceOutputs::declare_diagnostics(TaskList& list, int level) const {
  both_->fluid().outputs().declare_diagnostics(list, level);
  both_->burning_cells().declare(list, both_->solids().effects().size() + ice::effect_diagnostics);
}

std::vector<OutputSwitch> MpmIceOutputs::switches() const {
  return output_switches(both_->burns());
}

bool MpmIceOutputs::passes_switch(std::size_t n, const std::vector<double>& sums) const {
  return both_->burn_reductions().switches.of(sums)[n] > 0;
}

// The amounts of the fluid come after those of the solids.
Totals MpmIceOutputs::fluid_totals(const Totals& all) const {
  Totals own = all;
  if (both_->has_budget()) own.amounts.resize(own.amounts.size() - 2);
  own.tracked_totals.resize(
      std::min(own.tracked_totals.size(), both_->fluid().budgets().tracked_names().size()));
  const auto scalars =
      static_cast<std::ptrdiff_t>(both_->fluid().part().options().materials.scalars.size());
  if (static_cast<std::ptrdiff_t>(own.amounts.size()) > scalars)
    own.amounts.erase(own.amounts.begin(), own.amounts.end() - scalars);
  return own;
}

double MpmIceOutputs::history_value(Label label, const Totals& totals) const {
  const std::size_t tallied = totals.tracked_totals.size();
  if (!both_->burns().empty() && tallied >= 2) {
    // Fluids alone may burn too.
    const double fluid = tallied > 2 && (label == ice::labels().total_mass_burned ||
                                         label == ice::labels().total_heat_released)
                             ? both_->fluid().outputs().history_value(label, totals)
                             : 0.0;
    if (label == ice::labels().total_mass_burned) return totals.tracked_totals[tallied - 2] + fluid;
    if (label == ice::labels().total_heat_released)
      return totals.tracked_totals[tallied - 1] + fluid;
  }
  return both_->solids().has_history(label)
             ? both_->solids().outputs().history_value(label, totals)
             : both_->fluid().outputs().history_value(label, fluid_totals(totals));
}

Vec3 MpmIceOutputs::history_vector(Label label, const Totals& totals) const {
  return both_->solids().has_history(label)
             ? both_->solids().outputs().history_vector(label, totals)
             : both_->fluid().outputs().history_vector(label, fluid_totals(totals));
}

}  // namespace sluice::mpmice
