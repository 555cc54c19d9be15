// Where levels meet: plain numbers of any unit in cells, each the mean over its cell.
//
// Fine cells from coarse ones by a parabola in each direction, whose mean over the coarse cell is
// its value: second derivatives of it are those of the coarse cells. Coarse cells are means.
//
//   f(x) = c + s x + q/2 (x^2 - 1/12),  x in coarse cells from the centre,
//   s = (c(+1) - c(-1)) / 2,  q = c(+1) - 2 c + c(-1)
//
// Limits: not limited, for fields that may overshoot; fluxes are not matched.
#pragma once
#include "framework/refine/transfer_operators.hpp"

namespace sluice::examples {

class CellTransfer final : public TransferOperators {
 public:
  void prolong(const StateViews& coarse, const StateViews& fine, const IndexBox& cells,
               const TransferGeometry& geometry, int order) const override;
  void restrict_to(const StateViews& fine, const StateViews& coarse, const IndexBox& coarse_cells,
                   const TransferGeometry& geometry) const override;
  int flux_quantities() const override { return 0; }
  void correct(const StateViews& /*state*/, const ConservedChange& /*change*/,
               std::span<double> /*share*/) const override {}
};

}  // namespace sluice::examples
