// ICE: cell-centred compressible flow as a component of a run.
#pragma once
#include <memory>

#include "framework/run/component.hpp"
#include "framework/run/particle_method.hpp"
#include "ice/boundary/boundary_fill.hpp"
#include "ice/deck/ice_scene.hpp"
#include "ice/levels/mixture_transfer.hpp"
#include "ice/sources/source_tasks.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

class Ice : public Component {
 public:
  Ice(const Scene& scene, IceScene ice_scene);

  std::string name() const override { return "ice"; }
  const EffectList& effects() const override { return effects_; }
  int material_count() const override { return static_cast<int>(ice_.materials.size()); }

  std::vector<SlotInfo> state_slots() const override;
  std::vector<std::vector<Label>> checkpoint_labels() const override;
  void initialise(Warehouse& state) const override;
  void fill_boundary(Warehouse& state, double time, std::span<const double> sums,
                     const ThreadTeam& team) const override;
  int boundary_sums() const override;
  void add_boundary_sums(const Warehouse& state, std::span<ExactSum> sums) const override;
  void declare_step(TaskList& list, const StepVariant& variant) const override;
  int step_kinds() const override;
  int step_kind(const Warehouse& old_state, int local_box,
                const IndexBox& cells_with_halo) const override;
  std::optional<double> absent_value(Label label, int material, int kind) const override;
  void declare_diagnostics(TaskList& list, int level) const override;
  const TransferOperators& transfer() const override { return *transfer_; }
  IntVec3 interface_depth(const Level& level) const override;
  Label refine_flag() const override;
  std::vector<ErrorEstimate> error_estimates() const override { return estimates_; }
  std::vector<FlagSeeds> flag_seeds(const Warehouse& state) const override;
  Label mask_label() const override;
  const ParticleMethod* particles() const override { return tracers_.get(); }
  int reduction_maxima() const override { return StepSlots::maxima; }
  int reduction_sums() const override;
  int first_volume_sum() const override;
  bool quiet_blocks_allowed() const override;
  double courant_number() const override { return options_.cfl; }
  bool diffusive() const override;
  void measure_rates(const Warehouse& state, Reductions& rates) const override;
  StepLimit step_limit(const std::vector<double>& maxima) const override;
  void add_totals(const Warehouse& state, const LevelCoverage& coverage,
                  Totals& totals) const override;
  StepBalance balance(const std::vector<double>& sums, const StepStart* start,
                      double dt) const override;
  std::vector<std::string> tally_names() const override;
  std::vector<double> tallies(const std::vector<double>& sums) const override;
  double history_value(Label label, const Totals& totals) const override;
  Vec3 history_vector(Label label, const Totals& totals) const override;
  std::string describe_fault(int kind) const override;

 private:
  void declare_conservative(TaskList& list, const SchemeOptions& options) const;
  void declare_mixture(TaskList& list, const SchemeOptions& options) const;
  void declare_slip(TaskList& list, const SchemeOptions& options) const;
  SchemeOptions at_level(int level) const;
  int step_sums() const;  // without those of control volumes

  const Scene* scene_;
  IceScene ice_;
  EffectList effects_;
  SchemeOptions options_;  // of level 0; the levels differ in what at_level() sets
  std::vector<std::unique_ptr<BoundaryFill>> boundary_;  // by level
  std::vector<std::unique_ptr<Sources>> sources_;        // by level; empty: there are none
  std::unique_ptr<ParticleMethod> tracers_;              // null: none
  std::unique_ptr<TransferOperators> transfer_;
  std::vector<ErrorEstimate> estimates_;
};

// What the scene calls for and what it does not, with the deck lines.
EffectList find_effects(const Scene& scene, const IceScene& ice);

// The last of them, known once the boundary is.
Effect open_faces(const IceScene& ice, const BoundaryFill& boundary);

// Whether levels are made to agree on what passes between them: always, but for the classic form.
bool matches_fluxes(const Scene& scene, const IceScene& ice);


}  // namespace sluice::ice
