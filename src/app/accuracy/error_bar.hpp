// The error of a run without an exact solution, from runs on coarser grids (Richardson).
//
//   d_n = |f_n - f_(n+1)|                     differences of neighbouring resolutions of ratio r
//   p   = log(d_(n-1) / d_n) / log r          observed order
//   e   = d_n / (r^p - 1)                     error of the finest run
//
// The bar is 1.25 e. An order above one is used only if the next coarser differences show it too:
// at jumps, coarse grids seem to converge faster than they do. Source: P. J. Roache, Verification
// and Validation in Computational Science and Engineering (1998), chapter 5.
#pragma once
#include <optional>
#include <vector>

namespace sluice {

struct ErrorBar {
  std::optional<double> order;  // as observed; none where a difference is zero
  double used_order = 1;
  double bar = 0;         // of the finest run, in the unit of the differences
  bool diverges = false;  // the finest pair differs more than the next coarser one

  // The bar of a grid whose cells are `factor` times larger than those of the finest run.
  double at_spacing(double factor) const;
};

// Differences (at least 0, in one norm) from coarse to fine, two or more; `ratio` > 1.
ErrorBar error_bar(const std::vector<double>& differences, double ratio);

}  // namespace sluice
