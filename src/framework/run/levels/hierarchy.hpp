// All levels of a run and one coarse step over them: the W-cycle, matched fluxes, restriction.
//
// A coarse step advances level l by dt_l, then level l + 1 by its substeps, then makes the fluxes
// of both agree and puts the averages of level l + 1 into the cells below. Nothing is kept of an
// attempt that is rejected: every level goes back to the start of the coarse step.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "framework/refine/interface_distance.hpp"
#include "framework/refine/level_transfer.hpp"
#include "framework/refine/regridder.hpp"
#include "framework/run/component/event_ledger.hpp"
#include "framework/run/component/grid_fields.hpp"
#include "framework/run/component/run_report.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "framework/run/levels/refinement_flags.hpp"
#include "framework/scene/scene.hpp"
#include "framework/task/schedule.hpp"

namespace sluice {

class ArchiveStep;

// What one attempt at a coarse step came to.
struct CycleResult {
  bool good = true;
  CellFault first_fault;     // of the substep that could not be had
  std::int64_t faults = 0;   // inadmissible cells there
  bool unmatched = false;    // it was the matching of fluxes that failed
  std::vector<double> sums;  // over levels and substeps
  RunControl::Answer control;
  // The state at the start of the step holds what is no number: no smaller step can help.
  std::optional<UnsoundCell> unsound;
  std::string reason;  // why a stage of the step rejected it; empty: inadmissible cells
};

class Hierarchy {
 public:
  Hierarchy(const Scene& scene, const Component& component, Communicator& communicator,
            const SolverOptions& options);
  ~Hierarchy();

  // Levels that exist now, coarse to fine.
  int level_count() const;
  int possible_levels() const { return static_cast<int>(solvers_.size()); }
  LevelSolver& level(int l) { return *solvers_[l]; }
  const LevelSolver& level(int l) const { return *solvers_[l]; }
  Grid grid() const;  // of the levels that exist now
  std::int64_t cell_count() const;

  // The state at the start: levels are added until the hierarchy settles.
  void initialise();
  // The state of a checkpoint, on its hierarchy.
  void restore(const ArchiveStep& checkpoint);
  // The state of a hierarchy of another component on levels like these, between two steps: all that
  // is of particles, and what was spent. Collective.
  void succeed(const Hierarchy& earlier);

  // One attempt at a coarse step; labels in `wanted` are stored in its last substeps.
  const CycleResult& attempt(int step, double time, double dt, const std::vector<Label>& wanted,
                             const RunControl& control, EventLedger& ledger);
  void accept();
  void reject();
  // Asked in each attempt by components that have a stage for it (judge_step).
  void set_judge(StepJudge judge) { judge_ = std::move(judge); }
  // The step that the physics allows next, as a step of the coarsest level.
  StepLimit step_limit() const;
  // What it rests on, by level; a restart sets those of its checkpoint.
  const std::vector<std::vector<double>>& rates() const { return maxima_; }
  // Length of the last accepted step; a restart sets that of its checkpoint.
  void set_previous_dt(double dt) { previous_dt_ = dt; }
  void set_rates(std::vector<std::vector<double>> rates) { maxima_ = std::move(rates); }
  // Of the first step of a run: no longer than one step of the finest level. What bursts at the
  // start is faster than its state at rest tells, and refined levels follow only afterwards.
  StepLimit first_step_limit() const;
  // New levels where flags ask for them, after an accepted coarse step. True when boxes changed.
  bool regrid(int step);
  // Moves boxes to other ranks where that makes the busiest rank faster.
  bool balance(int step);

  // Ghost cells of all levels at the end of a coarse step.
  void fill_ghosts(double time);
  void compute_diagnostics(double time, const std::vector<Label>& wanted);
  void add_totals(Totals& totals) const;

  // What the last attempt at a step summed, over levels and ranks; empty before the first.
  const std::vector<double>& step_sums() const { return result_.sums; }
  // Fields that particles have on the grid, by level. Collective.
  std::vector<GridFields> particle_fields(const std::vector<Label>& labels,
                                          const ParticleCloud::Wanted& wanted);
  // Particles that lag behind in the box they came from go to their own, before they are written.
  void settle_particles();
  // Null when there are none.
  const ParticleCloud* particles() const { return particles_.get(); }
  std::string regrid_state() const;
  int regrids() const { return regrids_; }
  const Component& component() const { return *component_; }
  // Of the deck's analyses, in its order; none when the component keeps no account of them.
  const std::vector<VolumeCells>& volumes() const { return volumes_; }
  int layouts() const { return layouts_; }  // grows whenever boxes change
  double regrid_seconds() const { return regrid_seconds_; }
  int balances() const { return balances_; }
  double balance_seconds() const { return balance_seconds_; }
  std::vector<LevelCost> costs() const;
  std::string describe_cycle() const { return describe(cycle_); }

 private:
  // Where a level meets the next finer one.
  struct LevelInterface {
    Interpolation ghosts;
    FluxRegister fluxes;
    Restriction restriction;
  };

  Schedule schedule_of(int level);
  Schedule schedule_of(const StepShape& shape);
  Schedule cycle_of_levels();
  using LevelAction = std::function<Verdict(int level, const StepScope&)>;
  Node sweeping_node(std::string name, LevelAction act);
  Node stage_node(const StepShape::Stage& stage);
  Node iteration_node(const StepShape::Iterate& iterate);
  StageScope stage_scope(const StepScope& scope, StepJournal& journal);
  void fill(int level, double time);
  static bool ends_coarse_step(const StepScope& scope);
  void ask_control();
  Verdict sweep(int level, const StepScope& scope, const std::vector<Label>& stored);
  void commit(int level, const StepScope& scope);
  Verdict match(int level, const StepScope& scope);
  double share_of(int level) const;
  void make_joint(int coarser);
  void join_levels(int first = 0);
  void watch_volumes(int first);
  int lay_out(bool from_deck);
  void lay_out_level(int level, std::vector<GridBox> boxes, bool from_deck);
  int flagging_levels() const;
  int read_levels() const;
  std::vector<FlagField> flags();
  void restrict_all();
  void measure_rates(int levels_before);
  void return_memory();
  std::vector<LevelSolver*> existing_levels();
  void advance_particles();

  const Scene* scene_;
  const Component* component_;
  Communicator* communicator_;
  std::vector<std::unique_ptr<LevelSolver>> solvers_;
  std::vector<std::unique_ptr<LevelInterface>>
      interfaces_;                           // by coarser level, of the levels that exist
  std::vector<int> substeps_;                // of a level in one step of the next coarser one
  std::vector<int> done_;                    // of those, in the present step of the coarser one
  std::vector<int> in_coarse_step_;          // substeps of a level in a coarse step
  std::vector<double> ends_;                 // of the last sweep over a level: its time
  std::vector<std::vector<double>> maxima_;  // rates by level
  std::vector<LevelCost> costs_;
  std::vector<InterfaceDistance> ends_of_levels_;
  std::vector<VolumeCells> volumes_;
  std::optional<Regridder> regridder_;
  RefinementFlags refinement_flags_;
  std::unique_ptr<ParticleCloud> particles_;
  Schedule cycle_;
  StepShape::Link link_;
  int levels_in_cycle_ = 0;
  StepJudge judge_;
  StepJournal journal_;  // of the last attempt, until it is accepted or rejected
  CycleResult result_;
  // Of the attempt under way.
  int step_ = 0;
  int pass_ = 0;          // of an iteration within the step
  bool stopped_ = false;  // that iteration has no hope
  bool asked_ = false;    // this attempt: were clock and signals asked for
  double previous_dt_ = 0, dt_ = 0;
  double time_ = 0, end_ = 0;  // of the coarse step; time_ also of the states between steps
  bool advancing_ = false;
  const std::vector<Label>* wanted_ = nullptr;
  const RunControl* control_ = nullptr;
  EventLedger* ledger_ = nullptr;
  std::size_t max_bytes_ = 0;  // of all levels since memory was returned to the system
  int regrids_ = 0, last_balance_ = 0;
  int layouts_ = 0;
  int balances_ = 0;
  double regrid_seconds_ = 0, balance_seconds_ = 0;
};

}  // namespace sluice
