// What can be saved of the fluid: labels of a state, and histories.
#pragma once
#include "framework/run/component/output_facet.hpp"
#include "ice/fluid_levels.hpp"

namespace sluice::ice {

class FluidOutputs : public OutputFacet {
 public:
  FluidOutputs(const FluidPart& part, const FluidLevels& levels) : part_(&part), levels_(&levels) {}

  void declare_diagnostics(TaskList& list, int level) const override;
  double history_value(Label label, const Totals& totals) const override;
  Vec3 history_vector(Label label, const Totals& totals) const override;

 private:
  const FluidPart* part_;
  const FluidLevels* levels_;
};

}  // namespace sluice::ice
