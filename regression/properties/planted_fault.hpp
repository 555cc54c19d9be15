// ICE with faults planted into it: a cell of a level is inadmissible in some of its substeps.
#pragma once
#include <memory>
#include <stdexcept>

#include "ice/ice.hpp"

namespace sluice::properties {

struct PlantedFault {
  int level = -1;  // none
  IntVec3 cell{};
  double from = 0, to = 0;  // substeps that start in [from, to)
  double longest = 0;       // only in substeps longer than this
  bool excused = false;     // not where slopes are masked
};

class FaultyIce final : public Component {
 public:
  FaultyIce(const Scene& scene, ice::IceScene ice_scene) : ice_(scene, std::move(ice_scene)) {}

  PlantedFault fault;  // may change between steps

  void declare_step(TaskList& list, const StepVariant& variant) const override {
    ice_.declare_step(list, variant);
    TaskBuilder task = list.task("planted fault", ice::effect_flow);
    task.read(old_state_of(list));
    task.write(list.temporary("nothing"));
    task.always().kernel([this, variant](const Row& row) {
      const StepConstants& step = row.step();
      if (variant.level != fault.level || step.time < fault.from || step.time >= fault.to ||
          step.dt <= fault.longest || (fault.excused && variant.masked))
        return;
      const IntVec3 low = row.cell();
      const IntVec3 high = low + IntVec3{row.count(), 1, 1};
      if (IndexBox{low, high}.contains(fault.cell))
        row.reductions().fault({fault.cell, variant.level, 0, 0, -1.0});
    });
  }

  std::string name() const override { return ice_.name(); }
  const EffectList& effects() const override { return ice_.effects(); }
  int material_count() const override { return ice_.material_count(); }
  std::vector<SlotInfo> state_slots() const override { return ice_.state_slots(); }
  std::vector<std::vector<Label>> checkpoint_labels() const override {
    return ice_.checkpoint_labels();
  }
  void initialise(Warehouse& state) const override { ice_.initialise(state); }
  void fill_boundary(Warehouse& state, double time, const ThreadTeam& team) const override {
    ice_.fill_boundary(state, time, team);
  }
  void declare_diagnostics(TaskList& list, int level) const override {
    ice_.declare_diagnostics(list, level);
  }
  const TransferOperators& transfer() const override { return ice_.transfer(); }
  Label refine_flag() const override { return ice_.refine_flag(); }
  Label mask_label() const override { return ice_.mask_label(); }
  int reduction_maxima() const override { return ice_.reduction_maxima(); }
  int reduction_sums() const override { return ice_.reduction_sums(); }
  bool quiet_blocks_allowed() const override { return ice_.quiet_blocks_allowed(); }
  void measure_rates(const Warehouse& state, Reductions& rates) const override {
    ice_.measure_rates(state, rates);
  }
  StepLimit step_limit(const std::vector<double>& maxima) const override {
    return ice_.step_limit(maxima);
  }
  void add_totals(const Warehouse& state, const LevelCoverage& coverage,
                  Totals& totals) const override {
    ice_.add_totals(state, coverage, totals);
  }
  StepBalance balance(const std::vector<double>& sums, const StepStart* start,
                      double dt) const override {
    return ice_.balance(sums, start, dt);
  }
  double history_value(Label label, const Totals& totals) const override {
    return ice_.history_value(label, totals);
  }
  Vec3 history_vector(Label label, const Totals& totals) const override {
    return ice_.history_vector(label, totals);
  }
  std::string describe_fault(int kind) const override { return ice_.describe_fault(kind); }

 private:
  static VariableId old_state_of(const TaskList& list) {
    for (std::size_t n = 0; n < list.variables().size(); ++n)
      if (list.variables()[n].storage == Storage::old_state) return {static_cast<int>(n)};
    throw std::logic_error("a step without a state");
  }

  ice::Ice ice_;
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
