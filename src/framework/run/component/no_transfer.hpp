// Operators of mock components on one level: nothing moves between levels, no number is looked at.
#pragma once
#include "framework/refine/transfer_operators.hpp"

namespace sluice {

class NoTransfer final : public TransferOperators {
 public:
  void prolong(const StateViews&, const StateViews&, const IndexBox&, const TransferGeometry&,
               int) const override {}
  void restrict_to(const StateViews&, const StateViews&, const IndexBox&,
                   const TransferGeometry&) const override {}
  int flux_quantities() const override { return 1; }
  void correct(const StateViews&, const ConservedChange&, std::span<double>) const override {}
};

}  // namespace sluice
