#include "framework/run/levels/step_graphs.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "framework/run/levels/step_graphs_variant.hpp"

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

StepGraphs::StepGraphs(const Component& component, LevelStates& states, const Communicator& ranks,
                       const SolverOptions& options)
    : component_(&component),
      states_(&states),
      ranks_(&ranks),
      options_(options),
      outputs_(states.level(), ranks.rank()) {
  TaskList step, diagnostic;
  StepVariant general;
  general.level = states.level().index;
  general.kind = component.blocks().kinds() - 1;
  component.step().declare(step, general);
  component.outputs().declare_diagnostics(diagnostic, general.level);
  step_.variables = outputs_of(step);
  step_.labels = labels_of(step_.variables);
  diagnostics_.variables = outputs_of(diagnostic);
  diagnostics_.labels = labels_of(diagnostics_.variables);
}

StepGraphs::~StepGraphs() = default;

bool StepGraphs::is_step_label(Label label) const {
  return contains(step_.labels, label);
}

bool StepGraphs::is_diagnostic_label(Label label) const {
  return contains(diagnostics_.labels, label);
}

void StepGraphs::join(const FluxRecorder& recorder, LevelCoverage coverage) {
  recorder_ = recorder;
  coverage_ = std::move(coverage);
  ++layout_;  // blocks on an interface must not sleep
}

void StepGraphs::lay_out() {
  std::vector<SlotInfo> stored;
  for (int s = 0; s < outputs_.slot_count(); ++s) stored.push_back(outputs_.info(s));
  outputs_ = Warehouse(states_->level(), ranks_->rank());
  for (const SlotInfo& s : stored) outputs_.add(s);
  ++layout_;
  ++boxes_;
  if (!states_->level().boxes.empty()) return;
  for (auto& [key, v] : variants_) v->executor->rest();
}

SweepExecutor& StepGraphs::step(bool masked, const std::vector<Label>& stored) {
  return bound({Purpose::step, masked, stored});
}

SweepExecutor& StepGraphs::preparation(const std::vector<Label>& stored) {
  return bound({Purpose::preparation, false, stored});
}

SweepExecutor& StepGraphs::diagnostics(const std::vector<Label>& stored) {
  return bound({Purpose::diagnostics, false, stored});
}

SweepExecutor& StepGraphs::bound(Key key) {
  auto found = variants_.find(key);
  if (found == variants_.end()) {
    auto made = make(key);
    found = variants_.emplace(std::move(key), std::move(made)).first;
  }
  Variant& v = *found->second;
  if (v.layout == layout_) return *v.executor;
  if (chooses_kinds()) states_->cut(v.executor->block_extents(states_->present().local_boxes()));
  v.executor->bind(states_->present(), states_->next(), &outputs_, v.boxes == boxes_);
  v.layout = layout_;
  v.boxes = boxes_;
  return *v.executor;
}

bool StepGraphs::chooses_kinds() const {
  return component_->blocks().kinds() > 1 && !options_.force_all;
}

std::unique_ptr<StepGraphs::Variant> StepGraphs::make(const Key& key) {
  const bool diagnostic = key.purpose == Purpose::diagnostics;
  for (const Variable& v : diagnostic ? diagnostics_.variables : step_.variables)
    if (contains(key.stored, v.label))
      outputs_.add({v.label, v.material, v.components, v.closing == IntVec3{} ? 0 : 1});
  auto variant = std::make_unique<Variant>();
  SweepKinds kinds;
  kinds.count = diagnostic ? 1 : component_->blocks().kinds();
  kinds.halo = states_->ghosts();
  variant->lists.resize(kinds.count);
  kinds.graph = [this, key, diagnostic, v = variant.get()](int kind) {
    auto& list = v->lists[kind];
    list = std::make_unique<TaskList>();
    const int level = states_->level().index;
    if (diagnostic)
      component_->outputs().declare_diagnostics(*list, level);
    else
      component_->step().declare(*list, {level, key.masked, options_.joined ? &recorder_ : nullptr,
                                         options_.joined ? &coverage_ : nullptr, kind, &volumes_});
    SweepGraph graph = graph_of(*list, key);
    if (v->lists.size() > 1) graph.absent = absent_slots(*list, key, kind);
    graph.may_be_skipped = component_->blocks().may_be_skipped(kind);
    return graph;
  };
  if (!diagnostic && chooses_kinds())
    kinds.kind_of = [this](const Warehouse& state, int box, const IndexBox& cells) {
      return component_->blocks().kind_of(state, box, cells);
    };
  variant->executor =
      std::make_unique<SweepExecutor>(std::move(kinds), states_->level(), sweep_options(key));
  return variant;
}

SweepGraph StepGraphs::graph_of(const TaskList& list, const Key& key) const {
  const bool advances = key.purpose != Purpose::preparation;
  std::vector<VariableId> wanted;
  for (std::size_t n = 0; n < list.variables().size(); ++n) {
    const Variable& v = list.variables()[n];
    if ((advances && v.storage == Storage::new_state) ||
        (v.storage == Storage::output && contains(key.stored, v.label)))
      wanted.push_back({static_cast<int>(n)});
  }
  SweepGraph graph{
      &list,
      compile(list, component_->effects(), wanted, active_axes(states_->level()), advances),
      {}};
  const IntVec3 ghosts = states_->ghosts();
  for (int d = 0; d < 3; ++d)
    if (graph.plan.halo[d] > ghosts[d])
      throw std::logic_error("a step reads " + std::to_string(graph.plan.halo[d]) +
                             " ghost layers of its state along axis " + std::to_string(d) +
                             ", and the slots of the component have " + std::to_string(ghosts[d]));
  return graph;
}

// What the graph of a kind leaves to be filled.
std::vector<AbsentSlot> StepGraphs::absent_slots(const TaskList& list, const Key& key,
                                                 int kind) const {
  std::vector<AbsentSlot> absent;
  auto add = [&](Label label, int material, bool output, IntVec3 closing) {
    if (writes(list, output ? Storage::output : Storage::new_state, label, material)) return;
    if (const auto value = component_->blocks().absent_value(label, material, kind))
      absent.push_back({label, material, *value, output, closing});
  };
  if (key.purpose == Purpose::step)
    for (const SlotInfo& s : component_->state().slots()) add(s.label, s.material, false, {});
  for (const Variable& v : step_.variables)
    if (contains(key.stored, v.label)) add(v.label, v.material, true, v.closing);
  return absent;
}

SweepOptions StepGraphs::sweep_options(const Key& key) const {
  const bool diagnostic = key.purpose == Purpose::diagnostics;
  SweepOptions o;
  o.threads = options_.threads;
  o.team = options_.team;
  o.block = options_.block;
  o.size = component_->blocks().size();
  o.skip_uniform_blocks = !options_.force_all && !diagnostic && key.stored.empty() &&
                          component_->blocks().skipping_allowed();
  o.sample_every = diagnostic ? 0 : options_.sample_every;
  if (diagnostic) return o;
  o.maxima = component_->step().reductions().maxima();
  o.sums = component_->step().reductions().sums();
  o.time_boxes = ranks_->size() > 1;
  if (options_.joined)
    o.never_skipped = [this](int box, const IndexBox& block) {
      return (recorder_.as_coarse != nullptr && recorder_.as_coarse->touches(box, block)) ||
             (recorder_.as_fine != nullptr && recorder_.as_fine->touches(box, block));
    };
  return o;
}

}  // namespace sluice
