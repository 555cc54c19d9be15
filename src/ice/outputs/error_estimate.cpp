// Estimated errors of variables, for the criterion of refinement with a tolerance.
//
// The idea is that of Berger and Colella, J. Comput. Phys. 82 (1989) 64: what the solution looks
// like on a grid of twice the spacing tells how well this one resolves it. They step both grids;
// here the values themselves are compared. Full weighting (q_{i-1} + 2 q_i + q_{i+1})/4 is what a
// grid of twice the spacing holds at cell i; the difference to q_i is the undivided second
// difference over 4, of order dx^2 where q is smooth and a share of the jump where it is not.
#include <algorithm>
#include <cmath>

#include "ice/fluid/labels.hpp"
#include "ice/outputs/criteria.hpp"
#include "ice/step/effect_ids.hpp"

namespace sluice::ice {
namespace {

// The neighbours are added first: mirrored scenes give mirrored bits.
void add_axis(int n, const double* __restrict low, const double* __restrict middle,
              const double* __restrict high, double* __restrict sum) {
  for (int i = 0; i < n; ++i) sum[i] += 0.25 * std::fabs(low[i] + high[i] - 2.0 * middle[i]);
}

constexpr int chunk = 256;  // cells whose sums stay in the nearest cache

void estimate_row(const Row& row, In in, Out out, int components, int axes) {
  double sum[chunk];
  double* estimate = row(out);
  std::fill_n(estimate, row.count(), 0.0);
  for (int start = 0; start < row.count(); start += chunk) {
    const int n = std::min(chunk, row.count() - start);
    for (int c = 0; c < components; ++c) {
      std::fill_n(sum, n, 0.0);
      const double* middle = row(in, c) + start;
      for (int a = 0; a < axes; ++a)
        add_axis(n, row(in, c, a, -1) + start, middle, row(in, c, a, 1) + start, sum);
      double* largest = estimate + start;
      for (int i = 0; i < n; ++i) largest[i] = sum[i] > largest[i] ? sum[i] : largest[i];
    }
  }
}

}  // namespace

Label estimate_label(Label variable) {
  const LabelInfo& info = variable.info();
  return declare_label({"estimate." + info.name, ValueType::real, Centring::cell, info.unit,
                        "Estimated error of " + info.name + "."});
}

std::vector<ErrorEstimate> wanted_estimates(const std::vector<ErrorCriterion>& criteria) {
  std::vector<ErrorEstimate> wanted;
  labels();  // declares them
  for (const ErrorCriterion& c : criteria) {
    const Label value = *find_label(c.label);
    const auto same = std::find_if(wanted.begin(), wanted.end(), [&](const ErrorEstimate& e) {
      return e.value == value && e.material == c.material;
    });
    if (same != wanted.end())
      same->tolerance = std::min(same->tolerance, c.tolerance);
    else
      wanted.push_back({value, estimate_label(value), c.material, c.tolerance});
  }
  return wanted;
}

void add_error_estimates(TaskList& list, const std::vector<DiagnosticQuantity>& quantities,
                         const SchemeOptions& options,
                         const std::vector<ErrorEstimate>& estimates) {
  for (const ErrorEstimate& e : estimates) {
    const DiagnosticQuantity& q = quantity(quantities, e.value.name(), e.material);
    TaskBuilder task = list.task("estimate the error of " + q.label.name(), effect_diagnostics);
    const In in = task.read(q.variable, Stencil::box(1));
    const Out out = task.write(list.output(e.estimate, e.material));
    task.kernel([=, components = q.components, axes = options.grid.axes.count](const Row& row) {
      estimate_row(row, in, out, components, axes);
    });
  }
}

}  // namespace sluice::ice
