// Blocks, threads, sleeping blocks.
#include "framework/task/sweep_executor.hpp"

#include <chrono>
#include <cstring>
#include <stdexcept>

namespace sluice {

struct SweepExecutor::Worker {
  Worker(const TaskList& list, const SweepPlan& plan, const Level& level,
         const StateBinding& binding, IntVec3 largest, const SweepOptions& o)
      : sweep(list, plan, level, binding, largest),
        reductions(o.maxima, o.sums),
        times(plan.tasks.size(), 0) {}
  BlockSweep sweep;
  Reductions reductions;
  TaskTimes times;
  TaskTimes boxes;  // by local box
  std::int64_t run = 0, asleep = 0, sampled = 0;
};

IntVec3 default_block(const Level& level) {
  // Measured best: long rows, and as few recomputed ghosts as the cache allows. By active axes.
  constexpr int extents[3][3] = {{512, 1, 1}, {256, 64, 1}, {128, 48, 128}};
  IntVec3 b = level.domain.size();
  int axis = 0;
  for (int d = 0; d < 3; ++d)
    if (level.active[static_cast<std::size_t>(d)])
      b[d] = std::min(b[d], extents[level.active_count() - 1][axis++]);
  return b;
}

// Cuts the second axis (the only one in 1-D) so that every thread gets as many blocks.
IntVec3 even_blocks(IntVec3 extents, const std::vector<GridBox>& boxes, const Axes& axes,
                    int threads) {
  constexpr int fewest_cells = 8;  // a thinner block recomputes more ghosts than cells
  if (threads == 1 || boxes.empty()) return extents;
  const int d = axes.direction[axes.count > 1 ? 1 : 0];
  const int n = boxes.front().cells.size()[d];
  int pieces = (n + extents[d] - 1) / extents[d];
  pieces = (pieces + threads - 1) / threads * threads;
  if (n / pieces >= fewest_cells) extents[d] = (n + pieces - 1) / pieces;
  return extents;
}

std::vector<Block> place_blocks(const std::vector<GridBox>& boxes, IntVec3 extents) {
  std::vector<Block> blocks;
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    const IndexBox& box = boxes[n].cells;
    IntVec3 pieces{};
    for (int d = 0; d < 3; ++d)
      pieces[d] = std::max(1, (box.size()[d] + extents[d] - 1) / extents[d]);
    for (const IndexBox& piece : split(box, pieces))
      blocks.push_back({static_cast<int>(n), piece, true});
  }
  return blocks;
}

SweepExecutor::SweepExecutor(const TaskList& list, SweepPlan plan, const Level& level,
                             const SweepOptions& options)
    : list_(&list),
      plan_(std::move(plan)),
      level_(&level),
      options_(options),
      team_(options.team != nullptr ? options.team
                                    : std::make_shared<const ThreadTeam>(options.threads)),
      total_(options.maxima, options.sums) {}

SweepExecutor::~SweepExecutor() = default;

void SweepExecutor::bind(const Warehouse& old_state, Warehouse& new_state, Warehouse* output,
                         bool same_boxes) {
  binding_.old_state = &old_state;
  binding_.new_state = &new_state;
  binding_.output = output;
  binding_.slot.assign(list_->variables().size(), -1);
  for (std::size_t v = 0; v < list_->variables().size(); ++v) {
    const Variable& variable = list_->variables()[v];
    if (variable.storage == Storage::temporary || !plan_.used[v]) continue;
    const Warehouse* w = variable.storage == Storage::old_state   ? &old_state
                         : variable.storage == Storage::new_state ? &new_state
                                                                  : output;
    const int slot = w == nullptr ? -1 : w->find(variable.label, variable.material);
    if (slot < 0) throw std::logic_error("no storage for '" + variable.name + "'");
    binding_.slot[v] = slot;
  }
  IntVec3 extents = options_.block;
  if (extents == IntVec3{})
    extents =
        even_blocks(default_block(*level_), old_state.local_boxes(), plan_.axes, team_->size());
  blocks_ = place_blocks(old_state.local_boxes(), extents);
  IntVec3 largest{1, 1, 1};
  for (const Block& b : blocks_) largest = max(largest, b.cells.size());
  if (options_.never_sleeps)
    for (Block& b : blocks_) b.may_sleep = !options_.never_sleeps(b.box, b.cells);
  if (max(largest, largest_) != largest_) make_workers(max(largest, largest_));
  if (options_.time_boxes)
    for (auto& w : workers_)
      if (!same_boxes || w->boxes.empty()) w->boxes.assign(old_state.local_boxes().size(), 0);
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
  workers_.resize(static_cast<std::size_t>(team_->size()));
  // Clearing their scratch memory (6 MB each at 96^3) costs milliseconds: all at once.
  team_->for_each(workers_.size(), [&](std::size_t n, int) {
    workers_[n] = std::make_unique<Worker>(*list_, plan_, *level_, binding_, largest, options_);
  });
}

// What the workers counted and timed, before they are made anew.
void SweepExecutor::keep_counts() {
  times_.resize(plan_.tasks.size(), 0);
  for (const auto& w : workers_) {
    kept_run_ += w->run;
    kept_asleep_ += w->asleep;
    kept_sampled_ += w->sampled;
    for (std::size_t t = 0; t < times_.size(); ++t) times_[t] += w->times[t];
  }
}

bool SweepExecutor::is_quiet(const Block& block) const {
  for (VariableId id : plan_.states_read) {
    const Variable& variable = (*list_)[id];
    const int slot = binding_.slot[static_cast<std::size_t>(id.index)];
    for (int c = 0; c < variable.components; ++c) {
      const RealView v = binding_.old_state->view(slot, c, block.box);
      const IndexBox seen = intersection(block.cells.grown(plan_.halo), v.box);
      const int along = plan_.axes.direction[0];
      IndexBox starts = seen;
      starts.upper[along] = starts.lower[along] + 1;
      const double first = v.data[v.offset(seen.lower)];
      const int n = seen.size()[along];
      bool same = true;
      const IntVec3 size = starts.size();
      for (int k = 0; k < size.z && same; ++k)
        for (int j = 0; j < size.y && same; ++j)
          for (int i = 0; i < size.x && same; ++i) {
            const double* row = v.data + v.offset(starts.lower + IntVec3{i, j, k});
            int different = 0;
            for (int x = 0; x < n; ++x) different += row[x] != first;
            same = different == 0;
          }
      if (!same) return false;
    }
  }
  return true;
}

void SweepExecutor::sleep(Worker& worker, const StepConstants& step, const Block& block) {
  // Peel off the cells along the boundary of the domain, side by side, each cell once.
  IndexBox rest = block.cells;
  for (int a = 0; a < plan_.axes.count && !rest.empty(); ++a) {
    const int d = plan_.axes.direction[a];
    if (level_->periodic[static_cast<std::size_t>(d)]) continue;
    if (rest.lower[d] == level_->domain.lower[d]) {
      IndexBox strip = rest;
      strip.upper[d] = strip.lower[d] + 1;
      worker.sweep.run(step, block.box, strip, worker.reductions);
      rest.lower[d] += 1;
    }
    if (!rest.empty() && rest.upper[d] == level_->domain.upper[d]) {
      IndexBox strip = rest;
      strip.lower[d] = strip.upper[d] - 1;
      worker.sweep.run(step, block.box, strip, worker.reductions);
      rest.upper[d] -= 1;
    }
  }
  if (rest.empty()) return;
  worker.sweep.run(step, block.box, {rest.lower, rest.lower + IntVec3{1, 1, 1}}, worker.reductions);
  for (std::size_t v = 0; v < list_->variables().size(); ++v) {
    const Variable& variable = list_->variables()[v];
    if (variable.storage != Storage::new_state || !plan_.used[v]) continue;
    const int from = binding_.old_state->find(variable.label, variable.material);
    for (int c = 0; c < variable.components; ++c) {
      const RealView old = binding_.old_state->view(from, c, block.box);
      const RealView now = binding_.new_state->view(binding_.slot[v], c, block.box);
      const double value = old.data[old.offset(rest.lower)];
      const int along = plan_.axes.direction[0];
      IndexBox starts = rest;
      starts.upper[along] = starts.lower[along] + 1;
      const int n = rest.size()[along];
      for_each_cell(starts, [&](IntVec3 cell) {
        double* row = now.data + now.offset(cell);
        for (int x = 0; x < n; ++x) row[x] = value;
      });
    }
  }
}

void SweepExecutor::run_timed_block(Worker& worker, const StepConstants& step, std::size_t n) {
  const auto start = std::chrono::steady_clock::now();
  run_block(worker, step, n);
  worker.boxes[static_cast<std::size_t>(blocks_[n].box)] +=
      (std::chrono::steady_clock::now() - start).count();
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

void SweepExecutor::run_block(Worker& worker, const StepConstants& step, std::size_t n) {
  const Block& block = blocks_[n];
  if (options_.quiet_blocks && block.may_sleep && is_quiet(block)) {
    sleep(worker, step, block);
    ++worker.asleep;
    return;
  }
  const auto every = static_cast<std::size_t>(options_.sample_every);
  const bool sample =
      every > 0 && (n + static_cast<std::size_t>(passes_) * blocks_.size()) % every == 0;
  worker.sweep.run(step, block.box, block.cells, worker.reductions,
                   sample ? &worker.times : nullptr);
  ++worker.run;
  if (sample) ++worker.sampled;
}

const Reductions& SweepExecutor::run(const StepConstants& step) {
  for (auto& w : workers_) w->reductions.clear();
  team_->for_each(blocks_.size(), [&](std::size_t n, int thread) {
    Worker& worker = *workers_[static_cast<std::size_t>(thread)];
    options_.time_boxes ? run_timed_block(worker, step, n) : run_block(worker, step, n);
  });
  total_.clear();
  blocks_run_ = kept_run_;
  blocks_asleep_ = kept_asleep_;
  for (auto& w : workers_) {
    total_.merge(w->reductions);
    blocks_run_ += w->run;
    blocks_asleep_ += w->asleep;
  }
  ++passes_;
  return total_;
}

std::size_t SweepExecutor::scratch_bytes() const {
  std::size_t n = 0;
  for (const auto& w : workers_) n += w->sweep.scratch_bytes();
  return n;
}

std::vector<double> SweepExecutor::task_seconds() const {
  std::vector<double> seconds(plan_.tasks.size(), 0.0);
  std::int64_t sampled = kept_sampled_, run = kept_run_;
  for (std::size_t t = 0; t < times_.size(); ++t)
    seconds[t] += 1e-9 * static_cast<double>(times_[t]);
  for (const auto& w : workers_) {
    sampled += w->sampled;
    run += w->run;
    for (std::size_t t = 0; t < seconds.size(); ++t)
      seconds[t] += 1e-9 * static_cast<double>(w->times[t]);
  }
  const double scale = sampled > 0 ? static_cast<double>(run) / static_cast<double>(sampled) : 0.0;
  for (double& s : seconds) s *= scale;
  return seconds;
}

}  // namespace sluice
