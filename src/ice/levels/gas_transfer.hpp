// Where levels meet, for a gas: prolongation, restriction and correction of its conserved state.
//
// Views in the order of FluidState::slots(): mass, the momentum components, internal energy, all
// per volume. Behind them may stand scalars that are carried by volume, whose amounts, mass times
// scalar, are then prolonged like the mass.
#pragma once
#include "framework/refine/transfer_operators.hpp"
#include "ice/fluid/fluid.hpp"

namespace sluice::ice {

class IceTransfer final : public TransferOperators {
 public:
  // `internal_energy`: corrections hold internal instead of total energy (classic form).
  // `matches_fluxes`: levels are made to agree on what passes between them. `by_volume`: views of
  // scalars, at most two.
  IceTransfer(int components, bool internal_energy, bool matches_fluxes = true, Fluid fluid = {},
              std::vector<std::size_t> by_volume = {})
      : components_(components),
        internal_energy_(internal_energy),
        matches_fluxes_(matches_fluxes),
        fluid_(std::move(fluid)),
        by_volume_(std::move(by_volume)) {}

  void prolong(const StateViews& coarse, const StateViews& fine, const IndexBox& cells,
               const TransferGeometry& geometry, int order) const override {
    const Prolongation one{&coarse, &fine, cells, nullptr, 0};
    prolong_all({&one, 1}, geometry, order);
  }
  void prolong_all(std::span<const Prolongation> regions, const TransferGeometry& geometry,
                   int order) const override;
  bool blends() const override { return true; }
  void restrict_to(const StateViews& fine, const StateViews& coarse, const IndexBox& coarse_cells,
                   const TransferGeometry& geometry) const override;
  int flux_quantities() const override { return matches_fluxes_ ? 2 + components_ : 0; }
  void correct(const StateViews& state, const ConservedChange& change,
               std::span<double> share) const override;

 private:
  int components_;  // of momentum
  bool internal_energy_, matches_fluxes_;
  Fluid fluid_;
  std::vector<std::size_t> by_volume_;
};

}  // namespace sluice::ice
