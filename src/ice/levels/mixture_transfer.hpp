// Where levels meet, for several materials: prolongation, restriction and
// correction of their conserved state.
//
// Views in the order of FluidState::slots(), per volume of the cell: mass of each material, the
// momentum components of the mixture, internal energy of each material, volume of each material.
// An absent material has mass, energy and volume exactly zero; one alone has the volume exactly 1.
// Changes of a flux register, in order: mass of each material, momentum, internal energy of each
// material (what passes with it, without work), volume of each material, total energy. Materials
// with velocities of their own have their slip, momentum relative to the mixture, behind the rest,
// and in the register the momentum that passes with each. The fraction of a mixed gas stands behind
// the flow's views; where that gas is alone it is prolonged with its mass and energy.
#pragma once
#include <vector>

#include "ice/levels/gas_transfer.hpp"
#include "models/gases/mixed_gas.hpp"

namespace sluice::ice {

// Places of the views.
struct MixtureLayout {
  std::size_t materials = 1, components = 1;
  bool multi_velocity = false;  // then also the slip of each material, by component

  std::size_t mass(std::size_t m) const { return m; }
  std::size_t momentum(std::size_t c) const { return materials + c; }
  std::size_t energy(std::size_t m) const { return materials + components + m; }
  std::size_t volume(std::size_t m) const { return 2 * materials + components + m; }
  std::size_t slip(std::size_t m, std::size_t c) const {
    return 3 * materials + components + m * components + c;
  }
  std::size_t quantities() const {
    return 3 * materials + components + (multi_velocity ? materials * components : 0);
  }
  // Among the changes of a flux register.
  std::size_t total_energy() const { return 3 * materials + components; }
  std::size_t material_momentum(std::size_t m, std::size_t c) const {
    return total_energy() + 1 + m * components + c;
  }
};

// The fraction of a material that is a mixture itself: its view.
struct MixedGasView {
  const models::MixedGas* gas = nullptr;  // null: none is
  std::size_t fraction = 0;
};

class MixtureTransfer final : public TransferOperators {
 public:
  // `fluids`: of each material.
  MixtureTransfer(std::vector<Fluid> fluids, int components, bool matches_fluxes = true,
                  bool multi_velocity = false, MixedGasView mixed = {});

  // A coarse cell whose neighbours, across edges and corners too, hold nothing but its own one
  // material is treated as a gas; elsewhere the fine cells are as the coarse one: whatever is in
  // equilibrium stays so.
  void prolong(const StateViews& coarse, const StateViews& fine, const IndexBox& cells,
               const TransferGeometry& geometry, int order) const override;
  // Means, of volumes too; the kinetic energy that the mean loses goes to the materials by mass.
  // Their pressures may differ afterwards, as those of a step before it equilibrates.
  void restrict_to(const StateViews& fine, const StateViews& coarse, const IndexBox& coarse_cells,
                   const TransferGeometry& geometry) const override;
  int flux_quantities() const override {
    return matches_fluxes_ ? static_cast<int>(layout_.quantities()) + 1 : 0;
  }
  // Volumes are brought back to the sum 1, against the cell's pressure; what then lacks in the
  // total energy goes to the materials by mass. A cell of one material is treated as a gas.
  void correct(const StateViews& state, const ConservedChange& change,
               std::span<double> share) const override;

 private:
  MixtureLayout layout_;
  std::vector<Fluid> fluids_;
  MixedGasView mixed_;
  std::vector<IceTransfer> alone_;  // each material where there is no other
  bool matches_fluxes_;
};

}  // namespace sluice::ice
