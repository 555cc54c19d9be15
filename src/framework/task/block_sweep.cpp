// Binding of variables to memory and the plane loop.
#include "framework/task/block_sweep.hpp"

#include <limits>
#include <utility>

namespace sluice {
namespace {

using Clock = std::chrono::steady_clock;

// Length of one row of a buffer: the window, rounded up so that rows start on cache lines.
std::ptrdiff_t padded(std::ptrdiff_t n) {
  return (n + 7) / 8 * 8;
}

struct CanonicalBox {
  int low[3] = {0, 0, 0};
  int high[3] = {1, 1, 1};
};

// Level box in the order row, middle, swept; directions that are not active are left out.
CanonicalBox canonical(const IndexBox& b, const Axes& axes) {
  CanonicalBox c;
  for (int a = 0; a < axes.count; ++a) {
    const int place = a == 0 ? 0 : a == axes.count - 1 ? 2 : 1;
    c.low[place] = b.lower[axes.direction[a]];
    c.high[place] = b.upper[axes.direction[a]];
  }
  return c;
}

IndexBox window_of(const IndexBox& block, const Growth& g) {
  return {block.lower - g.low, block.upper + g.high};
}

std::ptrdiff_t buffer_size(const PlannedBuffer& b, IntVec3 block, const Axes& axes,
                           int components) {
  const IndexBox window = window_of({IntVec3{}, block}, b.window);
  const CanonicalBox c = canonical(window, axes);
  const std::ptrdiff_t rows =
      static_cast<std::ptrdiff_t>(c.high[1] - c.low[1]) * (axes.count > 1 ? b.planes : 1);
  return padded(c.high[0] - c.low[0]) * rows * components;
}

}  // namespace

BlockSweep::BlockSweep(const TaskList& list, const SweepPlan& plan, const Level& level,
                       const StateBinding& binding, IntVec3 largest_block,
                       std::shared_ptr<AlignedArray> scratch)
    : list_(&list), plan_(&plan), level_(&level), binding_(&binding), scratch_(std::move(scratch)) {
  bound_.resize(list.variables().size());
  components_.resize(list.variables().size());
  std::ptrdiff_t total = 0;
  for (const PlannedBuffer& b : plan.buffers)
    total += buffer_size(b, largest_block, plan.axes, list[b.variable].components);
  if (scratch_->size() < static_cast<std::size_t>(total))
    *scratch_ = AlignedArray(static_cast<std::size_t>(total));
  windows_.reserve(plan.tasks.size());
  for (const PlannedTask& p : plan.tasks) {
    const Task& t = list.tasks()[static_cast<std::size_t>(p.task)];
    auto& r = reads_.emplace_back();
    for (const Access& a : t.reads)
      r.push_back(&bound_[static_cast<std::size_t>(a.variable.index)]);
    auto& w = writes_.emplace_back();
    for (VariableId v : t.writes) w.push_back(&bound_[static_cast<std::size_t>(v.index)]);
  }
}

void BlockSweep::bind_states(int box) {
  for (std::size_t v = 0; v < bound_.size(); ++v) {
    const Variable& variable = list_->variables()[v];
    if (variable.storage == Storage::temporary || !plan_->used[v]) continue;
    const Warehouse* warehouse = variable.storage == Storage::old_state   ? binding_->old_state
                                 : variable.storage == Storage::new_state ? binding_->new_state
                                                                          : binding_->output;
    const int slot = binding_->slot[v];
    components_[v].clear();
    RealView view;
    for (int c = 0; c < variable.components; ++c) {
      view = warehouse->view(slot, c, box);
      components_[v].push_back(view.data);
    }
    BoundArray& b = bound_[v];
    b = {};
    b.components = components_[v].data();
    const CanonicalBox c = canonical(view.box, plan_->axes);
    for (int place = 0; place < 3; ++place) b.low[place] = c.low[place];
    const int n = plan_->axes.count;
    if (n == 3) b.stride[1] = view.stride[plan_->axes.direction[1]];
    if (n > 1) b.stride[2] = view.stride[plan_->axes.direction[n - 1]];
  }
}

void BlockSweep::bind_scratch(const IndexBox& block) {
  double* next = scratch_->data();
  for (const PlannedBuffer& p : plan_->buffers) {
    BoundArray& b = bound_[static_cast<std::size_t>(p.variable.index)];
    b = {};
    const CanonicalBox c = canonical(window_of(block, p.window), plan_->axes);
    const int planes = plan_->axes.count > 1 ? p.planes : 1;
    b.data = next;
    b.low[0] = c.low[0];
    b.low[1] = c.low[1];
    b.low[2] = 0;  // the ring wraps planes of any index
    b.stride[1] = padded(c.high[0] - c.low[0]);
    b.stride[2] = b.stride[1] * (c.high[1] - c.low[1]);
    b.mask = planes - 1;
    b.component_stride = b.stride[2] * planes;
    next += b.component_stride * (*list_)[p.variable].components;
  }
}

void BlockSweep::run_plane(std::size_t task, const IndexBox& window, int plane, Row& row) {
  const RowKernel& kernel =
      list_->tasks()[static_cast<std::size_t>(plan_->tasks[task].task)].kernel;
  const CanonicalBox c = canonical(window, plan_->axes);
  const Axes& axes = plan_->axes;
  row.reads_ = reads_[task].data();
  row.writes_ = writes_[task].data();
  row.count_ = c.high[0] - c.low[0];
  row.index_[0] = c.low[0];
  row.index_[2] = plane;
  row.cell_ = level_->domain.lower;
  row.cell_[axes.direction[0]] = c.low[0];
  if (axes.count > 1) row.cell_[axes.direction[axes.count - 1]] = plane;
  for (int j = c.low[1]; j < c.high[1]; ++j) {
    row.index_[1] = j;
    if (axes.count == 3) row.cell_[axes.direction[1]] = j;
    kernel(row);
  }
}

void BlockSweep::run(const StepConstants& step, int box, const IndexBox& block,
                     Reductions& reductions, TaskTimes* times) {
  bind_states(box);
  bind_scratch(block);
  Row row;
  row.axes_ = plan_->axes.count;
  row.along_ = plan_->axes.direction[0];
  row.step_ = &step;
  row.reductions_ = &reductions;
  row.box_ = box;
  row.block_low_ = block.lower;
  row.block_high_ = block.upper;
  const Axes& axes = plan_->axes;
  const int swept = axes.count > 1 ? axes.direction[axes.count - 1] : -1;
  windows_.clear();
  int first = std::numeric_limits<int>::max(), last = std::numeric_limits<int>::min();
  for (const PlannedTask& p : plan_->tasks) {
    const IndexBox w = window_of(block, p.window);
    windows_.push_back(w);
    if (swept < 0) continue;
    first = std::min(first, w.lower[swept] - p.lead);
    last = std::max(last, w.upper[swept] - p.lead);
  }
  if (swept < 0) {
    first = 0;
    last = 1;
  }
  for (int k = first; k < last; ++k)
    for (std::size_t t = 0; t < plan_->tasks.size(); ++t) {
      const int plane = swept >= 0 ? k + plan_->tasks[t].lead : 0;
      if (swept >= 0 && (plane < windows_[t].lower[swept] || plane >= windows_[t].upper[swept]))
        continue;
      if (times == nullptr) {
        run_plane(t, windows_[t], plane, row);
      } else {
        const auto start = Clock::now();
        run_plane(t, windows_[t], plane, row);
        (*times)[t] += (Clock::now() - start).count();
      }
    }
}

}  // namespace sluice
