// The fluid of a scene as a part of a component: what it stores, its tables of tasks, boundaries,
// sources, accounts. A component of the fluid alone (ice.hpp) hands each call on; one of several
// parts asks each of them. Numbers of effects, reductions, faults and materials are the part's
// own: the list of tasks adds its places.
#pragma once
#include <functional>
#include <memory>

#include "framework/run/component/component.hpp"
#include "framework/run/component/particle_method.hpp"
#include "ice/boundary/boundary_fill.hpp"
#include "ice/deck/ice_scene.hpp"
#include "ice/pressure/solve_history.hpp"
#include "ice/sources/sources.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

class FluidPart {
 public:
  FluidPart(const Scene& scene, IceScene ice_scene, IndexOffsets places = {});

  const EffectList& effects() const { return effects_; }
  int material_count() const { return static_cast<int>(ice_.materials.size()); }
  const IceScene& scene() const { return ice_; }
  const SchemeOptions& options() const { return options_; }  // of level 0, whatever the graph
  SchemeOptions at_level(int level) const;
  SchemeOptions graph_options(const StepVariant& variant) const;
  const BoundaryFill& boundary(int level) const { return *boundary_[level]; }

  std::vector<SlotInfo> state_slots() const;
  std::vector<std::vector<Label>> checkpoint_labels() const;
  void initialise(Warehouse& state) const;

  void declare_step(TaskList& list, const StepVariant& variant) const;
  void declare_diagnostics(TaskList& list, int level) const;
  void shape_step(StepShape& shape) const;
  // The passes of a semi-implicit step up to the new state, as a part of a larger step; in each,
  // `behind_solve` (may be empty) declares what acts between the solve and the sweep.
  void declare_passes(StepShape& shape, const std::function<void(StepShape&)>& behind_solve) const;
  std::vector<SlotInfo> work_slots() const;
  // Of them, what the sweep is told of solids.
  std::vector<SlotInfo> wall_slots() const;
  int step_kinds() const;
  int step_kind(const Warehouse& old_state, int local_box, const IndexBox& cells_with_halo) const;

  // What the last step's pressure solves took.
  const pressure::SolveHistory& solves() const { return *solves_; }

  const TransferOperators& transfer() const { return *transfer_; }
  IntVec3 interface_depth(const Level& level) const;
  const std::vector<ErrorEstimate>& error_estimates() const { return estimates_; }
  std::vector<FlagSeeds> flag_seeds(const Warehouse& state) const;
  const ParticleMethod* tracers() const { return tracers_.get(); }

  int first_volume_sum() const;
  int reduction_sums() const;
  bool skipping_allowed() const;
  // Blocks that solids meet: what the sweep leaves there is no state yet.
  bool has_cut_cells(int kind) const { return ice_.solids > 0 && kind == cut_kind(); }
  std::string describe_fault(int kind) const;

 private:
  int cut_kind() const { return step_kinds() - 1; }
  bool meets_solid(const Warehouse& state, int box, const IndexBox& cells) const;

  const Scene* scene_;
  IceScene ice_;
  EffectList effects_;
  SchemeOptions options_;  // the levels differ in what at_level() sets
  std::vector<std::unique_ptr<BoundaryFill>> boundary_;  // by level
  std::vector<std::unique_ptr<Sources>> sources_;        // by level; empty: there are none
  std::unique_ptr<ParticleMethod> tracers_;              // null: none
  std::unique_ptr<TransferOperators> transfer_;
  std::vector<ErrorEstimate> estimates_;
  std::shared_ptr<pressure::SolveHistory> solves_ = std::make_shared<pressure::SolveHistory>();
};

// What the scene calls for and what it does not, with the deck lines.
EffectList find_effects(const Scene& scene, const IceScene& ice);

// The effect of open faces, the last of that list: needs the rules of the boundary.
Effect open_faces(const IceScene& ice, const BoundaryFill& boundary);

// Whether levels are made to agree on what passes between them: always, but for the classic form.
bool matches_fluxes(const Scene& scene, const IceScene& ice);

}  // namespace sluice::ice
