// The steps of solids: stages on particles, in place of sweeps over cells.
#pragma once
#include "framework/run/component/step_facet.hpp"

namespace sluice::mpm {

class Mpm;

class MpmStep : public StepFacet {
 public:
  explicit MpmStep(const Mpm& mpm);

  // Solids have no task over cells.
  void declare(TaskList& /*list*/, const StepVariant& /*variant*/) const override {}
  void declare_stages(StepShape& shape) const override;
  const ReductionLayout& reductions() const override;
  StepLimit limit(const std::vector<double>& maxima) const override;

 protected:
  const Mpm& mpm() const { return *mpm_; }

 private:
  const Mpm* mpm_;
  StepLimit stable_;  // share of h/(c + |v|), by the deck's multiplier
};

// Newton's method finds the displacements of the nodes.
class ImplicitMpmStep final : public MpmStep {
 public:
  using MpmStep::MpmStep;
  void declare_stages(StepShape& shape) const override;
  StepLimit limit(const std::vector<double>& maxima) const override;
};

}  // namespace sluice::mpm
