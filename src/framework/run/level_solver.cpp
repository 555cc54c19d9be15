// Compiling graph variants and running attempts.
#include "framework/run/level_solver.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"

namespace sluice {

struct LevelSolver::Variant {
  TaskList list;
  std::unique_ptr<SweepExecutor> executor;
};

namespace {

std::vector<Label> output_labels(const TaskList& list) {
  std::vector<Label> labels;
  for (const Variable& v : list.variables())
    if (v.storage == Storage::output) labels.push_back(v.label);
  std::sort(labels.begin(), labels.end());
  return labels;
}

Axes active_axes(const Level& level) {
  Axes axes;
  axes.count = 0;
  for (int d = 0; d < 3; ++d)
    if (level.active[static_cast<std::size_t>(d)]) axes.direction[axes.count++] = d;
  return axes;
}

bool contains(const std::vector<Label>& labels, Label l) {
  return std::binary_search(labels.begin(), labels.end(), l);
}

}  // namespace

LevelSolver::LevelSolver(const Component& component, const Level& level, Communicator& communicator,
                         const SolverOptions& options)
    : component_(&component),
      level_(&level),
      communicator_(&communicator),
      options_(options),
      state_(level, communicator.rank()),
      next_(level, communicator.rank()),
      outputs_(level, communicator.rank()),
      team_(std::make_shared<const ThreadTeam>(options.threads)) {
  int width = 0;
  for (const SlotInfo& s : component.state_slots()) {
    state_slots_.push_back(state_.add(s));
    next_.add(s);
    width = std::max(width, s.ghosts);
  }
  halo_ = std::make_unique<HaloExchange>(level, width, communicator.rank());
  TaskList step, diagnostic;
  component.declare_step(step, StepVariant{level.index});
  component.declare_diagnostics(diagnostic, level.index);
  step_labels_ = output_labels(step);
  diagnostic_labels_ = output_labels(diagnostic);
}

LevelSolver::~LevelSolver() = default;

bool LevelSolver::is_step_label(Label label) const {
  return contains(step_labels_, label);
}
bool LevelSolver::is_diagnostic_label(Label label) const {
  return contains(diagnostic_labels_, label);
}

std::unique_ptr<LevelSolver::Variant> LevelSolver::compile_variant(
    bool masked, bool diagnostic, const std::vector<Label>& wanted) {
  auto v = std::make_unique<Variant>();
  if (diagnostic)
    component_->declare_diagnostics(v->list, level_->index);
  else
    component_->declare_step(v->list, StepVariant{level_->index, masked});
  std::vector<VariableId> wanted_variables;
  for (std::size_t n = 0; n < v->list.variables().size(); ++n) {
    const Variable& variable = v->list.variables()[n];
    const bool output = variable.storage == Storage::output;
    if (variable.storage != Storage::new_state && !(output && contains(wanted, variable.label)))
      continue;
    wanted_variables.push_back({static_cast<int>(n)});
    if (output)
      outputs_.add({variable.label, variable.material, variable.components,
                    variable.face_direction >= 0 ? 1 : 0});
  }
  SweepOptions o;
  o.threads = options_.threads;
  o.team = team_;
  o.block = options_.block;
  o.quiet_blocks =
      !options_.force_all && !diagnostic && wanted.empty() && component_->quiet_blocks_allowed();
  o.sample_every = diagnostic ? 0 : options_.sample_every;
  if (!diagnostic) {
    o.maxima = component_->reduction_maxima();
    o.sums = component_->reduction_sums();
  }
  v->executor = std::make_unique<SweepExecutor>(
      v->list, compile(v->list, component_->effects(), wanted_variables, active_axes(*level_)),
      *level_, o);
  v->executor->bind(state_, next_, &outputs_);
  return v;
}

LevelSolver::Variant& LevelSolver::variant(bool masked, const std::vector<Label>& wanted) {
  auto& v = variants_[{masked, wanted}];
  if (v == nullptr) v = compile_variant(masked, false, wanted);
  return *v;
}

LevelSolver::Variant& LevelSolver::diagnostics(const std::vector<Label>& wanted) {
  auto& v = diagnostics_[{false, wanted}];
  if (v == nullptr) v = compile_variant(false, true, wanted);
  return *v;
}

void LevelSolver::fill_ghosts(double time) {
  halo_->run(state_, state_slots_);
  component_->fill_boundary(state_, time, *team_);
}

const StepAttempt& LevelSolver::attempt(double time, double dt, const std::vector<Label>& wanted,
                                        const RunControl& control) {
  std::vector<Label> stored = options_.force_all ? step_labels_ : wanted;
  std::sort(stored.begin(), stored.end());
  const StepConstants step{time, dt, level_->spacing, level_->index};
  last_ = variant(masked_, stored).executor->run(step);
  reduce(last_, &control);
  return attempt_;
}

void LevelSolver::reduce(const Reductions& local, const RunControl* control) {
  CellFault lowest;
  for (const CellFault& f : local.faults())
    if (&f == &local.faults().front() || before(f, lowest)) lowest = f;
  attempt_.first_fault = lowest;
  attempt_.maxima.resize(static_cast<std::size_t>(local.maxima_count()));
  attempt_.sums.resize(static_cast<std::size_t>(local.sum_count()));
  reduction_.clear();
  const auto faults = reduction_.add_count(local.fault_count());
  RunControl::Question question{};
  if (control != nullptr) question = control->ask(reduction_);
  if (communicator_->size() == 1) {
    for (int m = 0; m < local.maxima_count(); ++m)
      attempt_.maxima[static_cast<std::size_t>(m)] = local.maximum(m);
    for (int s = 0; s < local.sum_count(); ++s)
      attempt_.sums[static_cast<std::size_t>(s)] = local.sum(s).value();
  } else {
    std::vector<Reduction::Maximum> maxima;
    std::vector<Reduction::Sum> sums;
    for (int m = 0; m < local.maxima_count(); ++m)
      maxima.push_back(reduction_.add_maximum(local.maximum(m)));
    for (int s = 0; s < local.sum_count(); ++s) sums.push_back(reduction_.add_sum(local.sum(s)));
    communicator_->reduce(reduction_);
    for (std::size_t m = 0; m < maxima.size(); ++m)
      attempt_.maxima[m] = reduction_.maximum(maxima[m]);
    for (std::size_t s = 0; s < sums.size(); ++s)
      attempt_.sums[s] = reduction_.sum(sums[s]).value();
  }
  attempt_.faults = reduction_.count(faults);
  if (control != nullptr) attempt_.control = control->read(reduction_, question);
  if (attempt_.faults > 0 && communicator_->size() > 1)
    attempt_.first_fault = lowest_of_ranks(local.fault_count() > 0, lowest);
}

// Rare: the lowest of the cells that ranks have found.
CellFault LevelSolver::lowest_of_ranks(bool found, const CellFault& lowest) {
  std::string mine;
  if (found) mine.assign(reinterpret_cast<const char*>(&lowest), sizeof lowest);
  bool first = true;
  CellFault lowest_of_all = lowest;
  for (const std::string& text : communicator_->gather_to_all(mine)) {
    if (text.size() != sizeof(CellFault)) continue;
    CellFault f;
    std::copy(text.begin(), text.end(), reinterpret_cast<char*>(&f));
    if (first || before(f, lowest_of_all)) lowest_of_all = f;
    first = false;
  }
  return lowest_of_all;
}

std::optional<UnsoundCell> LevelSolver::unsound_start() {
  CellFault lowest;
  std::int64_t found = 0;
  for (const int slot : state_slots_)
    for (int b = 0; b < static_cast<int>(state_.local_boxes().size()); ++b)
      for (int c = 0; c < state_.info(slot).components; ++c) {
        const RealView v = state_.view(slot, c, b);
        for_each_cell(state_.local_boxes()[static_cast<std::size_t>(b)].cells, [&](IntVec3 cell) {
          if (std::isfinite(v(cell))) return;
          const CellFault f{cell, level_->index, state_.info(slot).material, slot, v(cell)};
          if (found == 0 || before(f, lowest)) lowest = f;
          ++found;
        });
      }
  Reduction all;
  const auto count = all.add_count(found);
  communicator_->reduce(all);
  if (all.count(count) == 0) return std::nullopt;
  lowest = lowest_of_ranks(found > 0, lowest);
  return UnsoundCell{lowest, state_.info(lowest.kind).label};
}

void LevelSolver::accept() {
  state_.swap(next_);
  masked_ = false;
}

std::int64_t LevelSolver::mask_faults(double time) {
  const SlotInfo info{component_->mask_label(), 0, 1, state_.info(state_slots_.front()).ghosts};
  const int slot = state_.add(info);
  next_.add(info);
  if (!masked_)
    for (int b = 0; b < static_cast<int>(state_.local_boxes().size()); ++b) {
      const RealView v = state_.view(slot, 0, b);
      std::fill_n(v.data, v.box.volume(), 1.0);
    }
  std::int64_t now = 0;
  for (const CellFault& f : last_.faults())
    for (int b = 0; b < static_cast<int>(state_.local_boxes().size()); ++b) {
      if (!state_.local_boxes()[static_cast<std::size_t>(b)].cells.contains(f.cell)) continue;
      double& mask = state_.view(slot, 0, b)(f.cell);
      now += mask != 0.0;
      mask = 0.0;
    }
  halo_->run(state_, {slot});
  component_->fill_boundary(state_, time, *team_);
  masked_ = true;
  Reduction all;
  const auto count = all.add_count(now);
  communicator_->reduce(all);
  return all.count(count);
}

void LevelSolver::compute_diagnostics(double time, const std::vector<Label>& wanted) {
  std::vector<Label> stored = wanted;
  std::sort(stored.begin(), stored.end());
  if (stored.empty()) return;
  diagnostics(stored).executor->run({time, 0.0, level_->spacing, level_->index});
}

std::vector<double> LevelSolver::initial_rates() {
  Reductions rates(component_->reduction_maxima(), component_->reduction_sums());
  component_->measure_rates(state_, rates);
  reduce(rates, nullptr);
  return attempt_.maxima;
}

std::vector<double> LevelSolver::effect_seconds() const {
  std::vector<double> seconds(static_cast<std::size_t>(component_->effects().size()), 0.0);
  for (const auto& [key, v] : variants_) {
    const std::vector<double> tasks = v->executor->task_seconds();
    for (std::size_t t = 0; t < tasks.size(); ++t) {
      const auto task = static_cast<std::size_t>(v->executor->plan().tasks[t].task);
      seconds[static_cast<std::size_t>(v->list.tasks()[task].effect)] += tasks[t];
    }
  }
  return seconds;
}

const SweepPlan& LevelSolver::plain_plan() {
  return variant(false, {}).executor->plan();
}

std::vector<int> LevelSolver::effect_tasks() const {
  std::vector<int> count(static_cast<std::size_t>(component_->effects().size()), 0);
  const auto plain = variants_.find({false, {}});
  if (plain == variants_.end()) return count;
  for (const PlannedTask& p : plain->second->executor->plan().tasks)
    ++count[static_cast<std::size_t>(
        plain->second->list.tasks()[static_cast<std::size_t>(p.task)].effect)];
  return count;
}

std::vector<double> LevelSolver::effect_doubles() const {
  std::vector<double> doubles(static_cast<std::size_t>(component_->effects().size()), 0.0);
  const auto plain = variants_.find({false, {}});
  if (plain == variants_.end()) return doubles;
  for (const Task& t : plain->second->list.tasks())
    for (VariableId v : t.writes)
      if (plain->second->executor->plan().used[static_cast<std::size_t>(v.index)] &&
          plain->second->list[v].storage == Storage::new_state)
        doubles[static_cast<std::size_t>(t.effect)] +=
            2.0 * plain->second->list[v].components;  // old and new
  return doubles;
}

std::int64_t LevelSolver::blocks_run() const {
  std::int64_t n = 0;
  for (const auto& [key, v] : variants_) n += v->executor->blocks_run();
  return n;
}

std::int64_t LevelSolver::blocks_asleep() const {
  std::int64_t n = 0;
  for (const auto& [key, v] : variants_) n += v->executor->blocks_asleep();
  return n;
}

std::size_t LevelSolver::memory_bytes() const {
  std::size_t n = state_.bytes() + next_.bytes() + outputs_.bytes();
  for (const auto& [key, v] : variants_) n += v->executor->scratch_bytes();
  for (const auto& [key, v] : diagnostics_) n += v->executor->scratch_bytes();
  return n;
}

std::size_t LevelSolver::message_bytes() const {
  int components = 0;
  for (int s : state_slots_) components += state_.info(s).components;
  return halo_->message_bytes(components);
}

std::string LevelSolver::graph_as_dot() {
  Variant& v = variant(false, {});
  return to_dot(v.list, component_->effects(), v.executor->plan());
}

}  // namespace sluice
