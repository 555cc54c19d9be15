// Where levels meet, with the offset of the work pressure (pressure/variables.hpp): what the flow's
// own operators do, and the last view of the state beside it, which no flux carries.
#pragma once
#include <memory>

#include "framework/refine/transfer_operators.hpp"

namespace sluice::ice {

class OffsetTransfer final : public TransferOperators {
 public:
  explicit OffsetTransfer(std::unique_ptr<TransferOperators> flow) : flow_(std::move(flow)) {}

  // A linear function in each coarse cell.
  void prolong(const StateViews& coarse, const StateViews& fine, const IndexBox& cells,
               const TransferGeometry& geometry, int order) const override;
  // Means.
  void restrict_to(const StateViews& fine, const StateViews& coarse, const IndexBox& coarse_cells,
                   const TransferGeometry& geometry) const override;
  int flux_quantities() const override { return flow_->flux_quantities(); }
  void correct(const StateViews& state, const ConservedChange& change,
               std::span<double> share) const override;

 private:
  static StateViews flow_views(const StateViews& all) { return {all.begin(), all.end() - 1}; }

  std::unique_ptr<TransferOperators> flow_;
};

}  // namespace sluice::ice
