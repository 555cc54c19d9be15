// Binding of variables to memory and the plane loop.
#include "framework/task/block_sweep.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace sluice {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int vector = 8;  // numbers in the widest vector, and in a cache line
constexpr auto unbound = static_cast<std::size_t>(-1);

template <class Integer>
Integer rounded_up(Integer n) {
  return (n + vector - 1) / vector * vector;
}

// Length of one row of a buffer: the window, rounded up so that rows start on cache lines, and room
// for the rest of a vector.
std::ptrdiff_t padded(std::ptrdiff_t n) {
  return rounded_up(n) + vector;
}

}  // namespace

BlockSweep::Window BlockSweep::window_of(const IndexBox& block, const Growth& growth,
                                         const Axes& axes) {
  Window w;
  for (int a = 0; a < axes.count; ++a) {
    const int place = a == 0 ? 0 : a == axes.count - 1 ? 2 : 1, d = axes.direction[a];
    w.low[place] = block.lower[d] - growth.low[d];
    w.high[place] = block.upper[d] + growth.high[d];
  }
  return w;
}

BlockSweep::Window BlockSweep::bounding(const Window& a, const Window& b) {
  Window w;
  for (int place = 0; place < 3; ++place) {
    w.low[place] = std::min(a.low[place], b.low[place]);
    w.high[place] = std::max(a.high[place], b.high[place]);
  }
  return w;
}

std::ptrdiff_t BlockSweep::buffer_size(const PlannedBuffer& buffer, IntVec3 block, const Axes& axes,
                                       int components) {
  const Window w = window_of({IntVec3{}, block}, buffer.window, axes);
  const std::ptrdiff_t rows =
      static_cast<std::ptrdiff_t>(w.high[1] - w.low[1]) * (axes.count > 1 ? buffer.planes : 1);
  return padded(w.high[0] - w.low[0]) * rows * components;
}

BlockSweep::BlockSweep(const TaskList& list, const SweepPlan& plan, const Level& level,
                       const StateBinding& binding, IntVec3 largest_block,
                       std::shared_ptr<AlignedArray> scratch)
    : list_(&list), plan_(&plan), level_(&level), binding_(&binding), scratch_(std::move(scratch)) {
  std::ptrdiff_t total = 0;
  std::size_t steps = 0;
  std::vector<std::size_t> number(list.variables().size(), unbound);  // in arrays_
  for (const PlannedBuffer& b : plan.buffers) {
    total += buffer_size(b, largest_block, plan.axes, list[b.variable].components);
    steps += BoundArray::count_of_steps(b.planes);
    number[b.variable.index] = arrays_.size();
    arrays_.emplace_back();
  }
  buffer_steps_.resize(steps);
  total += 2 * vector;  // what is read beyond the last row
  if (scratch_->size() < static_cast<std::size_t>(total)) *scratch_ = AlignedArray(total);
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (list.variables()[v].storage == Storage::temporary || !plan.used[v]) continue;
    number[v] = arrays_.size() + state_variables_.size();
    state_variables_.push_back(v);
  }
  for (const PlannedTask& p : plan.tasks) tasks_.push_back(bind_task(p, number));
}

// `number`: of each variable in arrays_, for the first piece.
BlockSweep::BoundTask BlockSweep::bind_task(const PlannedTask& planned,
                                            const std::vector<std::size_t>& number) const {
  const Task& t = list_->tasks()[planned.task];
  const auto stored = [&](VariableId v) { return (*list_)[v].storage != Storage::temporary; };
  const std::size_t reads = t.reads.size(), all = reads + t.writes.size();
  BoundTask task{&t.kernel,
                 t.owner->reduction_offsets(),
                 sharing_of(planned),
                 t.always || std::any_of(t.writes.begin(), t.writes.end(), stored),
                 static_cast<int>(reads),
                 RowArrays(all, plan_->axes.count)};
  for (std::size_t n = 0; n < all; ++n) {
    const VariableId v = n < reads ? t.reads[n].variable : t.writes[n - reads];
    const std::size_t array = number[v.index];
    if (array == unbound)
      throw std::logic_error("task '" + t.name + "' has no memory for '" + (*list_)[v].name + "'");
    (stored(v) ? task.states : task.buffers).emplace_back(n, array);
  }
  return task;
}

// A task that reaches beyond blocks along the swept axis may store nothing and reduce nothing, or
// results would depend on blocks; where it does, it is left to each of them.
BlockSweep::Sharing BlockSweep::sharing_of(const PlannedTask& planned) const {
  const Axes& axes = plan_->axes;
  if (axes.count < 2) return Sharing::none;
  const int swept = axes.direction[axes.count - 1];
  const Task& task = list_->tasks()[planned.task];
  if (task.always || (planned.window.low[swept] == 0 && planned.window.high[swept] == 0))
    return Sharing::none;
  for (const VariableId v : task.writes)
    if ((*list_)[v].storage != Storage::temporary) return Sharing::none;
  if (task.needs_box) return Sharing::parts;
  for (const Access& a : task.reads)
    if ((*list_)[a.variable].storage != Storage::temporary) return Sharing::states;
  return Sharing::plane;
}

void BlockSweep::bind_states(std::size_t piece, int box) {
  for (std::size_t s = 0; s < state_variables_.size(); ++s) {
    const std::size_t v = state_variables_[s];
    const Variable& variable = list_->variables()[v];
    const Warehouse* warehouse = variable.storage == Storage::old_state   ? binding_->old_state
                                 : variable.storage == Storage::new_state ? binding_->new_state
                                                                          : binding_->output;
    const RealView view = warehouse->view(binding_->slot[v], 0, box);
    const Window cells = window_of(view.box, {}, plan_->axes);
    const int n = plan_->axes.count;
    const std::size_t number = piece * state_variables_.size() + s;
    BoundArray& b = arrays_[plan_->buffers.size() + number];
    b = {};
    b.middle = n == 3 ? view.stride[plan_->axes.direction[1]] : 0;
    b.swept = n > 1 ? view.stride[plan_->axes.direction[n - 1]] : 0;
    b.first = view.data - cells.low[0] - cells.low[1] * b.middle - cells.low[2] * b.swept;
    if (variable.components > 1)
      b.component = warehouse->view(binding_->slot[v], 1, box).data - view.data;
    b.find_steps(n == 3, &state_steps_[number * BoundArray::count_of_steps(1)]);
  }
}

// Do two pieces that follow each other lie in the same frames.
bool BlockSweep::has_arrays_of_the_one_before(std::size_t piece) const {
  const std::size_t count = state_variables_.size();
  const BoundArray* now = arrays_.data() + plan_->buffers.size() + piece * count;
  return std::equal(now - count, now, now, [](const BoundArray& a, const BoundArray& b) {
    return a.first == b.first && a.component == b.component && a.middle == b.middle &&
           a.swept == b.swept;
  });
}

void BlockSweep::bind_scratch(const IndexBox& hull) {
  double* next = scratch_->data();  // others that share it may have made it larger
  if (hull == hull_ && next == scratch_data_) return;
  hull_ = hull;
  scratch_data_ = next;
  Steps* steps = buffer_steps_.data();
  BoundArray* array = arrays_.data();
  for (const PlannedBuffer& p : plan_->buffers) {
    BoundArray& b = *array++;
    const Window w = window_of(hull, p.window, plan_->axes);
    const int planes = plan_->axes.count > 1 ? p.planes : 1;
    const std::ptrdiff_t middle = padded(w.high[0] - w.low[0]);
    const std::ptrdiff_t swept = middle * (w.high[1] - w.low[1]);
    const bool same_steps = middle == b.middle && swept == b.swept;
    b.middle = middle;
    b.swept = swept;
    b.mask = planes - 1;
    b.component = b.swept * planes;
    b.first = next - w.low[0] - w.low[1] * b.middle;
    next += b.component * (*list_)[p.variable].components;
    if (!same_steps) b.find_steps(plan_->axes.count == 3, steps);
    steps += BoundArray::count_of_steps(p.planes);
  }
  for (BoundTask& t : tasks_)
    for (const auto& [access, number] : t.buffers) t.rows.bind(access, arrays_[number]);
}

void BlockSweep::run_plane(std::size_t task, const Window& window, int plane, Row& row,
                           bool alone) {
  BoundTask& t = tasks_[task];
  const Axes& axes = plan_->axes;
  row.starts_ = t.rows.starts();
  row.first_write_ = t.reads;
  row.places_ = &t.places;
  row.count_ = window.high[0] - window.low[0];
  row.whole_vectors_ = alone && !t.stores ? rounded_up(row.count_) : row.count_;
  row.cell_ = level_->domain.lower;
  row.cell_[axes.direction[0]] = window.low[0];
  if (axes.count > 1) row.cell_[axes.direction[axes.count - 1]] = plane;
  for (int j = window.low[1]; j < window.high[1]; ++j) {
    t.rows.start_row(window.low[0], j, plane);
    if (axes.count == 3) row.cell_[axes.direction[1]] = j;
    (*t.kernel)(row);
  }
}

// The arrays of one piece for a task.
void BlockSweep::choose(std::size_t task, std::size_t piece, Row& row) {
  BoundTask& t = tasks_[task];
  if (t.chosen == stack_.size() || array_set_of_piece_[t.chosen] != array_set_of_piece_[piece])
    for (const auto& [access, number] : t.states)
      t.rows.bind(access, arrays_[number + piece * state_variables_.size()]);
  t.chosen = piece;
  const SweepPiece& p = stack_[piece];
  if (row.box_ == p.box && row.block_low_ == p.cells.lower) return;
  row.box_ = p.box;
  row.block_low_ = p.cells.lower;
  row.block_high_ = p.cells.upper;
  row.old_marks_ = binding_->old_state->marks(row.box_);
  row.new_marks_ = binding_->new_state->marks(row.box_);
}

void BlockSweep::run_task(std::size_t task, int plane, Row& row) {
  std::size_t& first = tasks_[task].first_piece;
  const Sharing sharing = tasks_[task].sharing;
  while (first < stack_.size() && window(task, first).high[2] <= plane) ++first;
  std::size_t last = first;
  while (last < stack_.size() && window(task, last).low[2] <= plane) ++last;
  if (first == last) return;
  if (last - first == 1 || sharing == Sharing::none) {
    for (std::size_t n = first; n < last; ++n) {
      choose(task, n, row);
      run_plane(task, window(task, n), plane, row, last - first == 1);
    }
  } else if (sharing == Sharing::plane ||
             // In three dimensions the corners of the hull belong to no piece.
             (sharing == Sharing::states && plan_->axes.count == 2 &&
              array_set_of_piece_[first] == array_set_of_piece_[last - 1])) {
    choose(task, first, row);
    Window hull = window(task, first);
    for (std::size_t n = first + 1; n < last; ++n) hull = bounding(hull, window(task, n));
    run_plane(task, hull, plane, row, true);
  } else {
    run_parts(task, first, last, plane, row);
  }
}

// The widest piece first: of boxes that tiles leave it mostly holds what the others want. In two
// dimensions what it lacks lies at the two ends of the row.
void BlockSweep::run_parts(std::size_t task, std::size_t first, std::size_t last, int plane,
                           Row& row) {
  const auto width = [&](std::size_t n) {
    return window(task, n).high[0] - window(task, n).low[0];
  };
  std::size_t widest = first;
  for (std::size_t n = first + 1; n < last; ++n)
    if (width(n) > width(widest)) widest = n;
  Window done = window(task, widest);
  choose(task, widest, row);
  run_plane(task, done, plane, row, true);  // what it leaves beyond is computed after it
  for (std::size_t n = first; n < last; ++n) {
    if (n == widest) continue;
    Window part = window(task, n);
    if (plan_->axes.count < 3 && part.low[0] >= done.low[0] && part.high[0] <= done.high[0])
      continue;
    choose(task, n, row);
    if (plan_->axes.count == 3) {
      run_plane(task, part, plane, row);
      continue;
    }
    const int low = part.low[0], high = part.high[0];
    if (low < done.low[0]) {
      part.high[0] = done.low[0];
      run_plane(task, part, plane, row);
      done.low[0] = low;
    }
    if (high > done.high[0]) {
      part.low[0] = done.high[0];
      part.high[0] = high;
      run_plane(task, part, plane, row);
      done.high[0] = high;
    }
  }
}

// Of a task that has something to do in a part of its blocks only: that part, or nothing.
BlockSweep::Window BlockSweep::window_in(const PlannedTask& planned,
                                         const SweepPiece& piece) const {
  const Window whole = window_of(piece.cells, planned.window, plan_->axes);
  const BlockPart& part = list_->tasks()[planned.task].part;
  if (!part) return whole;
  const IndexBox cells = intersection(part(piece.box, piece.cells), piece.cells);
  if (!cells.empty()) return window_of(cells, {}, plan_->axes);
  Window nothing = whole;
  for (int place = 0; place < 3; ++place) nothing.high[place] = nothing.low[place];
  return nothing;
}

void BlockSweep::find_windows() {
  windows_.clear();
  for (const PlannedTask& p : plan_->tasks)
    for (const SweepPiece& piece : stack_) windows_.push_back(window_in(p, piece));
}

void BlockSweep::run(const StepConstants& step, int box, const IndexBox& block,
                     Reductions& reductions, TaskTimes* times) {
  const SweepPiece piece{box, block};
  run(step, {&piece, 1}, reductions, times);
}

void BlockSweep::run(const StepConstants& step, std::span<const SweepPiece> stack,
                     Reductions& reductions, TaskTimes* times) {
  stack_ = stack;
  const std::size_t states = stack.size() * state_variables_.size();
  if (arrays_.size() < plan_->buffers.size() + states) {
    arrays_.resize(plan_->buffers.size() + states);
    state_steps_.resize(states * BoundArray::count_of_steps(1));
  }
  array_set_of_piece_.resize(stack.size());
  IndexBox hull = stack.front().cells;
  for (std::size_t n = 0; n < stack.size(); ++n) {
    bind_states(n, stack[n].box);
    array_set_of_piece_[n] =
        n == 0 ? 0 : array_set_of_piece_[n - 1] + !has_arrays_of_the_one_before(n);
    hull = sluice::bounding(hull, stack[n].cells);
  }
  bind_scratch(hull);
  for (BoundTask& t : tasks_) {
    t.chosen = stack.size();
    t.first_piece = 0;
  }
  find_windows();
  Row row;
  row.box_ = -1;  // none chosen yet
  row.along_ = plan_->axes.direction[0];
  row.step_ = &step;
  row.reductions_ = &reductions;
  const bool swept = plan_->axes.count > 1;
  int first = 0, last = 1;
  for (std::size_t t = 0; swept && t < plan_->tasks.size(); ++t) {
    const int lead = plan_->tasks[t].lead;
    const int low = window(t, 0).low[2] - lead, high = window(t, stack.size() - 1).high[2] - lead;
    first = t == 0 ? low : std::min(first, low);
    last = t == 0 ? high : std::max(last, high);
  }
  const auto run_one = [&](std::size_t t, int k) {
    if (swept) return run_task(t, k + plan_->tasks[t].lead, row);
    if (window(t, 0).low[0] == window(t, 0).high[0]) return;
    choose(t, 0, row);
    run_plane(t, window(t, 0), 0, row, true);
  };
  for (int k = first; k < last; ++k)
    for (std::size_t t = 0; t < plan_->tasks.size(); ++t) {
      if (times == nullptr) {
        run_one(t, k);
      } else {
        const auto start = Clock::now();
        run_one(t, k);
        (*times)[t] += (Clock::now() - start).count();
      }
    }
}

}  // namespace sluice
