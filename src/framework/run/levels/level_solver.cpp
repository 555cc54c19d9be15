#include "framework/run/levels/level_solver.hpp"

#include <algorithm>
#include <utility>

namespace sluice {
namespace {

SolverOptions with_team(SolverOptions options) {
  if (options.team == nullptr) options.team = std::make_shared<const ThreadTeam>(options.threads);
  return options;
}

std::vector<Label> sorted(std::vector<Label> labels) {
  std::sort(labels.begin(), labels.end());
  return labels;
}

}  // namespace

LevelSolver::LevelSolver(const Component& component, const Level& level, Communicator& communicator,
                         const SolverOptions& options)
    : component_(&component),
      communicator_(&communicator),
      options_(with_team(options)),
      states_(component.state(), level, communicator.rank(), options.substeps),
      ghosts_(component.state(), states_, communicator, options_.team),
      graphs_(component, states_, communicator, options_),
      masks_(component.step().mask_label(), states_, ghosts_, communicator),
      reduction_(communicator, component.step().reductions()) {}

Warehouse LevelSolver::lay_out(std::vector<GridBox> boxes) {
  Warehouse before = states_.lay_out(std::move(boxes));
  ghosts_.lay_out();
  graphs_.lay_out();
  return before;
}

void LevelSolver::fill_ghosts(double time, const std::function<void(Warehouse&)>& interface,
                              const LevelSolver* coarsest) {
  ghosts_.fill(time, interface, coarsest == nullptr ? nullptr : &coarsest->ghosts_);
}

void LevelSolver::mark_modified() {
  ghosts_.mark_stale();
  states_.present().forget();
}

const StepAttempt& LevelSolver::attempt(double time, double dt, const std::vector<Label>& wanted,
                                        const RunControl* control, bool rates) {
  states_.store_start_state();
  last_ = graphs_.step(masks_.any(), sorted(wanted)).run(constants(time, dt, rates));
  return reduction_.reduce(last_, control);
}

void LevelSolver::prepare(double time, double dt, const std::vector<Label>& stored) {
  graphs_.preparation(sorted(stored)).run(constants(time, dt, false));
}

StepConstants LevelSolver::constants(double time, double dt, bool rates) const {
  return {time, dt, level().spacing, level().index, rates || options_.force_all, previous_dt_};
}

void LevelSolver::advance() {
  states_.advance();
  masks_.clear();
  ghosts_.mark_stale();
}

void LevelSolver::reject() {
  if (states_.reject()) ghosts_.mark_stale();
  masks_.clear();
}

std::int64_t LevelSolver::mask_faults() {
  return masks_.add(last_.faults(), attempt_result().faults);
}

void LevelSolver::compute_diagnostics(double time, const std::vector<Label>& wanted) {
  if (wanted.empty()) return;
  graphs_.diagnostics(sorted(wanted)).run({time, 0.0, level().spacing, level().index});
}

std::vector<double> LevelSolver::initial_rates() {
  const ReductionLayout& layout = component_->step().reductions();
  Reductions rates(layout.maxima(), layout.sums());
  component_->step().measure_rates(state(), rates);
  return reduction_.reduce(rates, nullptr).maxima;
}

}  // namespace sluice
