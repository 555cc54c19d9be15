// The observed order of convergence of three runs at different resolutions, and what it says of the
// error of the finest.
//
//   e12 = ||u1 - u2||, e23 = ||u2 - u3||        L1, L2, Linf of means over the coarsest run's cells
//   e12 / e23 = (h1^p - h2^p) / (h2^p - h3^p)     u = U + C h^p
//   ||u3 - U|| = e23 h3^p / (h2^p - h3^p)
#pragma once
#include <array>
#include <string>
#include <vector>

#include "framework/archive/compare/norms.hpp"

namespace sluice {

struct NormOrder {
  double coarse = 0, fine = 0;  // e12, e23, in the unit of the label
  double order = 0;             // NaN: e12 or e23 is zero, or they have no order
  double error = 0;             // of the finest run, estimated; NaN: the order is not positive
};

struct OrderRow {
  double time = 0;  // s, of the coarsest run
  int material = 0;
  std::string label;  // vectors: label.x and so on
  std::int64_t points = 0;
  std::array<NormOrder, 3> norms;  // L1, L2, Linf
};

struct OrderResult {
  std::array<std::size_t, 3> sorted{};  // places of the archives, the coarsest first
  std::array<double, 3> cells{};        // cell sizes of those, along a direction that is refined, m
  std::vector<OrderRow> rows;
  std::vector<std::string> skipped, notes;  // as in NormsResult
};

// InputError where two have the same resolution, or their cells do not nest.
OrderResult observed_orders(const std::array<const Archive*, 3>& archives,
                            const NormsOptions& options);

// p for cell sizes in the ratios r12 = h1/h2 and r23 = h2/h3, both above 1; NaN: none.
double order_of(double e12, double e23, double r12, double r23);

}  // namespace sluice
