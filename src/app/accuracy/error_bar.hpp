// The error of a run without an exact solution, from runs on coarser grids (Richardson).
//
//   d_1 = |f_h - f_rh|, d_2 = |f_rh - f_rrh|   differences of neighbouring resolutions of ratio r
//   p   = log(d_2 / d_1) / log r               observed order
//   e_h = d_1 / (r^p - 1)                      error of the finest run
//
// The bar is a multiple of e_h: the order of three runs is uncertain, and where it lies outside of
// what schemes have, it is replaced by the nearest one that they do. Source: P. J. Roache,
// Verification and Validation in Computational Science and Engineering (1998), chapter 5.
#pragma once
#include <optional>

namespace sluice {

struct ErrorBar {
  std::optional<double> order;  // as observed; none where a difference is zero
  double bar = 0;               // of the finest run, in the unit of the differences
  bool diverges = false;        // the finer pair differs more than the coarser one

  // The bar of a grid whose cells are `factor` times larger than those of the finest run.
  double at_spacing(double factor) const;
  double used_order() const { return used_order_; }

  double used_order_ = 1;
};

// `coarse` is d_2, `fine` d_1, both at least 0 and in one norm; `ratio` > 1.
ErrorBar error_bar(double coarse, double fine, double ratio);

}  // namespace sluice
