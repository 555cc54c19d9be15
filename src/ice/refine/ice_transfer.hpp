// Where levels meet, for a gas: prolongation, restriction and correction of its conserved state.
//
// Views in the order of Ice::state_slots(): mass, the momentum components, internal energy, all per
// volume.
#pragma once
#include "framework/refine/transfer_operators.hpp"

namespace sluice::ice {

class IceTransfer final : public TransferOperators {
 public:
  // `internal_energy`: corrections hold internal instead of total energy (classic form).
  IceTransfer(int components, bool internal_energy)
      : components_(components), internal_energy_(internal_energy) {}

  void prolong(const StateViews& coarse, const StateViews& fine, const IndexBox& cells,
               const TransferGeometry& geometry, int order) const override;
  void restrict_to(const StateViews& fine, const StateViews& coarse, const IndexBox& coarse_cells,
                   const TransferGeometry& geometry) const override;
  int flux_quantities() const override { return 2 + components_; }
  void correct(const StateViews& state, const ConservedChange& change,
               std::span<double> share) const override;

 private:
  int components_;  // of momentum
  bool internal_energy_;
};

}  // namespace sluice::ice
