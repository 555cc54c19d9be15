#include "ice/fluid_budgets.hpp"

#include "ice/budgets/totals.hpp"

namespace sluice::ice {

void FluidBudgets::add_totals(const Warehouse& state, const LevelCoverage& coverage,
                              Totals& totals) const {
  ice::add_totals(state, coverage, part_->options(), totals);
}

StepBalance FluidBudgets::balance(const std::vector<double>& sums, const StepStart* start,
                                  double dt) const {
  return ice::balance(part_->options(), sums, start, dt);
}

std::vector<std::string> FluidBudgets::tracked_names() const {
  return ice::tracked_names(part_->options());
}

std::vector<double> FluidBudgets::tracked_totals(const std::vector<double>& sums) const {
  return ice::tracked_totals(part_->options(), sums);
}

}  // namespace sluice::ice
