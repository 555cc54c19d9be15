// Blocks, kinds, threads.
#include "framework/task/sweep_worker.hpp"

#include <array>
#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>

#include "framework/field/array_view.hpp"

namespace sluice {
namespace {

// Extents of a stack as scratch memory sees them: a plane of rings is reused along the last active
// direction of two or three.
IntVec3 across_swept(const IndexBox& hull, const std::array<bool, 3>& active) {
  IntVec3 size = hull.size();
  const int swept = active[2] ? 2 : active[1] ? 1 : 0;
  if (active[0] + active[1] + active[2] > 1) size[swept] = 1;
  return size;
}

}  // namespace

SweepExecutor::SweepExecutor(SweepKinds kinds, const Level& level, const SweepOptions& options)
    : kinds_(std::move(kinds)),
      graphs_(kinds_.count),
      level_(&level),
      options_(options),
      team_(options.team != nullptr ? options.team
                                    : std::make_shared<const ThreadTeam>(options.threads)),
      total_(options.maxima, options.sums) {
  if (!kinds_.kind_of) meet(kinds_.count - 1);
}

SweepExecutor::SweepExecutor(const TaskList& list, SweepPlan plan, const Level& level,
                             const SweepOptions& options)
    : SweepExecutor(SweepKinds{1,
                               [&](int) {
                                 return SweepGraph{&list, std::move(plan), {}};
                               },
                               {},
                               {}},
                    level, options) {
  kinds_.graph = {};  // what it refers to ends here
}

SweepExecutor::~SweepExecutor() = default;

SweepExecutor::Graph& SweepExecutor::meet(int kind) {
  auto& graph = graphs_[kind];
  if (graph != nullptr) return *graph;
  graph = std::make_unique<Graph>(kinds_.graph(kind));
  if (old_state_ != nullptr) bind(*graph);
  for (auto& w : workers_) make_sweep(*w, kind);
  return *graph;
}

void SweepExecutor::bind(Graph& graph) const {
  const TaskList& list = *graph.list;
  graph.binding = {old_state_, new_state_, output_, {}};
  graph.binding.slot.assign(list.variables().size(), -1);
  graph.written.clear();
  graph.absent_slots.clear();
  auto find = [](const Warehouse* w, Label label, int material, const std::string& name) {
    const int slot = w == nullptr ? -1 : w->find(label, material);
    if (slot < 0) throw std::logic_error("no storage for '" + name + "'");
    return slot;
  };
  for (std::size_t v = 0; v < list.variables().size(); ++v) {
    const Variable& variable = list.variables()[v];
    if (variable.storage == Storage::temporary || !graph.plan.used[v]) continue;
    const Warehouse* w = variable.storage == Storage::old_state   ? old_state_
                         : variable.storage == Storage::new_state ? new_state_
                                                                  : output_;
    graph.binding.slot[v] = find(w, variable.label, variable.material, variable.name);
    if (variable.storage == Storage::new_state) graph.written.push_back(graph.binding.slot[v]);
  }
  for (const AbsentSlot& a : graph.absent)
    graph.absent_slots.push_back(
        find(a.output ? output_ : new_state_, a.label, a.material, a.label.name()));
}

IntVec3 SweepExecutor::block_extents(const std::vector<GridBox>& local_boxes) const {
  if (options_.block != IntVec3{}) return options_.block;
  return balanced_block_extents(default_block(*level_, options_.size), *level_, local_boxes,
                                team_->size());
}

void SweepExecutor::bind(const Warehouse& old_state, Warehouse& new_state, Warehouse* output,
                         bool same_boxes) {
  old_state_ = &old_state;
  new_state_ = &new_state;
  output_ = output;
  for (auto& graph : graphs_)
    if (graph != nullptr) bind(*graph);
  const IntVec3 extents = block_extents(old_state.local_boxes());
  blocks_ = place_blocks(old_state.local_boxes(), extents);
  remembers_ = new_state.blocks().extents() == extents;
  for (Block& b : blocks_) {
    b.kind = kinds_.count - 1;
    if (options_.never_skipped) b.may_be_skipped = !options_.never_skipped(b.box, b.cells);
  }
  place_stacks();
  IntVec3 largest{1, 1, 1};
  for (const auto& stack : stacks_) {
    IndexBox hull = blocks_[stack.front()].cells;
    for (const std::size_t n : stack) {
      hull = bounding(hull, blocks_[n].cells);
      largest = max(largest, blocks_[n].cells.size());
    }
    largest = max(largest, across_swept(hull, level_->active));
  }
  if (max(largest, largest_) != largest_) make_workers(max(largest, largest_));
  if (options_.time_boxes)
    for (auto& w : workers_)
      if (!same_boxes || w->boxes.empty()) w->boxes.assign(old_state.local_boxes().size(), 0);
}

void SweepExecutor::place_stacks() {
  constexpr std::int64_t stacks_a_thread = 4;  // so that threads can be kept busy
  std::int64_t cells = 0;
  for (const Block& b : blocks_) cells += b.cells.volume();
  stacks_ = stack_blocks(blocks_, *level_,
                         team_->size() > 1 ? cells / (stacks_a_thread * team_->size()) : cells);
}

void SweepExecutor::rest() {
  keep_counts();
  workers_.clear();
  largest_ = {};
}

void SweepExecutor::make_workers(IntVec3 largest) {
  keep_counts();
  largest_ = largest;
  workers_.clear();
  workers_.resize(team_->size());
  // Clearing their scratch memory (6 MB each at 96^3) costs milliseconds: all at once.
  team_->for_each(workers_.size(), [&](std::size_t n, int) {
    workers_[n] = std::make_unique<Worker>(kinds_.count, options_);
    for (int kind = 0; kind < kinds_.count; ++kind)
      if (met(kind)) make_sweep(*workers_[n], kind);
  });
}

void SweepExecutor::make_sweep(Worker& worker, int kind) const {
  const Graph& graph = *graphs_[kind];
  worker.sweeps[kind] = std::make_unique<BlockSweep>(*graph.list, graph.plan, *level_,
                                                     graph.binding, largest_, worker.scratch);
  worker.counts[kind].times.assign(graph.plan.tasks.size(), 0);
}

// What the workers counted and timed, before they are made anew.
void SweepExecutor::keep_counts() {
  for (const auto& w : workers_) {
    kept_skipped_.add(w->skipped);
    for (std::size_t k = 0; k < graphs_.size(); ++k)
      if (graphs_[k] != nullptr) graphs_[k]->kept.add(w->counts[k]);
  }
}

SweepExecutor::SweepCounts SweepExecutor::counts_of(int kind) const {
  SweepCounts sum;
  if (graphs_[kind] != nullptr) sum = graphs_[kind]->kept;
  for (const auto& w : workers_) sum.add(w->counts[kind]);
  return sum;
}

// What pieces cost, by their cells.
void SweepExecutor::charge(Worker& worker, std::int64_t nanoseconds,
                           std::span<const SweepPiece> pieces) const {
  std::int64_t cells = 0;
  for (const SweepPiece& p : pieces) cells += p.cells.volume();
  for (const SweepPiece& p : pieces) worker.boxes[p.box] += nanoseconds * p.cells.volume() / cells;
}

std::vector<double> SweepExecutor::box_seconds() const {
  std::vector<double> seconds;
  for (const auto& w : workers_) {
    seconds.resize(w->boxes.size(), 0.0);
    for (std::size_t b = 0; b < w->boxes.size(); ++b)
      seconds[b] += 1e-9 * static_cast<double>(w->boxes[b]);
  }
  return seconds;
}

// Kinds are chosen anew in every sweep, and their graphs made when they are first met.
void SweepExecutor::choose_kinds() {
  team_->for_each(blocks_.size(), [&](std::size_t n, int) {
    Block& block = blocks_[n];
    block.kind = kinds_.kind_of(*old_state_, block.box, block.cells.grown(kinds_.halo));
  });
  for (const Block& block : blocks_) {
    if (block.kind < 0 || block.kind >= kinds_.count)
      throw std::logic_error("a block is of kind " + std::to_string(block.kind) + " of " +
                             std::to_string(kinds_.count));
    if (!met(block.kind)) meet(block.kind);
  }
}

// What the graph of a block does not write, where it is not there already. Rows are marked by
// graphs that write all of them.
void SweepExecutor::leave_absent(const Graph& graph, std::size_t n) {
  const Block& block = blocks_[n];
  const int number = static_cast<int>(n);
  RowMarks* marks = new_state_->marks(block.box);
  if (marks != nullptr && !graph.absent.empty()) marks->clear(block.cells);
  if (remembers_)
    for (const int slot : graph.written) new_state_->forget(slot, number);
  for (std::size_t a = 0; a < graph.absent.size(); ++a) {
    const AbsentSlot& absent = graph.absent[a];
    const int slot = graph.absent_slots[a];
    Warehouse& warehouse = absent.output ? *output_ : *new_state_;
    const bool remembered = remembers_ && !absent.output;
    if (remembered && new_state_->uniform(slot, number) == absent.value) continue;
    IndexBox cells = block.cells;
    // What closes the box; the rest is of another block.
    const IndexBox& box = warehouse.local_boxes()[block.box].cells;
    for (int d = 0; d < 3; ++d)
      if (level_->active[d] && cells.upper[d] == box.upper[d]) cells.upper[d] += absent.closing[d];
    for (int c = 0; c < warehouse.info(slot).components; ++c)
      fill_where_different(warehouse.view(slot, c, block.box), cells, absent.value);
    if (remembered) new_state_->set_uniform(slot, number, absent.value);
  }
}

// The awake blocks that were collected.
void SweepExecutor::sweep_pieces(Worker& worker, const StepConstants& step, int kind, bool sample) {
  if (worker.pieces.empty()) return;
  SweepCounts& counts_of = worker.counts[kind];
  const auto blocks = static_cast<std::int64_t>(worker.pieces.size());
  const auto start = std::chrono::steady_clock::now();
  worker.sweeps[kind]->run(step, worker.pieces, worker.reductions,
                           sample ? &counts_of.times : nullptr);
  if (options_.time_boxes)
    charge(worker, (std::chrono::steady_clock::now() - start).count(), worker.pieces);
  counts_of.run += blocks;
  if (sample) counts_of.sampled += blocks;
  worker.pieces.clear();
}

void SweepExecutor::run_stack(Worker& worker, const StepConstants& step, std::size_t stack) {
  const std::size_t every = options_.sample_every;
  const bool sample = every > 0 && (stack + passes_) % every == 0;
  int kind = 0;  // of the pieces
  for (const std::size_t n : stacks_[stack]) {
    const Block& block = blocks_[n];
    const Graph& graph = *graphs_[block.kind];
    leave_absent(graph, n);
    const bool skipped = options_.skip_uniform_blocks && graph.may_be_skipped &&
                         block.may_be_skipped && is_skippable(graph, block);
    if (skipped || block.kind != kind) sweep_pieces(worker, step, kind, sample);
    kind = block.kind;
    const SweepPiece piece{block.box, block.cells};
    if (!skipped) {
      worker.pieces.push_back(piece);
      continue;
    }
    const auto start = std::chrono::steady_clock::now();
    skip(worker, step, block);
    if (options_.time_boxes)
      charge(worker, (std::chrono::steady_clock::now() - start).count(), {&piece, 1});
    ++worker.skipped.blocks;
  }
  sweep_pieces(worker, step, kind, sample);
}

const Reductions& SweepExecutor::run(const StepConstants& step) {
  for (auto& w : workers_) w->reductions.clear();
  if (kinds_.kind_of) choose_kinds();
  if (!remembers_ && new_state_->blocks().size() > 0) new_state_->forget();
  team_->for_each(stacks_.size(),
                  [&](std::size_t n, int thread) { run_stack(*workers_[thread], step, n); });
  total_.clear();
  blocks_run_ = 0;
  skipped_ = kept_skipped_;
  for (auto& w : workers_) {
    total_.merge(w->reductions);
    skipped_.add(w->skipped);
  }
  for (int kind = 0; kind < kinds_.count; ++kind) blocks_run_ += blocks_run(kind);
  ++passes_;
  return total_;
}

const SweepPlan& SweepExecutor::plan(int kind) {
  return meet(kind < 0 ? kinds_.count - 1 : kind).plan;
}

const TaskList& SweepExecutor::list(int kind) {
  return *meet(kind < 0 ? kinds_.count - 1 : kind).list;
}

std::int64_t SweepExecutor::blocks_run(int kind) const {
  std::int64_t n = graphs_[kind] != nullptr ? graphs_[kind]->kept.run : 0;
  for (const auto& w : workers_) n += w->counts[kind].run;
  return n;
}

std::size_t SweepExecutor::scratch_bytes() const {
  std::size_t n = 0;
  for (const auto& w : workers_) n += w->scratch->size() * sizeof(double);
  return n;
}

std::vector<double> SweepExecutor::task_seconds(int kind) const {
  const SweepCounts t = counts_of(kind);
  std::vector<double> seconds(t.times.size(), 0.0);
  const double scale =
      t.sampled > 0 ? static_cast<double>(t.run) / static_cast<double>(t.sampled) : 0.0;
  for (std::size_t n = 0; n < seconds.size(); ++n)
    seconds[n] = 1e-9 * scale * static_cast<double>(t.times[n]);
  return seconds;
}

}  // namespace sluice
