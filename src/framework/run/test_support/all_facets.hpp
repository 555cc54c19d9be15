// A component of tests that is each of its facets itself.
#pragma once
#include "framework/run/component/component.hpp"

namespace sluice::run_test {

class AllFacets : public Component,
                  public StateFacet,
                  public StepFacet,
                  public BlockFacet,
                  public LevelFacet,
                  public BudgetFacet,
                  public OutputFacet {
 public:
  const StateFacet& state() const override { return *this; }
  const StepFacet& step() const override { return *this; }
  const BlockFacet& blocks() const override { return *this; }
  const LevelFacet& levels() const override { return *this; }
  const BudgetFacet& budgets() const override { return *this; }
  const OutputFacet& outputs() const override { return *this; }
  const ReductionLayout& reductions() const override { return reductions_; }

 protected:
  AllFacets(int maxima, int sums) {
    reductions_.add_maxima(maxima);
    reductions_.add_sums(sums);
  }

 private:
  ReductionLayout reductions_;
};

}  // namespace sluice::run_test
