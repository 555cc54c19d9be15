// Gradients against thresholds.
//
// |grad q|^2 = sum over directions (and components) of (q_{i+1} - q_{i-1})^2 / (4 dx^2) is compared
// with the threshold squared: neither roots nor divisions are left in the loops.
#include "ice/outputs/criteria.hpp"

#include <algorithm>

#include "ice/fluid/labels.hpp"
#include "ice/step/effect_ids.hpp"

namespace sluice::ice {
namespace {

constexpr int chunk = 256;  // cells whose sums stay in the nearest cache

struct Threshold {
  In in;
  int components = 1;
  double squared = 0;
};

// The rows on both sides of a row, by axis, and 1/(4 dx^2).
struct Neighbours {
  const double* low[3];
  const double* high[3];
  double weight[3];
};

template <int axes>
double squares(const Neighbours& q, int i) {
  double sum = 0;
  for (int a = 0; a < axes; ++a) {
    const double difference = q.high[a][i] - q.low[a][i];
    sum += q.weight[a] * (difference * difference);
  }
  return sum;
}

template <int axes>
void mark(int n, const Neighbours& of_row, double most, double* __restrict flag) {
  const Neighbours q = of_row;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) flag[i] = squares<axes>(q, i) > most ? 1.0 : flag[i];
}

template <int axes>
void add(int n, int start, const Neighbours& of_row, double* __restrict sum) {
  const Neighbours q = of_row;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) sum[i] += squares<axes>(q, start + i);
}

template <int axes>
void flag_row(const Row& row, const std::vector<Threshold>& thresholds, const Axes& dimensions,
              Out out) {
  const int count = row.count();
  double* flag = row(out);
  std::fill_n(flag, count, 0.0);
  Neighbours q;
  for (int a = 0; a < axes; ++a) {
    const double dx = row.step().spacing[dimensions.direction[a]];
    q.weight[a] = 0.25 / (dx * dx);
  }
  const auto look = [&](const Threshold& t, int component) {
    for (int a = 0; a < axes; ++a) {
      q.low[a] = row(t.in, component, a, -1);
      q.high[a] = row(t.in, component, a, 1);
    }
  };
  double sum[chunk];
  for (const Threshold& t : thresholds) {
    look(t, 0);
    if (t.components == 1) {
      mark<axes>(count, q, t.squared, flag);
      continue;
    }
    for (int start = 0; start < count; start += chunk) {
      const int n = std::min(chunk, count - start);
      std::fill_n(sum, n, 0.0);
      for (int c = 0; c < t.components; ++c) {
        look(t, c);
        add<axes>(n, start, q, sum);
      }
      for (int i = 0; i < n; ++i) flag[start + i] = sum[i] > t.squared ? 1.0 : flag[start + i];
    }
  }
}

}  // namespace

void add_refine_flag(TaskList& list, const std::vector<DiagnosticQuantity>& quantities,
                     const SchemeOptions& options,
                     const std::vector<RefinementCriterion>& criteria) {
  TaskBuilder task = list.task("compute refineFlag", effect_diagnostics);
  std::vector<Threshold> thresholds;
  for (const RefinementCriterion& c : criteria) {
    const DiagnosticQuantity& q = quantity(quantities, c.label, c.material);
    thresholds.push_back({task.read(q.variable, Stencil::box(1)), q.components, c.value * c.value});
  }
  const Out out = task.write(list.output(labels().refine_flag, 0));
  task.kernel([=, axes = options.grid.axes](const Row& row) {
    switch (axes.count) {
      case 1:
        return flag_row<1>(row, thresholds, axes, out);
      case 2:
        return flag_row<2>(row, thresholds, axes, out);
      default:
        return flag_row<3>(row, thresholds, axes, out);
    }
  });
}

}  // namespace sluice::ice
