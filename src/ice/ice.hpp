// ICE: cell-centred compressible flow as a component of a run. It has one part, the fluid.
#pragma once
#include <memory>

#include "framework/run/component/component.hpp"
#include "ice/fluid_blocks.hpp"
#include "ice/fluid_budgets.hpp"
#include "ice/fluid_levels.hpp"
#include "ice/fluid_outputs.hpp"
#include "ice/fluid_state.hpp"
#include "ice/fluid_step.hpp"

namespace sluice::ice {

class Ice : public Component {
 public:
  // `places` and `reductions`: of the fluid among the parts of a component that has others too.
  Ice(const Scene& scene, IceScene ice_scene, IndexOffsets places = {},
      std::shared_ptr<ReductionLayout> reductions = std::make_shared<ReductionLayout>())
      : part_(scene, std::move(ice_scene), std::move(places), std::move(reductions)) {}

  // Its facets refer to its part.
  Ice(const Ice&) = delete;
  Ice& operator=(const Ice&) = delete;

  const FluidPart& part() const { return part_; }

  std::string name() const override { return "ice"; }
  const EffectList& effects() const override { return part_.effects(); }
  int material_count() const override { return part_.material_count(); }
  const FluidState& state() const override { return state_; }
  const FluidStep& step() const override { return step_; }
  const FluidBlocks& blocks() const override { return blocks_; }
  const FluidLevels& levels() const override { return levels_; }
  const FluidBudgets& budgets() const override { return budgets_; }
  const FluidOutputs& outputs() const override { return outputs_; }
  const ParticleMethod* particles() const override { return part_.tracers(); }

 private:
  FluidPart part_;
  FluidState state_{part_};
  FluidBlocks blocks_{part_};
  FluidLevels levels_{part_, state_.slots()};
  FluidStep step_{part_, blocks_, levels_};
  FluidBudgets budgets_{part_};
  FluidOutputs outputs_{part_, levels_};
};

}  // namespace sluice::ice
