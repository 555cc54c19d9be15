// Where levels meet: numbers of any unit on nodes.
//
// Fine nodes from coarse ones by the straight lines between these, direction by direction: fine
// nodes on coarse ones copy them. Coarse nodes copy the fine node in the same place.
//
// Each node belongs to the finest level whose boxes own it: on the low sides of a finer level to
// that level, on the high sides to the coarser one.
//
// Limits: the error between nodes is of second order, that of a solution of Laplace's equation
// through such a boundary of first (at the centre of a cube, middle half refined: 2.2e-3 of the
// side's value on 8^3 cells, 1.0e-3 on 16^3); fluxes are not matched; low and high sides differ.
#pragma once
#include "framework/refine/transfer_operators.hpp"

namespace sluice::examples {

class NodeTransfer final : public TransferOperators {
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
