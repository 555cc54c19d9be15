// Error norms of a computed field against the exact one.
#pragma once
#include <string>
#include <vector>

#include "exact/base/exact_solution.hpp"

namespace sluice::exact {

// The quantity of a state, in the SI unit of the variable (specific_heat in J/(kg K)), that a saved
// variable holds: rho_CC, press_CC, temp_CC, vel_CC (its component 0, 1 or 2), sp_vol_CC. Throws
// InputError for a variable without exact value.
double exact_value(const State& state, const std::string& variable, int component,
                   double specific_heat);

// Mean |d|, root of the mean d^2, and largest |d| of the differences, summed exactly so that the
// order does not count: in the unit of the field. relative_l1 divides by the mean |exact|.
struct ErrorNorms {
  double l1 = 0, l2 = 0, linf = 0, relative_l1 = 0;
  std::size_t points = 0;
};
// `volumes` weights the points, in any unit; empty: all alike. With an `offset` relative_l1 divides
// by the mean |exact - offset|: of what varies about a large value.
ErrorNorms error_norms(const std::vector<double>& computed, const std::vector<double>& exact,
                       const std::vector<double>& volumes = {}, double offset = 0);

}  // namespace sluice::exact
