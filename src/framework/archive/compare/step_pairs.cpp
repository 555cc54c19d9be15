// Pairs of steps that are each other's nearest.
#include "framework/archive/compare/step_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sluice {
namespace {

// The first of the nearest; steps.size() where there is none.
std::size_t nearest_step(const std::vector<StepEntry>& steps, double time) {
  const auto found =
      std::min_element(steps.begin(), steps.end(), [&](const StepEntry& a, const StepEntry& b) {
        return std::abs(a.time - time) < std::abs(b.time - time);
      });
  return static_cast<std::size_t>(found - steps.begin());
}

}  // namespace

std::vector<StepPair> pair_nearest_steps(const std::vector<StepEntry>& a,
                                         const std::vector<StepEntry>& b,
                                         std::optional<double> tolerance,
                                         std::vector<std::string>& left_over) {
  std::vector<StepPair> pairs;
  std::vector<char> paired(b.size(), 0);
  const auto leave = [&](const StepEntry& s, const char* archive,
                         const std::vector<StepEntry>& other) {
    const std::size_t n = nearest_step(other, s.time);
    left_over.push_back(fmt::format(
        "step {} at time {:.10g} of the {} archive has no counterpart{}", s.step, s.time, archive,
        n == other.size() ? "" : fmt::format("; the nearest is at {:.10g}", other[n].time)));
  };
  for (std::size_t n = 0; n < a.size(); ++n) {
    const std::size_t m = nearest_step(b, a[n].time);
    const bool mutual = m < b.size() && nearest_step(a, b[m].time) == n;
    if (mutual && (!tolerance || std::abs(a[n].time - b[m].time) <= *tolerance)) {
      pairs.emplace_back(a[n], b[m]);
      paired[m] = 1;
    } else {
      leave(a[n], "first", b);
    }
  }
  for (std::size_t m = 0; m < b.size(); ++m)
    if (!paired[m]) leave(b[m], "second", a);
  return pairs;
}

}  // namespace sluice
