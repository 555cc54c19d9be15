// The fluid's budgets: totals over cells, what passes the boundary, what forces and models add.
#pragma once
#include "framework/run/component/budget_facet.hpp"
#include "ice/fluid_part.hpp"

namespace sluice::ice {

class FluidBudgets : public BudgetFacet {
 public:
  explicit FluidBudgets(const FluidPart& part) : part_(&part) {}

  void add_totals(const Warehouse& state, const LevelCoverage& coverage,
                  Totals& totals) const override;
  StepBalance balance(const std::vector<double>& sums, const StepStart* start,
                      double dt) const override;
  std::optional<VolumeSums> volume_sums() const override { return part_->volume_sums(); }
  std::vector<std::string> tracked_names() const override;
  std::vector<double> tracked_totals(const std::vector<double>& sums) const override;

 private:
  const FluidPart* part_;
};

}  // namespace sluice::ice
