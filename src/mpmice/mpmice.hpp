// Fluid and solids on one grid as a component of a run: both parts, and what joins them.
//
// Numbers of effects, maxima, sums and materials: those of the solids come first. What is the
// fluid's alone (blocks, levels) is its facet.
#pragma once
#include <memory>

#include "framework/run/component/joined_particles.hpp"
#include "ice/ice.hpp"
#include "mpm/mpm.hpp"
#include "mpmice/burn/burned_sums.hpp"
#include "mpmice/burn/burning_cells.hpp"
#include "mpmice/mpmice_budgets.hpp"
#include "mpmice/mpmice_outputs.hpp"
#include "mpmice/mpmice_state.hpp"
#include "mpmice/mpmice_step.hpp"

namespace sluice::mpmice {

// Solids between which the exchange of momentum is as good as infinite move with one velocity where
// they meet: a rule of contact, before those of the deck.
void bind_solids(const ice::IceScene& fluid, mpm::MpmScene& solids);

class MpmIce final : public Component {
 public:
  // `burns`: solids that become fluids.
  MpmIce(const Scene& scene, ice::IceScene fluid, mpm::MpmScene solids,
         const std::vector<models::SolidBurn>& burns = {});
  // Its facets refer to it.
  MpmIce(const MpmIce&) = delete;
  MpmIce& operator=(const MpmIce&) = delete;

  std::string name() const override { return "mpmice"; }
  const EffectList& effects() const override { return effects_; }
  int material_count() const override { return solids_.material_count() + fluid_.material_count(); }
  const StateFacet& state() const override { return state_; }
  const StepFacet& step() const override { return step_; }
  const BlockFacet& blocks() const override { return fluid_.blocks(); }
  const LevelFacet& levels() const override { return fluid_.levels(); }
  const BudgetFacet& budgets() const override { return budgets_; }
  const OutputFacet& outputs() const override { return outputs_; }
  const ParticleMethod* particles() const override {
    return joined_ ? joined_.get() : solids_.particles();
  }

  const Scene& run_scene() const { return scene_; }
  const mpm::Mpm& solids() const { return solids_; }
  const ice::Ice& fluid() const { return fluid_; }
  const std::vector<models::SolidBurn>& burns() const { return burning_.laws; }
  const BurningCells& burning_cells() const { return burning_.cells; }
  const ReductionLayout& reductions() const { return *reductions_; }
  const BurnReductions& burn_reductions() const { return burning_.sums; }
  // Is there an account of energy: nothing burns, no solid is rigid.
  bool has_budget() const;

 private:
  struct Burning {
    std::vector<models::SolidBurn> laws;
    BurnReductions sums;
    BurningCells cells;
  };
  const Scene& scene_;
  std::shared_ptr<ReductionLayout> reductions_ = std::make_shared<ReductionLayout>();
  mpm::Mpm solids_;
  ice::Ice fluid_;
  Burning burning_;
  EffectList effects_;
  std::unique_ptr<JoinedParticles> joined_;  // of solids and tracers, where there are any
  MpmIceState state_{*this};
  MpmIceStep step_{*this};
  MpmIceBudgets budgets_{*this};
  MpmIceOutputs outputs_{*this};
};

// Of all burning, in the order in which the step finds them.
std::vector<OutputSwitch> output_switches(const std::vector<models::SolidBurn>& burns);

}  // namespace sluice::mpmice
