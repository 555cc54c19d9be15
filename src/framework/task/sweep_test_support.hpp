// Random task graphs with an obvious reference, for the tests of the sweep. Numbers have no unit.
//
// Every written value is a weighted sum of values that its task reads at shifted places; the
// reference computes it cell by cell, recursively, with nothing of windows, rings or blocks.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/task/graph.hpp"

namespace sluice::sweep_test {

// One summand: a read shifted along one axis, or along two.
struct Term {
  int read = 0;  // among the task's reads
  int component = 0;
  int axis = 0, shift = 0;
  int other = -1, step = 0;
  bool by_offset = false;  // asked for by all axes at once
  double weight = 0;
};

struct Written {
  VariableId variable;
  std::vector<std::vector<Term>> terms;  // by component
};

struct RandomTask {
  std::vector<VariableId> reads;
  std::vector<Written> writes;
};

inline Label test_label(int n) {
  return declare_label(
      {"test_state_" + std::to_string(n), ValueType::real, Centring::cell, "1", "for tests"});
}

class RandomGraph {
 public:
  RandomGraph(unsigned seed, const Axes& axes) : random_(seed), axes_(axes) {
    states_ = {list.old_state(test_label(0), 0, 2), list.old_state(test_label(1), 0, 1)};
    std::vector<VariableId> readable = states_;
    const int temporaries = 2 + pick(5);
    for (int t = 0; t < temporaries; ++t) {
      const VariableId v = list.temporary("t" + std::to_string(t), 1 + pick(3));
      add_task(readable, {v});
      readable.push_back(v);
    }
    news = {list.new_state(test_label(0), 0, 2), list.new_state(test_label(1), 0, 1)};
    add_task(readable, {news[0], news[1]});
  }

  TaskList list;
  std::vector<VariableId> news;

  static double initial(int state, int component, IntVec3 c) {
    auto h = static_cast<std::uint64_t>(c.x * 73 + c.y * 19349 + c.z * 83492 + 7919 * state +
                                        component * 104729 + 1000003);
    h = (h ^ (h >> 13)) * 0x9E3779B97F4A7C15ULL;
    return static_cast<double>(h >> 40) * 0x1p-24 - 0.5;
  }

  // The value that a variable must have.
  double reference(VariableId v, int component, IntVec3 cell) {
    for (std::size_t s = 0; s < states_.size(); ++s)
      if (v == states_[s]) return initial(static_cast<int>(s), component, cell);
    const auto key = std::make_tuple(v.index, component, cell.x, cell.y, cell.z);
    if (const auto known = known_.find(key); known != known_.end()) return known->second;
    const auto [task, written] = writers_.at(v.index);
    double sum = 0;
    for (const Term& t : tasks_[task].writes[written].terms[component]) {
      IntVec3 place = cell;
      place[axes_.direction[t.axis]] += t.shift;
      if (t.other >= 0) place[axes_.direction[t.other]] += t.step;
      sum += t.weight * reference(tasks_[task].reads[t.read], t.component, place);
    }
    known_[key] = sum;
    return sum;
  }

 private:
  int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  Term random_term(const std::vector<VariableId>& reads) {
    Term t;
    t.read = pick(static_cast<int>(reads.size()));
    t.component = pick(list[reads[t.read]].components);
    t.axis = pick(axes_.count);
    t.shift = pick(2 * max_reach + 1) - max_reach;
    if (axes_.count > 1 && pick(2) == 0) {
      t.other = (t.axis + 1 + pick(axes_.count - 1)) % axes_.count;
      t.step = pick(4) - 1;
      t.by_offset = pick(2) == 0;
    }
    t.weight = 0.1 * (1 + pick(9)) * (pick(2) == 0 ? 1 : -1);
    return t;
  }

  void add_task(const std::vector<VariableId>& readable, const std::vector<VariableId>& writes) {
    RandomTask task;
    for (int r = 0; r < 1 + pick(3); ++r)
      task.reads.push_back(readable[pick(static_cast<int>(readable.size()))]);
    std::vector<Stencil> stencils(task.reads.size());
    for (VariableId v : writes) {
      Written w{v, {}};
      for (int c = 0; c < list[v].components; ++c) {
        auto& terms = w.terms.emplace_back();
        for (int n = 0; n < 1 + pick(4); ++n) {
          const Term t = random_term(task.reads);
          Stencil& s = stencils[t.read];
          widen(s, t.axis, t.shift);
          if (t.other >= 0) widen(s, t.other, t.step);
          terms.push_back(t);
        }
      }
      writers_[v.index] = {tasks_.size(), task.writes.size()};
      task.writes.push_back(w);
    }
    declare(task, stencils);
    tasks_.push_back(task);
  }

  void widen(Stencil& s, int axis, int shift) const {
    const int d = axes_.direction[axis];
    s.low[d] = std::max(s.low[d], -shift);
    s.high[d] = std::max(s.high[d], shift);
  }

  static const double* row_of(const Row& row, In from, const Term& t) {
    if (t.other < 0) return row(from, t.component, t.axis, t.shift);
    if (!t.by_offset) return row.at_corner(from, t.component, t.axis, t.shift, t.other, t.step);
    std::array<int, 3> offset{};
    offset[t.axis] = t.shift;
    offset[t.other] = t.step;
    return row.at_offset(from, t.component, offset);
  }

  void declare(const RandomTask& task, const std::vector<Stencil>& stencils) {
    TaskBuilder builder = list.task("task " + std::to_string(tasks_.size()), 0);
    std::vector<In> in;
    std::vector<Out> out;
    for (std::size_t r = 0; r < task.reads.size(); ++r)
      in.push_back(builder.read(task.reads[r], stencils[r]));
    for (const Written& w : task.writes) out.push_back(builder.write(w.variable));
    builder.kernel([=](const Row& row) {
      for (std::size_t w = 0; w < out.size(); ++w)
        for (std::size_t c = 0; c < task.writes[w].terms.size(); ++c) {
          double* result = row(out[w], static_cast<int>(c));
          // Beyond the row nobody may read.
          std::fill(result + row.count(), result + row.whole_vectors(),
                    std::numeric_limits<double>::quiet_NaN());
          for (int i = 0; i < row.count(); ++i) {
            double sum = 0;
            for (const Term& t : task.writes[w].terms[c]) {
              const In from = in[t.read];
              sum += t.weight * row_of(row, from, t)[i];
            }
            result[i] = sum;
          }
        }
    });
  }

  std::mt19937 random_;
  Axes axes_;
  std::vector<VariableId> states_;
  std::vector<RandomTask> tasks_;
  std::map<int, std::pair<std::size_t, std::size_t>> writers_;
  std::map<std::tuple<int, int, int, int, int>, double> known_;
};

inline Axes axes_of(const Level& level) {
  Axes axes;
  axes.count = 0;
  for (int d = 0; d < 3; ++d)
    if (level.active[d]) axes.direction[axes.count++] = d;
  return axes;
}

// A level of `cells`, inactive where there is one cell, cut into `pieces` boxes of rank 0.
inline Level level_of(IntVec3 cells, IntVec3 pieces = {1, 1, 1}, IntVec3 low = {0, 0, 0}) {
  Level level;
  level.domain = {low, low + cells};
  for (int d = 0; d < 3; ++d) level.active[d] = cells[d] > 1;
  for (const IndexBox& b : split(level.domain, pieces))
    level.boxes.push_back({b, 0, static_cast<int>(level.boxes.size())});
  return level;
}

}  // namespace sluice::sweep_test
