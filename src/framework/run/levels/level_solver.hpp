// Advances the state of one level: its states, ghost cells, task graphs, and attempts at a step.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "framework/run/component/component.hpp"
#include "framework/run/levels/level_ghosts.hpp"
#include "framework/run/levels/level_states.hpp"
#include "framework/run/levels/slope_masks.hpp"
#include "framework/run/levels/solver_options.hpp"
#include "framework/run/levels/step_graphs.hpp"
#include "framework/run/levels/step_reduction.hpp"

namespace sluice {

class LevelSolver {
 public:
  LevelSolver(const Component& component, const Level& level, Communicator& communicator,
              const SolverOptions& options);
  LevelSolver(const LevelSolver&) = delete;
  LevelSolver& operator=(const LevelSolver&) = delete;

  const Level& level() const { return states_.level(); }
  Warehouse& state() { return states_.present(); }
  const Warehouse& state() const { return states_.present(); }
  const LevelStates& states() const { return states_; }
  const std::vector<int>& state_slots() const { return states_.slots(); }
  Warehouse& outputs() { return graphs_.outputs(); }
  const Warehouse& outputs() const { return graphs_.outputs(); }
  StepGraphs& graphs() { return graphs_; }
  const StepGraphs& graphs() const { return graphs_; }
  const ThreadTeam* team() const { return options_.team.get(); }

  // Other boxes of the same level, other cells: the state so far is handed back, the new one is to
  // be filled by the caller (interior cells).
  Warehouse lay_out(std::vector<GridBox> boxes);

  // Fills all ghost cells of the current state, unless it was done already: LevelGhosts::fill.
  void fill_ghosts(double time, const std::function<void(Warehouse&)>& interface = nullptr,
                   const LevelSolver* coarsest = nullptr);
  // Ghosts of a work slot (StateFacet::work_slots), by copies and at the sides of the domain.
  void fill_work_ghosts(Label label) { ghosts_.fill_work(label); }
  // The interior of the state was changed: ghosts are to be filled anew, blocks to be looked at.
  void mark_modified();

  // One attempt at a step from the current state; ghosts must be filled. Step labels in `wanted`
  // are stored in outputs(). Without `rates` the maxima mean nothing.
  const StepAttempt& attempt(double time, double dt, const std::vector<Label>& wanted,
                             const RunControl* control, bool rates = true);
  const StepAttempt& attempt_result() const { return reduction_.result(); }
  // Stores step labels of the current state in outputs() and computes nothing else; ghosts must be
  // filled.
  void prepare(double time, double dt, const std::vector<Label>& stored);
  // Length (s) of the step before the next attempt; 0: none.
  void set_previous_dt(double dt) { previous_dt_ = dt; }
  // The new state of the last attempt, interior cells: stages behind a sweep may change it.
  Warehouse& attempted() { return states_.next(); }
  // The last attempt becomes the current state; masks are forgotten.
  void advance();
  // The coarse step is accepted: what it began with is no longer needed.
  void accept() { states_.accept(); }
  // Back to the state at the start of the coarse step.
  void reject();
  // Redo: slopes vanish in the cells that the last attempt found inadmissible (SlopeMasks::add; of
  // several levels a smaller step is tried where none is left to mask).
  std::int64_t mask_faults();

  // The lowest cell whose state at the start of the step is not a finite number, over all ranks.
  std::optional<UnsoundCell> unsound_start() { return first_unsound_cell(states_, *communicator_); }
  // Stores labels that are functions of the current state in outputs(); ghosts must be filled.
  void compute_diagnostics(double time, const std::vector<Label>& wanted);
  std::vector<double> initial_rates();  // maxima of the state, over all ranks: LevelRates

  std::size_t memory_bytes() const { return states_.bytes() + graphs_.bytes(); }

 private:
  StepConstants constants(double time, double dt, bool rates) const;

  const Component* component_;
  Communicator* communicator_;
  SolverOptions options_;  // with a team
  LevelStates states_;
  LevelGhosts ghosts_;
  StepGraphs graphs_;
  SlopeMasks masks_;
  StepReduction reduction_;
  Reductions last_;  // of the last attempt, of this rank
  double previous_dt_ = 0;
};

}  // namespace sluice
