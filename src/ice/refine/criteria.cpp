// Gradients against thresholds.
//
// |grad q|^2 = sum over directions (and components) of (q_{i+1} - q_{i-1})^2 / (4 dx^2) is compared
// with the threshold squared: neither roots nor divisions are left in the loops.
#include "ice/refine/criteria.hpp"

#include <algorithm>
#include <stdexcept>

#include "ice/ice.hpp"
#include "ice/labels.hpp"

namespace sluice::ice {
namespace {

constexpr int chunk = 256;  // cells whose sums stay in registers and the nearest cache

struct Threshold {
  In in;
  int components = 1;
  double squared = 0;
};

void add_squares(int n, const double* __restrict low, const double* __restrict high, double weight,
                 double* __restrict sum) {
  for (int i = 0; i < n; ++i) {
    const double difference = high[i] - low[i];
    sum[i] += weight * (difference * difference);
  }
}

void mark(int n, const double* __restrict sum, double most, double* __restrict flag) {
  for (int i = 0; i < n; ++i) flag[i] = sum[i] > most ? 1.0 : flag[i];
}

void flag_row(const Row& row, const std::vector<Threshold>& thresholds, const Axes& axes, Out out) {
  double* flag = row(out);
  std::fill_n(flag, row.count(), 0.0);
  double sum[chunk];
  for (const Threshold& t : thresholds)
    for (int start = 0; start < row.count(); start += chunk) {
      const int n = std::min(chunk, row.count() - start);
      std::fill_n(sum, n, 0.0);
      for (int c = 0; c < t.components; ++c)
        for (int a = 0; a < axes.count; ++a) {
          const double dx = row.step().spacing[axes.direction[a]];
          add_squares(n, row(t.in, c, a, -1) + start, row(t.in, c, a, 1) + start, 0.25 / (dx * dx),
                      sum);
        }
      mark(n, sum, t.squared, flag + start);
    }
}

const DiagnosticQuantity& find(const std::vector<DiagnosticQuantity>& quantities,
                               const std::string& label) {
  for (const DiagnosticQuantity& q : quantities)
    if (q.label.name() == label) return q;
  throw std::logic_error("criterion of refinement on " + label + ": no such variable");
}

}  // namespace

void add_refine_flag(TaskList& list, const std::vector<DiagnosticQuantity>& quantities,
                     const SchemeOptions& options,
                     const std::vector<RefinementCriterion>& criteria) {
  TaskBuilder task = list.task("compute refineFlag", effect_diagnostics);
  std::vector<Threshold> thresholds;
  for (const RefinementCriterion& c : criteria) {
    const DiagnosticQuantity& q = find(quantities, c.label);
    thresholds.push_back({task.read(q.variable, Stencil::box(1)), q.components, c.value * c.value});
  }
  const Out out = task.write(list.output(labels().refine_flag, 0));
  task.kernel([=, axes = options.axes](const Row& row) { flag_row(row, thresholds, axes, out); });
}

}  // namespace sluice::ice
