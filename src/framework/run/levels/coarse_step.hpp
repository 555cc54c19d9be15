// One coarse step over all levels: the W-cycle, matched fluxes, restriction.
//
// A coarse step advances level l by dt_l, then level l + 1 by its substeps, then makes the fluxes
// of both agree and puts the averages of level l + 1 into the cells below. A component that
// declares stages (step_shape.hpp) has them carried out on all levels in lockstep, and the levels
// matched at the end, finest first. Nothing is kept of an attempt that is rejected: every level
// goes back to the start of the coarse step.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/run/component/event_ledger.hpp"
#include "framework/run/levels/ghosts_in_time.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "framework/run/levels/stage_costs.hpp"
#include "framework/task/schedule.hpp"

namespace sluice {

// What one attempt at a coarse step came to.
struct CycleResult {
  bool good = true;
  CellFault first_fault;     // of the substep that could not be had
  std::int64_t faults = 0;   // inadmissible cells there
  bool unmatched = false;    // it was the matching of fluxes that failed
  std::vector<double> sums;  // over levels and substeps, as StepFacet::reductions() numbers them
  RunControl::Answer control;
  // The state at the start of the step holds what is no number: no smaller step can help.
  std::optional<UnsoundCell> unsound;
  std::string reason;  // why a stage of the step rejected it; empty: inadmissible cells
};

// What the run asks of one coarse step.
struct CoarseStepRequest {
  int step = 0;
  double time = 0, dt = 0;                     // start and length, s
  const std::vector<Label>* wanted = nullptr;  // labels stored in its last substeps
  const RunControl* control = nullptr;
  EventLedger* ledger = nullptr;
};

class CoarseStep {
 public:
  // `particles`: null without any. `maxima`: of the last sweep over each level (LevelRates),
  // written here.
  CoarseStep(const Component& component, Levels& levels, GhostsInTime& ghosts,
             Communicator& communicator, ParticleCloud* particles,
             std::vector<std::vector<double>>& maxima);

  // Makes the schedule of the levels that exist now, unless it is that already.
  void renew();
  std::string describe() const { return sluice::describe(cycle_); }

  const CycleResult& attempt(const CoarseStepRequest& request);
  // What the last attempt came to; sums are empty before the first.
  const CycleResult& result() const { return result_; }
  void accept();
  void reject();
  // Asked in each attempt by components that have a stage for it (judge_step).
  void set_judge(StepJudge judge) { judge_ = std::move(judge); }
  // Length (s) of the last accepted step; a restart sets that of its checkpoint.
  double previous_dt() const { return previous_dt_; }
  void set_previous_dt(double dt) { previous_dt_ = dt; }
  // Of the stages that the component declares; none: it declares no step of its own.
  const std::vector<StageCost>& stage_costs() const { return stage_costs_.all(); }
  // What a stage sees between two steps, at `time` (s).
  StageScope scope_between_steps(double time);

 private:
  using LevelAction = std::function<Verdict(int level, const StepScope&)>;

  Schedule schedule_of(int level);
  Schedule schedule_of(const StepShape& shape);
  Node sweeping_node(std::string name, LevelAction act);
  Node measured(Stage stage);
  Node stage_node(const StepShape::Stage& stage);
  Node iteration_node(const StepShape::Iterate& iterate);
  StageScope stage_scope(const StepScope& scope, StepJournal& journal);
  Verdict sweep(int level, const StepScope& scope, const std::vector<Label>& stored);
  void commit(int level, const StepScope& scope);
  Verdict match(int level);
  void ask_control();

  const Component* component_;
  Levels* levels_;
  GhostsInTime* ghosts_;
  Communicator* communicator_;
  ParticleCloud* particles_;
  std::vector<std::vector<double>>* maxima_;
  Schedule cycle_;
  int levels_in_cycle_ = 0;
  StepShape::Link link_;
  StepJudge judge_;
  StepJournal journal_;  // of the last attempt, until it is accepted or rejected
  CycleResult result_;
  // Of the attempt under way.
  struct Attempt {
    CoarseStepRequest request;
    int pass = 0;          // of an iteration within the step
    bool stopped = false;  // that iteration has no hope
    bool asked = false;    // were clock and signals asked for
  };
  Attempt attempt_;
  double previous_dt_ = 0;
  StageCosts stage_costs_;
};

}  // namespace sluice
