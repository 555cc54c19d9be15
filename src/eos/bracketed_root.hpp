// Root of a rising function between two ends: Newton, safeguarded by a bracket.
//
// A Newton step that leaves the bracket, or one that has not halved the residual, is replaced by
// the middle of the bracket (the geometric middle where the ends are decades apart); after 16 steps
// every second one is. So the search ends for any function that changes sign, smooth or not (after
// Press et al., Numerical Recipes, section 9.4). Argument and value may have any units; the slope
// has their quotient.
#pragma once
#include <cmath>
#include <limits>

namespace sluice::eos {

struct ValueAndSlope {
  double value, slope;
};

inline double middle_of(double low, double high) {
  return low > 0.0 && high > 4.0 * low ? std::sqrt(low) * std::sqrt(high)
                                       : low + 0.5 * (high - low);
}

// `f(x)` gives ValueAndSlope with value(low) <= 0 <= value(high).
template <class Function>
double bracketed_root(const Function& f, double low, double high, double start) {
  constexpr int quick = 16, max_steps = 4000;
  constexpr double close = 4.0 * std::numeric_limits<double>::epsilon();
  double x = start >= low && start <= high ? start : middle_of(low, high);
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < max_steps; ++step) {
    const ValueAndSlope at = f(x);
    if (at.value == 0.0) return x;
    (at.value < 0.0 ? low : high) = x;
    double next = x - at.value / at.slope;
    const bool inside = next > low && next < high;
    if (inside && std::abs(next - x) <= close * std::abs(x)) return next;
    const bool slow = !(std::abs(at.value) <= 0.5 * last) || (step > quick && step % 2 == 0);
    if (!inside || slow) next = middle_of(low, high);
    if (!(high - low > close * std::abs(high)) || next == x) return x;
    last = std::abs(at.value);
    x = next;
  }
  return x;
}

}  // namespace sluice::eos
