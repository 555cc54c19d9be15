// Where levels meet, with scalars: what the flow's own operators do, and the scalars with it.
//
// Views in the order of FluidState::slots(): those of the flow, then each scalar. Quantities of a
// flux register: those of the flow, then mass times scalar of each.
#pragma once
#include <memory>
#include <vector>

#include "framework/refine/transfer_operators.hpp"

namespace sluice::ice::scalars {

class ScalarTransfer final : public TransferOperators {
 public:
  // `mass`: the view of the mass that each scalar goes with; `views`: how many the flow has;
  // `by_volume`: views of scalars that the flow's operators prolong themselves.
  ScalarTransfer(std::unique_ptr<TransferOperators> flow, std::vector<std::size_t> mass,
                 std::size_t views, std::vector<std::size_t> by_volume = {})
      : flow_(std::move(flow)),
        mass_(std::move(mass)),
        views_(views),
        by_volume_(std::move(by_volume)) {}

  // A limited linear function in each coarse cell, between the values around it; the mean of mass
  // times scalar is that of the coarse cell.
  void prolong(const StateViews& coarse, const StateViews& fine, const IndexBox& cells,
               const TransferGeometry& geometry, int order) const override;
  // Means weighted with mass.
  void restrict_to(const StateViews& fine, const StateViews& coarse, const IndexBox& coarse_cells,
                   const TransferGeometry& geometry) const override;
  int flux_quantities() const override {
    const int flow = flow_->flux_quantities();
    return flow > 0 ? flow + static_cast<int>(mass_.size()) : 0;
  }
  void correct(const StateViews& state, const ConservedChange& change,
               std::span<double> share) const override;

 private:
  StateViews flow_views(const StateViews& all) const {
    return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(views_)};
  }
  void prolong_whole_cells(const StateViews& coarse, const StateViews& fine,
                           const IndexBox& parents, const TransferGeometry& geometry,
                           int order) const;

  std::unique_ptr<TransferOperators> flow_;
  std::vector<std::size_t> mass_;
  std::size_t views_;
  std::vector<std::size_t> by_volume_;
};

}  // namespace sluice::ice::scalars
