// All burning of solids in a step: what laws take from particles and give to cells.
#pragma once
#include "mpmice/burn/burn_products.hpp"
#include "mpmice/burn/burned_particles.hpp"

namespace sluice::mpmice {

template <int D>
class SolidBurning {
 public:
  // `places`: among the sums of the step.
  SolidBurning(solids::CoupledSolids& solids, const ice::FluidPart& fluid,
               std::vector<models::SolidBurn> burns, const BurnReductions& places)
      : burns_(std::move(burns)), places_(places), particles_(solids, fluid.material_count()) {}

  bool any() const { return !burns_.empty(); }
  // False: nothing burns in this step on any rank. Else what is left of particles is known, also
  // what surfaces they have then, and products are among the amounts of cells, but for the volume
  // that opens (products().fill_opened). Collective.
  bool burn(const BurningStep<D>& step);
  const BurnProducts<D>& products() const { return products_; }
  // Once particles are taken over: those that are burned go.
  void remove_burned(const StageScope& scope) const { particles_.remove(scope); }

 private:
  class Forms;  // what a law of burning asks of the step

  std::vector<models::SolidBurn> burns_;
  BurnReductions places_;
  BurnedParticles<D> particles_;
  BurnProducts<D> products_;
};

}  // namespace sluice::mpmice
