// Compiling graph variants and running attempts.
#include "framework/run/levels/level_solver_variant.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "framework/base/reduction.hpp"

namespace sluice {

namespace {

std::vector<Variable> outputs_of(const TaskList& list) {
  std::vector<Variable> outputs;
  for (const Variable& v : list.variables())
    if (v.storage == Storage::output) outputs.push_back(v);
  return outputs;
}

std::vector<Label> labels_of(const std::vector<Variable>& variables) {
  std::vector<Label> labels;
  for (const Variable& v : variables) labels.push_back(v.label);
  std::sort(labels.begin(), labels.end());
  return labels;
}

bool writes(const TaskList& list, Storage storage, Label label, int material) {
  for (const Variable& v : list.variables())
    if (v.storage == storage && v.label == label && v.material == material) return true;
  return false;
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
      state_(level_, communicator.rank(), arrays),
      next_(level_, communicator.rank(), arrays),
      start_(level_, communicator.rank(), arrays),
      outputs_(level_, communicator.rank()),
      team_(options.team != nullptr ? options.team
                                    : std::make_shared<const ThreadTeam>(options.threads)) {
  for (const SlotInfo& s : component.state_slots()) {
    add_state_slot(s);
    state_slots_.push_back(state_.find(s.label, s.material));
  }
  for (const SlotInfo& s : component.work_slots()) add_state_slot(s);
  halo_ =
      std::make_unique<HaloExchange>(level_, halo_width(component), communicator.rank(), arrays);
  TaskList step, diagnostic;
  StepVariant general;
  general.level = level.index;
  general.kind = component.step_kinds() - 1;
  component.declare_step(step, general);
  component.declare_diagnostics(diagnostic, level.index);
  step_outputs_ = outputs_of(step);
  diagnostic_outputs_ = outputs_of(diagnostic);
  step_labels_ = labels_of(step_outputs_);
  diagnostic_labels_ = labels_of(diagnostic_outputs_);
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
  state_ = Warehouse(level_, rank, arrays);
  next_ = Warehouse(level_, rank, arrays);
  start_ = Warehouse(level_, rank, arrays);
  outputs_ = Warehouse(level_, rank);
  // Interior cells are filled by the caller, ghosts before every use, the others by sweeps.
  for (int s = 0; s < before.slot_count(); ++s) add_state_slot(before.info(s), Contents::undefined);
  for (const SlotInfo& s : stored) outputs_.add(s);
  halo_ = std::make_unique<HaloExchange>(level_, halo_width(*component_), rank, arrays);
  ++layout_;
  ++boxes_;
  ghosts_filled_ = false;
  accept();
  if (level_.boxes.empty()) {
    for (auto& [key, v] : variants_) v->executor->rest();
    for (auto* some : {&diagnostics_, &preparations_})
      for (auto& [key, v] : *some) v->executor->rest();
  }
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

bool LevelSolver::chooses_kinds() const {
  return component_->step_kinds() > 1 && !options_.force_all;
}

std::unique_ptr<LevelSolver::Variant> LevelSolver::make_variant(bool masked, Purpose purpose,
                                                                const std::vector<Label>& wanted) {
  const bool diagnostic = purpose == Purpose::diagnostic;
  for (const Variable& v : diagnostic ? diagnostic_outputs_ : step_outputs_)
    if (contains(wanted, v.label))
      outputs_.add({v.label, v.material, v.components, v.closing == IntVec3{} ? 0 : 1});
  auto variant = std::make_unique<Variant>();
  SweepKinds kinds;
  kinds.count = diagnostic ? 1 : component_->step_kinds();
  kinds.halo = level_.ghosts(halo_width(*component_));
  variant->lists.resize(kinds.count);
  kinds.graph = [this, masked, purpose, diagnostic, wanted, v = variant.get()](int kind) {
    auto& list = v->lists[kind];
    list = std::make_unique<TaskList>();
    if (diagnostic)
      component_->declare_diagnostics(*list, level_.index);
    else
      component_->declare_step(*list, {level_.index, masked, options_.joined ? &recorder_ : nullptr,
                                       options_.joined ? &coverage_ : nullptr, kind, &volumes_});
    SweepGraph graph = graph_of(*list, purpose, wanted);
    if (v->lists.size() > 1) graph.absent = absent_slots(*list, purpose, kind, wanted);
    graph.may_be_skipped = component_->may_be_skipped(kind);
    return graph;
  };
  if (!diagnostic && chooses_kinds())
    kinds.kind_of = [this](const Warehouse& state, int box, const IndexBox& cells) {
      return component_->step_kind(state, box, cells);
    };
  variant->executor = std::make_unique<SweepExecutor>(std::move(kinds), level_,
                                                      sweep_options(purpose, !wanted.empty()));
  return variant;
}

SweepGraph LevelSolver::graph_of(const TaskList& list, Purpose purpose,
                                 const std::vector<Label>& wanted) const {
  const bool advances = purpose != Purpose::preparation;
  std::vector<VariableId> wanted_variables;
  for (std::size_t n = 0; n < list.variables().size(); ++n) {
    const Variable& v = list.variables()[n];
    if ((advances && v.storage == Storage::new_state) ||
        (v.storage == Storage::output && contains(wanted, v.label)))
      wanted_variables.push_back({static_cast<int>(n)});
  }
  SweepGraph graph{
      &list,
      compile(list, component_->effects(), wanted_variables, active_axes(level_), advances),
      {}};
  const IntVec3 ghosts = level_.ghosts(halo_width(*component_));
  for (int d = 0; d < 3; ++d)
    if (graph.plan.halo[d] > ghosts[d])
      throw std::logic_error("a step reads " + std::to_string(graph.plan.halo[d]) +
                             " ghost layers of its state along axis " + std::to_string(d) +
                             ", and the slots of the component have " + std::to_string(ghosts[d]));
  return graph;
}

// What the graph of a kind leaves to be filled.
std::vector<AbsentSlot> LevelSolver::absent_slots(const TaskList& list, Purpose purpose, int kind,
                                                  const std::vector<Label>& wanted) const {
  std::vector<AbsentSlot> absent;
  auto add = [&](Label label, int material, bool output, IntVec3 closing) {
    if (writes(list, output ? Storage::output : Storage::new_state, label, material)) return;
    if (const auto value = component_->absent_value(label, material, kind))
      absent.push_back({label, material, *value, output, closing});
  };
  if (purpose == Purpose::step)
    for (const SlotInfo& s : component_->state_slots()) add(s.label, s.material, false, {});
  for (const Variable& v : step_outputs_)
    if (contains(wanted, v.label)) add(v.label, v.material, true, v.closing);
  return absent;
}

SweepOptions LevelSolver::sweep_options(Purpose purpose, bool storing) const {
  const bool diagnostic = purpose == Purpose::diagnostic;
  SweepOptions o;
  o.threads = options_.threads;
  o.team = team_;
  o.block = options_.block;
  o.skip_uniform_blocks =
      !options_.force_all && !diagnostic && !storing && component_->skipping_allowed();
  o.sample_every = diagnostic ? 0 : options_.sample_every;
  if (diagnostic) return o;
  o.maxima = component_->reduction_maxima();
  o.sums = component_->reduction_sums();
  o.time_boxes = communicator_->size() > 1;
  if (options_.joined)
    o.never_skipped = [this](int box, const IndexBox& block) {
      return (recorder_.as_coarse != nullptr && recorder_.as_coarse->touches(box, block)) ||
             (recorder_.as_fine != nullptr && recorder_.as_fine->touches(box, block));
    };
  return o;
}

void LevelSolver::bind(Variant& variant) {
  if (variant.layout == layout_) return;
  if (chooses_kinds()) {
    const IntVec3 extents = variant.executor->block_extents(state_.local_boxes());
    for (Warehouse* w : {&state_, &next_, &start_})
      if (w->blocks().extents() != extents) w->cut(extents);
  }
  variant.executor->bind(state_, next_, &outputs_, variant.boxes == boxes_);
  variant.layout = layout_;
  variant.boxes = boxes_;
}

LevelSolver::Variant& LevelSolver::variant(bool masked, const std::vector<Label>& wanted) {
  auto& v = variants_[{masked, wanted}];
  if (v == nullptr) v = make_variant(masked, Purpose::step, wanted);
  bind(*v);
  return *v;
}

LevelSolver::Variant& LevelSolver::diagnostics(const std::vector<Label>& wanted) {
  auto found = diagnostics_.find(wanted);
  if (found == diagnostics_.end())
    found = diagnostics_.emplace(wanted, make_variant(false, Purpose::diagnostic, wanted)).first;
  bind(*found->second);
  return *found->second;
}

LevelSolver::Variant& LevelSolver::preparation(const std::vector<Label>& wanted) {
  auto& v = preparations_[wanted];
  if (v == nullptr) v = make_variant(false, Purpose::preparation, wanted);
  bind(*v);
  return *v;
}

// All ranks come here together: they fill the same levels in the same order.
void LevelSolver::sum_for_boundary() {
  const std::size_t count = component_->boundary_sums();
  if (count == 0) return;
  std::vector<ExactSum> local(count);
  component_->add_boundary_sums(state_, local);
  Reduction all;
  std::vector<Reduction::Sum> slots;
  for (const ExactSum& sum : local) slots.push_back(all.add_sum(sum));
  communicator_->reduce(all);
  boundary_sums_.clear();
  for (const Reduction::Sum slot : slots) boundary_sums_.push_back(all.sum(slot).value());
}

void LevelSolver::fill_ghosts(double time, const std::function<void(Warehouse&)>& interface,
                              const LevelSolver* coarsest) {
  if (ghosts_filled_) return;
  halo_->run(state_, state_slots_, team_.get());
  if (interface) interface(state_);
  if (coarsest == nullptr) sum_for_boundary();
  component_->fill_boundary(
      state_, time, coarsest == nullptr ? boundary_sums_ : coarsest->boundary_sums_, *team_);
  ghosts_filled_ = true;
}

const StepAttempt& LevelSolver::attempt(double time, double dt, const std::vector<Label>& wanted,
                                        const RunControl* control, bool rates) {
  std::vector<Label> stored = wanted;
  std::sort(stored.begin(), stored.end());
  if (advanced_ == 1 && options_.substeps > 1 && !start_kept_) {
    next_.swap(start_);
    start_kept_ = true;
  }
  last_ = variant(masked_, stored).executor->run(constants(time, dt, rates));
  reduce(last_, control);
  return attempt_;
}

void LevelSolver::prepare(double time, double dt, const std::vector<Label>& stored) {
  std::vector<Label> labels = stored;
  std::sort(labels.begin(), labels.end());
  preparation(labels).executor->run(constants(time, dt, false));
}

StepConstants LevelSolver::constants(double time, double dt, bool rates) const {
  return {time, dt, level_.spacing, level_.index, rates || options_.force_all, previous_dt_};
}

void LevelSolver::fill_work_ghosts(Label label) {
  int slot = 0;
  while (state_.info(slot).label != label) ++slot;
  halo_->run(state_, {slot}, team_.get());
  component_->fill_work_boundary(state_, label, *team_);
}

void LevelSolver::reduce(const Reductions& local, const RunControl* control) {
  CellFault lowest;
  for (const CellFault& f : local.faults())
    if (&f == &local.faults().front() || before(f, lowest)) lowest = f;
  attempt_.first_fault = lowest;
  attempt_.maxima.resize(local.maxima_count());
  attempt_.sums.resize(local.sum_count());
  reduction_.clear();
  const auto faults = reduction_.add_count(local.fault_count());
  RunControl::Question question{};
  if (control != nullptr) question = control->ask(reduction_);
  if (communicator_->size() == 1) {
    for (int m = 0; m < local.maxima_count(); ++m) attempt_.maxima[m] = local.maximum(m);
    for (int s = 0; s < local.sum_count(); ++s) attempt_.sums[s] = local.sum(s).value();
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

void LevelSolver::compute_diagnostics(double time, const std::vector<Label>& wanted) {
  if (wanted.empty()) return;
  if (!std::is_sorted(wanted.begin(), wanted.end())) {
    std::vector<Label> sorted = wanted;
    std::sort(sorted.begin(), sorted.end());
    return compute_diagnostics(time, sorted);
  }
  diagnostics(wanted).executor->run({time, 0.0, level_.spacing, level_.index});
}

std::vector<double> LevelSolver::initial_rates() {
  Reductions rates(component_->reduction_maxima(), component_->reduction_sums());
  component_->measure_rates(state_, rates);
  reduce(rates, nullptr);
  return attempt_.maxima;
}

const SweepPlan& LevelSolver::plain_plan(int kind) {
  return variant(false, {}).executor->plan(kind);
}

std::string LevelSolver::graph_as_dot(int kind) {
  SweepExecutor& executor = *variant(false, {}).executor;
  return to_dot(executor.list(kind), component_->effects(), executor.plan(kind));
}

}  // namespace sluice
