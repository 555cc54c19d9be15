// ICE: cell-centred compressible flow as a component of a run. It has one part, the fluid.
#pragma once
#include "ice/fluid_part.hpp"

namespace sluice::ice {

class Ice : public Component {
 public:
  // `places`: of the fluid among the parts of a component that has others too.
  Ice(const Scene& scene, IceScene ice_scene, IndexOffsets places = {})
      : fluid_(scene, std::move(ice_scene), std::move(places)) {}

  std::string name() const override { return "ice"; }
  const FluidPart& part() const { return fluid_; }
  const EffectList& effects() const override { return fluid_.effects(); }
  int material_count() const override { return fluid_.material_count(); }

  std::vector<SlotInfo> state_slots() const override { return fluid_.state_slots(); }
  std::vector<std::vector<Label>> checkpoint_labels() const override {
    return fluid_.checkpoint_labels();
  }
  void initialise(Warehouse& state) const override { fluid_.initialise(state); }
  void fill_boundary(Warehouse& state, double time, std::span<const double> sums,
                     const ThreadTeam& team) const override;
  int boundary_sums() const override;
  void add_boundary_sums(const Warehouse& state, std::span<ExactSum> sums) const override;

  void declare_step(TaskList& list, const StepVariant& variant) const override {
    fluid_.declare_step(list, variant);
  }
  int step_kinds() const override { return fluid_.step_kinds(); }
  int step_kind(const Warehouse& old_state, int local_box,
                const IndexBox& cells_with_halo) const override {
    return fluid_.step_kind(old_state, local_box, cells_with_halo);
  }
  std::optional<double> absent_value(Label label, int material, int kind) const override;
  void declare_diagnostics(TaskList& list, int level) const override {
    fluid_.declare_diagnostics(list, level);
  }

  const TransferOperators& transfer() const override { return fluid_.transfer(); }
  IntVec3 interface_depth(const Level& level) const override {
    return fluid_.interface_depth(level);
  }
  Label refine_flag() const override;
  std::vector<ErrorEstimate> error_estimates() const override { return fluid_.error_estimates(); }
  std::vector<FlagSeeds> flag_seeds(const Warehouse& state) const override {
    return fluid_.flag_seeds(state);
  }
  Label mask_label() const override;
  const ParticleMethod* particles() const override { return fluid_.tracers(); }

  int reduction_maxima() const override {
    return fluid_.options().scheme.implicit ? StepSlots::maxima_with_solve : StepSlots::maxima;
  }
  void shape_step(StepShape& shape) const override { fluid_.shape_step(shape); }
  std::vector<SlotInfo> work_slots() const override { return fluid_.work_slots(); }
  void fill_work_boundary(Warehouse& state, Label label, const ThreadTeam& team) const override;
  int reduction_sums() const override { return fluid_.reduction_sums(); }
  int first_volume_sum() const override { return fluid_.first_volume_sum(); }
  bool skipping_allowed() const override { return fluid_.skipping_allowed(); }
  bool may_be_skipped(int kind) const override { return !fluid_.has_cut_cells(kind); }
  double courant_number() const override { return fluid_.options().scheme.cfl; }
  bool diffusive() const override;
  void measure_rates(const Warehouse& state, Reductions& rates) const override;
  StepLimit step_limit(const std::vector<double>& maxima) const override;
  void add_totals(const Warehouse& state, const LevelCoverage& coverage,
                  Totals& totals) const override;
  StepBalance balance(const std::vector<double>& sums, const StepStart* start,
                      double dt) const override;
  std::vector<std::string> tracked_names() const override;
  std::vector<double> tracked_totals(const std::vector<double>& sums) const override;
  double history_value(Label label, const Totals& totals) const override;
  Vec3 history_vector(Label label, const Totals& totals) const override;
  std::string describe_fault(int kind) const override { return fluid_.describe_fault(kind); }

 private:
  FluidPart fluid_;
};

}  // namespace sluice::ice
