// Solids alone: the material point method as a component, explicit (mpm) or implicit (impm).
#pragma once
#include <memory>

#include "framework/run/component/component.hpp"
#include "mpm/budgets/history_sums.hpp"
#include "mpm/deck/mpm_scene.hpp"
#include "mpm/mpm_budgets.hpp"
#include "mpm/mpm_outputs.hpp"
#include "mpm/mpm_step.hpp"
#include "mpm/solid_particles.hpp"

namespace sluice::mpm {

class SolidLevels;

class Mpm : public Component {
 public:
  // `reductions`: of the component. Solids come first among its parts: stages write sums and maxima
  // by the places of StepSums. Throws std::logic_error where they do not.
  Mpm(const Scene& scene, MpmScene solids,
      std::shared_ptr<ReductionLayout> reductions = std::make_shared<ReductionLayout>());
  // Its facets refer to it.
  Mpm(const Mpm&) = delete;
  Mpm& operator=(const Mpm&) = delete;

  // A warning for each label that the deck saves and none of its particles has.
  void warn_of_absent_labels(std::vector<Fault>& faults) const;

  std::string name() const override { return solids_.implicit ? "impm" : "mpm"; }
  const EffectList& effects() const override { return effects_; }
  int material_count() const override { return static_cast<int>(solids_.materials.size()); }
  // No field lives in cells: particles carry everything from step to step.
  const StateFacet& state() const override { return state_; }
  const MpmStep& step() const override { return *step_; }
  const MpmBudgets& budgets() const override { return *budgets_; }
  const MpmOutputs& outputs() const override { return outputs_; }
  const ParticleMethod* particles() const override { return &particles_; }

  const Scene& run_scene() const { return scene_; }
  const MpmScene& scene() const { return solids_; }
  const std::vector<Carried>& carried() const { return particles_.carried(); }
  // The stages of a step, for components that join them with others.
  std::shared_ptr<SolidLevels> make_step() const;
  bool has_history(Label label) const;
  const HistorySums& history_sums() const { return history_sums_; }
  // Of Totals::amounts, how many are the solids'.
  std::size_t amount_count() const { return history_sums_.count(); }

  // Of the component, and the solids' own among them.
  const ReductionLayout& reductions() const { return *reductions_; }
  const SumGroup& sums() const { return sums_; }
  const MaximumGroup& maxima() const { return maxima_; }

 private:
  const Scene& scene_;
  MpmScene solids_;
  SolidParticles particles_;
  EffectList effects_;
  HistorySums history_sums_;
  std::shared_ptr<ReductionLayout> reductions_;
  SumGroup sums_;
  MaximumGroup maxima_;
  StateFacet state_;
  std::unique_ptr<MpmStep> step_;
  std::unique_ptr<MpmBudgets> budgets_;
  MpmOutputs outputs_{*this};
};

}  // namespace sluice::mpm
