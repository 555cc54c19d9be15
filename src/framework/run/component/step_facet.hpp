// The step of a component: its tasks and stages, what they reduce, and how long it may be.
#pragma once
#include <string>
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/refine/coverage.hpp"
#include "framework/refine/flux_register.hpp"
#include "framework/refine/volume_faces.hpp"
#include "framework/run/component/step_shape.hpp"
#include "framework/task/reduction_layout.hpp"
#include "framework/task/reductions.hpp"
#include "framework/task/schedule.hpp"
#include "framework/task/task.hpp"

namespace sluice {

class LevelSolver;

// The next step that the physics allows, and what limits it.
struct StepLimit {
  double dt = 0;  // s
  std::string reason;
};

// Which of the graphs of a step is to be declared.
struct StepVariant {
  int level = 0;        // index; spacing, domain and boundary are that level's
  bool masked = false;  // slopes vanish where the mask slot is zero (a redone step)
  // With several levels: where fluxes are recorded and which cells count in sums. Both outlive the
  // graph; what they hold changes when boxes are laid out anew. Null with one level.
  const FluxRecorder* recorder = nullptr;
  const LevelCoverage* coverage = nullptr;
  int kind = 0;  // of the blocks that the graph is for: see BlockFacet::kinds
  // Control volumes whose exchange is summed, see BudgetFacet::volume_sums; likewise.
  const VolumeFaces* volumes = nullptr;
};

class StepFacet {
 public:
  virtual ~StepFacet() = default;

  // Tasks of a step. Every label that can be saved from within a step is declared as an output.
  // With a recorder, a task marked `always` records the conserved fluxes of the faces that it
  // names, and sums count uncovered cells only.
  virtual void declare(TaskList& list, const StepVariant& variant) const = 0;
  // Stages of a step that all levels take together (in lockstep); none: exchange, sweep, take over,
  // each level for itself. Asked for when levels come or go.
  virtual void declare_stages(StepShape& /*shape*/) const {}
  // Nodes of a step of a level before its ghost cells are filled: where particles are exchanged and
  // projected into the interior of level.state() (which is then to be touched). A coarse step may
  // be attempted several times: what lasts beyond it goes to the journal, in all ranks alike. Asked
  // for when levels come or go, not when their boxes change.
  virtual Schedule before_sweep(LevelSolver& /*level*/) const { return {}; }

  // The sums and maxima of a step, as the component's parts registered them: none.
  virtual const ReductionLayout& reductions() const;
  // Rates of a state, as the reductions of a step hold them (for the first step and restarts).
  virtual void measure_rates(const Warehouse& /*state*/, Reductions& /*rates*/) const {}
  // From the maxima as reductions() numbers them, in the component's units: rates in 1/s.
  virtual StepLimit limit(const std::vector<double>& maxima) const = 0;
  // Cells that a wave crosses in one step at its limit: flags are widened so that finer levels keep
  // it between two looks.
  virtual double courant_number() const { return 1; }
  // Does a limit of the step shrink with the square of the spacing.
  virtual bool diffusive() const { return false; }
  // Bytes that a step keeps beside the fields of the levels, at the start, on one rank;
  // `finest`: the finest level then.
  virtual double array_bytes(const Level& /*finest*/) const { return 0; }

  // Of the slot that is zero where a repeated step drops slopes.
  virtual Label mask_label() const;
  // "density", "internal energy": what a fault's kind means, with its unit and allowed range.
  virtual std::string describe_fault(int kind) const;
};

}  // namespace sluice
