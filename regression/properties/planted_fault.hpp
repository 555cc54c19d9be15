// ICE with faults planted into it: a cell of a level is inadmissible in some of its substeps.
#pragma once
#include <memory>
#include <stdexcept>

#include "ice/ice.hpp"
#include "ice/step/effect_ids.hpp"

namespace sluice::properties {

struct PlantedFault {
  int level = -1;  // none
  IntVec3 cell{};
  double from = 0, to = 0;  // substeps that start in [from, to)
  double longest = 0;       // only in substeps longer than this
  bool excused = false;     // not where slopes are masked
};

// The step of the fluid, and a fault in it.
class FaultyStep final : public ice::FluidStep {
 public:
  FaultyStep(const ice::Ice& ice, const PlantedFault& planted)
      : FluidStep(ice.part(), ice.blocks(), ice.levels()), planted_(&planted) {}

  void declare(TaskList& list, const StepVariant& variant) const override {
    FluidStep::declare(list, variant);
    TaskBuilder task = list.task("planted fault", ice::effect_flow);
    task.read(old_state_of(list));
    task.write(list.temporary("nothing"));
    task.always().kernel([planted = planted_, variant](const Row& row) {
      const StepConstants& step = row.step();
      const PlantedFault& fault = *planted;
      if (variant.level != fault.level || step.time < fault.from || step.time >= fault.to ||
          step.dt <= fault.longest || (fault.excused && variant.masked))
        return;
      const IntVec3 low = row.cell();
      const IntVec3 high = low + IntVec3{row.count(), 1, 1};
      if (IndexBox{low, high}.contains(fault.cell))
        row.reductions().fault({fault.cell, variant.level, 0, 0, -1.0});
    });
  }

 private:
  static VariableId old_state_of(const TaskList& list) {
    for (std::size_t n = 0; n < list.variables().size(); ++n)
      if (list.variables()[n].storage == Storage::old_state) return {static_cast<int>(n)};
    throw std::logic_error("a step without a state");
  }
  const PlantedFault* planted_;
};

class FaultyIce final : public ice::Ice {
 public:
  using ice::Ice::Ice;
  const ice::FluidStep& step() const override { return step_; }

  PlantedFault fault;  // may change between steps

 private:
  FaultyStep step_{*this, fault};
};

// A deck ready to run with it.
struct FaultyDeck {
  Scene scene;
  std::vector<Fault> faults;  // warnings
  std::unique_ptr<FaultyIce> component;

  explicit FaultyDeck(const Deck& deck, IntVec3 boxes = {}) : faults(deck.faults) {
    SceneOptions options;
    options.boxes = boxes;
    scene = read_scene(deck, options, faults);
    component = std::make_unique<FaultyIce>(scene, ice::read_ice_scene(deck, scene, faults));
    for (const auto& f : faults)
      if (f.severity == Severity::error) throw InputError(to_string(f));
  }
};

}  // namespace sluice::properties
