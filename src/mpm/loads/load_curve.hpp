// The value of a load at a time (s), in the unit of its points: LoadCurve::points.
#pragma once
#include <algorithm>
#include <utility>
#include <vector>

namespace sluice::mpm {

// Straight between points, the last load after the last; before the first the first piece goes on.
// 0 without points.
inline double load_at(const std::vector<std::pair<double, double>>& points, double time) {
  if (points.empty()) return 0;
  if (points.size() == 1 || time >= points.back().first) return points.back().second;
  const auto after = std::max(
      points.begin() + 1,
      std::upper_bound(points.begin(), points.end(), time,
                       [](double t, const std::pair<double, double>& p) { return t < p.first; }));
  const auto before = after - 1;
  const double width = after->first - before->first;
  if (!(width > 0)) return after->second;
  return before->second + (after->second - before->second) * ((time - before->first) / width);
}

}  // namespace sluice::mpm
