// Compiling graph variants and running attempts.
#include "framework/run/level_solver.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"

namespace sluice {

struct LevelSolver::Variant {
  TaskList list;
  std::unique_ptr<SweepExecutor> executor;
  int layout = -1;  // of the level when it was last bound
  int boxes = -1;   // likewise, without what joints change
};

namespace {

std::vector<Label> output_labels(const TaskList& list) {
  std::vector<Label> labels;
  for (const Variable& v : list.variables())
    if (v.storage == Storage::output) labels.push_back(v.label);
  std::sort(labels.begin(), labels.end());
  return labels;
}

bool contains(const std::vector<Label>& labels, Label l) {
  return std::binary_search(labels.begin(), labels.end(), l);
}

}  // namespace

LevelSolver::LevelSolver(const Component& component, const Level& level, Communicator& communicator,
                         const SolverOptions& options)
    : component_(&component),
      level_(level),
      communicator_(&communicator),
      options_(options),
      state_(level_, communicator.rank()),
      next_(level_, communicator.rank()),
      start_(level_, communicator.rank()),
      outputs_(level_, communicator.rank()),
      team_(options.team != nullptr ? options.team
                                    : std::make_shared<const ThreadTeam>(options.threads)) {
  for (const SlotInfo& s : component.state_slots()) {
    add_state_slot(s);
    state_slots_.push_back(state_.find(s.label, s.material));
  }
  halo_ = std::make_unique<HaloExchange>(level_, halo_width(component), communicator.rank());
  TaskList step, diagnostic;
  component.declare_step(step, {level.index});
  component.declare_diagnostics(diagnostic, level.index);
  step_labels_ = output_labels(step);
  diagnostic_labels_ = output_labels(diagnostic);
}

LevelSolver::~LevelSolver() = default;

// Halos, interfaces between levels and redone slopes reach equally far in all slots: each is as
// wide as the widest.
void LevelSolver::add_state_slot(SlotInfo info, Contents contents) {
  info.ghosts = halo_width(*component_);
  state_.add(info, contents);
  next_.add(info, contents);
  if (options_.substeps > 1) start_.add(info, contents);
}

Warehouse LevelSolver::lay_out(std::vector<GridBox> boxes) {
  Warehouse before = std::move(state_);
  level_.boxes = std::move(boxes);
  const int rank = communicator_->rank();
  std::vector<SlotInfo> stored;
  for (int s = 0; s < outputs_.slot_count(); ++s) stored.push_back(outputs_.info(s));
  state_ = Warehouse(level_, rank);
  next_ = Warehouse(level_, rank);
  start_ = Warehouse(level_, rank);
  outputs_ = Warehouse(level_, rank);
  // Interior cells are filled by the caller, ghosts before every use, the others by sweeps.
  for (int s = 0; s < before.slot_count(); ++s) add_state_slot(before.info(s), Contents::undefined);
  for (const SlotInfo& s : stored) outputs_.add(s);
  halo_ = std::make_unique<HaloExchange>(level_, halo_width(*component_), rank);
  ++layout_;
  ++boxes_;
  ghosts_filled_ = false;
  accept();
  if (level_.boxes.empty())
    for (auto* variants : {&variants_, &diagnostics_})
      for (auto& [key, v] : *variants) v->executor->rest();
  return before;
}

void LevelSolver::join(const FluxRecorder& recorder, LevelCoverage coverage) {
  recorder_ = recorder;
  coverage_ = std::move(coverage);
  ++layout_;  // blocks on an interface must not sleep
}

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
    component_->declare_diagnostics(v->list, level_.index);
  else
    component_->declare_step(v->list, {level_.index, masked, options_.joined ? &recorder_ : nullptr,
                                       options_.joined ? &coverage_ : nullptr});
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
  v->executor = std::make_unique<SweepExecutor>(
      v->list, compile(v->list, component_->effects(), wanted_variables, active_axes(level_)),
      level_, sweep_options(diagnostic, !wanted.empty()));
  return v;
}

SweepOptions LevelSolver::sweep_options(bool diagnostic, bool storing) const {
  SweepOptions o;
  o.threads = options_.threads;
  o.team = team_;
  o.block = options_.block;
  o.quiet_blocks =
      !options_.force_all && !diagnostic && !storing && component_->quiet_blocks_allowed();
  o.sample_every = diagnostic ? 0 : options_.sample_every;
  if (diagnostic) return o;
  o.maxima = component_->reduction_maxima();
  o.sums = component_->reduction_sums();
  o.time_boxes = communicator_->size() > 1;
  if (options_.joined)
    o.never_sleeps = [this](int box, const IndexBox& block) {
      return (recorder_.as_coarse != nullptr && recorder_.as_coarse->touches(box, block)) ||
             (recorder_.as_fine != nullptr && recorder_.as_fine->touches(box, block));
    };
  return o;
}

void LevelSolver::bind(Variant& variant) {
  if (variant.layout == layout_) return;
  variant.executor->bind(state_, next_, &outputs_, variant.boxes == boxes_);
  variant.layout = layout_;
  variant.boxes = boxes_;
}

LevelSolver::Variant& LevelSolver::variant(bool masked, const std::vector<Label>& wanted) {
  auto& v = variants_[{masked, wanted}];
  if (v == nullptr) v = compile_variant(masked, false, wanted);
  bind(*v);
  return *v;
}

LevelSolver::Variant& LevelSolver::diagnostics(const std::vector<Label>& wanted) {
  auto& v = diagnostics_[{false, wanted}];
  if (v == nullptr) v = compile_variant(false, true, wanted);
  bind(*v);
  return *v;
}

void LevelSolver::fill_ghosts(double time, const std::function<void(Warehouse&)>& interface) {
  if (ghosts_filled_) return;
  halo_->run(state_, state_slots_);
  if (interface) interface(state_);
  component_->fill_boundary(state_, time, *team_);
  ghosts_filled_ = true;
}

const StepAttempt& LevelSolver::attempt(double time, double dt, const std::vector<Label>& wanted,
                                        const RunControl* control) {
  std::vector<Label> stored = options_.force_all ? step_labels_ : wanted;
  std::sort(stored.begin(), stored.end());
  if (advanced_ == 1 && options_.substeps > 1 && !start_kept_) {
    next_.swap(start_);
    start_kept_ = true;
  }
  const StepConstants step{time, dt, level_.spacing, level_.index};
  last_ = variant(masked_, stored).executor->run(step);
  reduce(last_, control);
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
          const CellFault f{cell, level_.index, state_.info(slot).material, slot, v(cell)};
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

void LevelSolver::advance() {
  state_.swap(next_);
  masked_ = false;
  ghosts_filled_ = false;
  ++advanced_;
}

void LevelSolver::reject() {
  if (advanced_ > 0) state_.swap(start_kept_ ? start_ : next_);
  if (advanced_ > 0) ghosts_filled_ = false;
  accept();
  masked_ = false;
}

std::int64_t LevelSolver::mask_faults(double time) {
  add_state_slot({component_->mask_label(), 0, 1, 0});
  const int slot = state_.find(component_->mask_label(), 0);
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
  diagnostics(stored).executor->run({time, 0.0, level_.spacing, level_.index});
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

std::vector<double> LevelSolver::box_seconds() const {
  std::vector<double> seconds(state_.local_boxes().size(), 0.0);
  for (const auto& [key, v] : variants_) {
    if (v->boxes != boxes_) continue;
    const std::vector<double> own = v->executor->box_seconds();
    for (std::size_t b = 0; b < own.size(); ++b) seconds[b] += own[b];
  }
  return seconds;
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
  std::size_t n = state_.bytes() + next_.bytes() + start_.bytes() + outputs_.bytes();
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
