// The fluid where levels meet, and where it wants finer ones.
#pragma once
#include <memory>

#include "framework/run/component/level_facet.hpp"
#include "ice/fluid_part.hpp"

namespace sluice::ice {

class FluidLevels : public LevelFacet {
 public:
  // `slots`: of the state.
  FluidLevels(const FluidPart& part, const std::vector<SlotInfo>& slots);

  const TransferOperators& transfer() const override { return *transfer_; }
  IntVec3 interface_depth(const Level& level) const override;
  Label refine_flag() const override;
  std::vector<ErrorEstimate> error_estimates() const override { return estimates_; }
  std::vector<FlagSeeds> flag_seeds(const Warehouse& state) const override;

 private:
  const FluidPart* part_;
  std::unique_ptr<TransferOperators> transfer_;
  std::vector<ErrorEstimate> estimates_;
};

}  // namespace sluice::ice
