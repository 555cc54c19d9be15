// The fluid of a scene as a part of a component: its materials and options, rules of its boundary,
// sources, tracers, effects and reductions. The facets of a component (fluid_state.hpp,
// fluid_step.hpp, ...) are made of it. Numbers of effects, reductions, faults and materials are the
// part's own: the list of tasks adds its places.
#pragma once
#include <memory>

#include "framework/refine/volume_faces.hpp"
#include "framework/run/component/particle_method.hpp"
#include "framework/task/effect.hpp"
#include "framework/task/reduction_layout.hpp"
#include "ice/boundary/boundary_fill.hpp"
#include "ice/deck/ice_scene.hpp"
#include "ice/pressure/solve_history.hpp"
#include "ice/sources/sources.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

class FluidPart {
 public:
  // `reductions`: of the component; the fluid's are added to them. Those of `places` are set here.
  FluidPart(const Scene& scene, IceScene ice_scene, IndexOffsets places,
            std::shared_ptr<ReductionLayout> reductions);

  const EffectList& effects() const { return effects_; }
  int material_count() const { return static_cast<int>(ice_.materials.size()); }
  const Scene& run_scene() const { return *scene_; }
  const IceScene& scene() const { return ice_; }
  const SchemeOptions& options() const { return options_; }  // of level 0, whatever the graph
  SchemeOptions at_level(int level) const;
  const BoundaryFill& boundary(int level) const { return *boundary_[level]; }
  bool has_sources() const { return !sources_.empty(); }
  // Work fields by which the sweep knows solids.
  std::vector<SlotInfo> wall_slots() const;
  // Null: there are none.
  const ParticleMethod* tracers() const { return tracers_.get(); }

  // Of the component, and the fluid's own among them.
  const ReductionLayout& reductions() const { return *reductions_; }
  const SumGroup& sums() const { return options_.budgets.places.sums; }
  const MaximumGroup& maxima() const { return options_.budgets.places.maxima; }
  VolumeSums volume_sums() const;

  // What the last step's pressure solves took; written by the step.
  const pressure::SolveHistory& solves() const { return *solves_; }
  const std::shared_ptr<pressure::SolveHistory>& solve_history() const { return solves_; }

 private:
  void register_reductions();

  const Scene* scene_;
  IceScene ice_;
  EffectList effects_;
  SchemeOptions options_;  // the levels differ in what at_level() sets
  std::shared_ptr<ReductionLayout> reductions_;
  std::vector<std::unique_ptr<BoundaryFill>> boundary_;  // by level
  std::vector<std::unique_ptr<Sources>> sources_;        // by level; empty: there are none
  std::unique_ptr<ParticleMethod> tracers_;              // null: none
  std::shared_ptr<pressure::SolveHistory> solves_ = std::make_shared<pressure::SolveHistory>();
};

// What the scene calls for and what it does not, with the deck lines.
EffectList find_effects(const Scene& scene, const IceScene& ice);

// The effect of open faces, the last of that list: needs the rules of the boundary.
Effect open_faces(const IceScene& ice, const BoundaryFill& boundary);

// Whether levels are made to agree on what passes between them: always, but for the classic form.
bool matches_fluxes(const Scene& scene, const IceScene& ice);

}  // namespace sluice::ice
