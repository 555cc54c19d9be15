// The fluid's step: which table of tasks a block takes, the passes of a semi-implicit step, the
// length of the next one.
#pragma once
#include <functional>
#include <memory>

#include "framework/run/component/step_facet.hpp"
#include "ice/fluid_blocks.hpp"
#include "ice/fluid_levels.hpp"

namespace sluice::ice {

class FluidStep : public StepFacet {
 public:
  FluidStep(const FluidPart& part, const FluidBlocks& blocks, const FluidLevels& levels)
      : part_(&part), blocks_(&blocks), levels_(&levels) {}

  void declare(TaskList& list, const StepVariant& variant) const override;
  void declare_stages(StepShape& shape) const override;
  // The passes of a semi-implicit step up to the new state, as a part of a larger step; in each,
  // `behind_solve` (may be empty) declares what acts between the solve and the sweep.
  void declare_passes(StepShape& shape, const std::function<void(StepShape&)>& behind_solve) const;

  const ReductionLayout& reductions() const override { return part_->reductions(); }
  void measure_rates(const Warehouse& state, Reductions& rates) const override;
  StepLimit limit(const std::vector<double>& maxima) const override;
  double courant_number() const override { return part_->options().scheme.cfl; }
  bool diffusive() const override;
  Label mask_label() const override;
  std::string describe_fault(int kind) const override;

  // Of one graph.
  SchemeOptions options_of(const StepVariant& variant) const;

 private:
  const FluidPart* part_;
  const FluidBlocks* blocks_;
  const FluidLevels* levels_;
};

}  // namespace sluice::ice
