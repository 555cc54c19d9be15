// Advances the state of one level: halo point, boundary, compiled step graphs, acceptance.
//
// Graph variants (which labels are stored this step, slopes masked or not) are compiled when first
// needed and kept, also when the level is laid out anew. Nothing of the old state is touched by an
// attempt: a rejected step is simply attempted again. A level that takes several substeps in one
// coarse step keeps its state at the start of it until the coarse step is accepted.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/base/reduction.hpp"
#include "framework/run/component/component.hpp"
#include "framework/run/component/run_control.hpp"
#include "framework/task/halo.hpp"
#include "framework/task/sweep_executor.hpp"

namespace sluice {

struct SolverOptions {
  int threads = 1;
  bool force_all = false;          // no block sleeps, nothing of a step is left out
  int sample_every = 0;            // time every n-th block; 0: never
  IntVec3 block{};                 // extents of a block; 0: chosen
  std::int64_t max_box_cells = 0;  // of boxes of adaptive levels; 0: no limit
  int substeps = 1;                // of this level in one coarse step
  std::shared_ptr<const ThreadTeam> team = nullptr;  // of `threads`; none: an own one
  bool joined = false;  // one of several levels: fluxes are recorded, sums count uncovered cells
};

struct StepAttempt {
  std::vector<double> maxima;  // over all ranks
  std::vector<double> sums;    // over all ranks, exact
  std::int64_t faults = 0;     // inadmissible cells, over all ranks
  CellFault first_fault;       // the lowest of them
  RunControl::Answer control;  // clock and signals, agreed upon in the same message
};

// A cell of the state that is not a number.
struct UnsoundCell {
  CellFault where;  // kind: the slot
  Label label;
};

class LevelSolver {
 public:
  // Of the state: ghosts hold what the cells do that they stand for.
  static constexpr Arrays arrays = Arrays::shared;

  LevelSolver(const Component& component, const Level& level, Communicator& communicator,
              const SolverOptions& options);
  ~LevelSolver();
  LevelSolver(const LevelSolver&) = delete;
  LevelSolver& operator=(const LevelSolver&) = delete;

  const Level& level() const { return level_; }
  Warehouse& state() { return state_; }
  const Warehouse& state() const { return state_; }
  // The state before the last accepted attempt of this coarse step.
  const Warehouse& previous() const { return next_; }
  // The state at the start of the coarse step, once it was advanced and until it is accepted.
  const Warehouse& start() const { return start_kept_ ? start_ : next_; }
  Warehouse& outputs() { return outputs_; }
  const Warehouse& outputs() const { return outputs_; }
  const std::vector<int>& state_slots() const { return state_slots_; }
  const ThreadTeam* team() const { return team_.get(); }

  // Other boxes of the same level, other cells: the state so far is handed back, the new one is to
  // be filled by the caller (interior cells).
  Warehouse lay_out(std::vector<GridBox> boxes);
  // Where this level meets others; tables and boxes of finer levels belong to the caller.
  void join(const FluxRecorder& recorder, LevelCoverage coverage);
  const LevelCoverage& coverage() const { return coverage_; }
  // Control volumes on the boxes as they are now.
  void watch(VolumeFaces volumes) { volumes_ = std::move(volumes); }

  // Fills all ghost cells of the current state, unless it was done already. `interface`, where
  // given, fills those at the interface with a coarser level, before the boundary of the domain;
  // `coarsest`, of a finer level: whose boundary sums hold.
  void fill_ghosts(double time, const std::function<void(Warehouse&)>& interface = nullptr,
                   const LevelSolver* coarsest = nullptr);
  // The interior of the state was changed: ghosts are to be filled anew, blocks to be looked at.
  void mark_modified() {
    ghosts_filled_ = false;
    state_.forget();
  }
  // One attempt at a step from the current state; ghosts must be filled. Step labels in `wanted`
  // are stored in outputs(). Without `rates` the maxima mean nothing.
  const StepAttempt& attempt(double time, double dt, const std::vector<Label>& wanted,
                             const RunControl* control, bool rates = true);
  // Stores step labels of the current state in outputs() and computes nothing else; ghosts must be
  // filled.
  void prepare(double time, double dt, const std::vector<Label>& stored);
  // Ghosts of a work slot (Component::work_slots), by copies and at the sides of the domain.
  void fill_work_ghosts(Label label);
  // Length of the step before the next attempt; 0: none.
  void set_previous_dt(double dt) { previous_dt_ = dt; }
  const StepAttempt& attempt_result() const { return attempt_; }
  // The new state of the last attempt, interior cells: stages behind a sweep may change it.
  Warehouse& attempted() { return next_; }
  // The last attempt becomes the current state; masks are forgotten.
  void advance();
  // The coarse step is accepted: what it began with is no longer needed.
  void accept() {
    advanced_ = 0;
    start_kept_ = false;
  }
  // Back to the state at the start of the coarse step.
  void reject();
  // Redo: slopes vanish in the cells that the last attempt found inadmissible (and in those found
  // before, within the same step); where all of them were masked, in the cells next to those
  // masked (of a single level; of several a smaller step is tried). The number of cells masked
  // now, over all ranks.
  std::int64_t mask_faults();

  // The lowest cell whose state at the start of the step is not a finite number, over all ranks:
  // no smaller step can help it.
  std::optional<UnsoundCell> unsound_start();

  // Stores labels that are functions of the current state in outputs(); ghosts must be filled.
  void compute_diagnostics(double time, const std::vector<Label>& wanted);

  bool is_step_label(Label label) const;
  bool is_diagnostic_label(Label label) const;
  std::vector<double> initial_rates();  // maxima of the current state, over all ranks

  // What was spent so far.
  std::vector<double> effect_seconds() const;  // by effect
  // Tasks of the plain step, by effect: the most of any kind of block that occurred.
  std::vector<int> effect_tasks() const;
  std::vector<double> effect_doubles() const;  // doubles a cell of scratch rings, by effect
  std::vector<double> box_seconds() const;     // by local box, since the level was laid out
  std::int64_t blocks_run() const, blocks_skipped() const, cells_skipped() const;
  std::int64_t blocks_run(int kind) const;
  std::size_t memory_bytes() const;
  std::size_t message_bytes() const;
  // Of the plain step; of the last kind where none is named.
  std::string graph_as_dot(int kind = -1);
  const SweepPlan& plain_plan(int kind = -1);

 private:
  struct Variant;
  Variant& variant(bool masked, const std::vector<Label>& wanted);
  Variant& diagnostics(const std::vector<Label>& wanted);
  Variant& preparation(const std::vector<Label>& wanted);
  bool chooses_kinds() const;
  std::int64_t widen_masks(int slot);
  void spread_masks(int slot);
  // What a graph is compiled for: labels of a state, of a step without its new state, a step.
  enum class Purpose { diagnostic, preparation, step };
  std::unique_ptr<Variant> make_variant(bool masked, Purpose purpose,
                                        const std::vector<Label>& wanted);
  SweepGraph graph_of(const TaskList& list, Purpose purpose,
                      const std::vector<Label>& wanted) const;
  std::vector<AbsentSlot> absent_slots(const TaskList& list, Purpose purpose, int kind,
                                       const std::vector<Label>& wanted) const;
  void sum_for_boundary();
  void reduce(const Reductions& local, const RunControl* control);
  CellFault lowest_of_ranks(bool found, const CellFault& lowest);

  void add_state_slot(SlotInfo info, Contents contents = Contents::zero);
  void bind(Variant& variant);
  SweepOptions sweep_options(Purpose purpose, bool storing) const;
  StepConstants constants(double time, double dt, bool rates) const;

  const Component* component_;
  Level level_;
  Communicator* communicator_;
  SolverOptions options_;
  Warehouse state_, next_, start_, outputs_;
  FluxRecorder recorder_;
  VolumeFaces volumes_;
  LevelCoverage coverage_;
  std::vector<int> state_slots_;
  std::shared_ptr<const ThreadTeam> team_;
  std::unique_ptr<HaloExchange> halo_;
  std::map<std::pair<bool, std::vector<Label>>, std::unique_ptr<Variant>> variants_;
  std::map<std::vector<Label>, std::unique_ptr<Variant>> diagnostics_, preparations_;
  std::vector<Variable> step_outputs_, diagnostic_outputs_;
  std::vector<Label> step_labels_, diagnostic_labels_;
  Reductions last_;
  StepAttempt attempt_;
  std::vector<double> boundary_sums_;  // of the coarsest level, as its ghosts were filled last
  Reduction reduction_;
  bool masked_ = false, ghosts_filled_ = false;
  bool start_kept_ = false;  // in start_; else in state_ or, after one substep, in next_
  double previous_dt_ = 0;
  int advanced_ = 0;  // substeps of this coarse step
  int layout_ = 0;    // counts the calls of lay_out and join
  int boxes_ = 0;     // counts the calls of lay_out
};

}  // namespace sluice
