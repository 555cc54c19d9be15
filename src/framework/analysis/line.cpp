// Clipping a line to the domain and walking along it.
#include "framework/analysis/line.hpp"

#include <algorithm>
#include <cmath>

namespace sluice {
namespace {

// Shares of a cell: rounding of a deck's decimal numbers, and steps that find every cell anyway.
constexpr double rounding = 1e-9, smallest_step = 1e-3;

double low_end(const Level& level, int d) {
  return level.anchor[d] + level.domain.lower[d] * level.spacing[d];
}
double high_end(const Level& level, int d) {
  return level.anchor[d] + level.domain.upper[d] * level.spacing[d];
}

Vec3 point_at(const AnalysedLine& line, double t) {
  return line.start + t * (line.end - line.start);
}

// The part [t0, t1] of the line, 0 at its start and 1 at its end, inside the closed domain; t1 < t0
// when there is none. (Liang and Barsky 1984.)
struct Part {
  double t0 = 0, t1 = 1;
};
Part inside_domain(const AnalysedLine& line, const Level& level) {
  Part part;
  for (int d = 0; d < 3; ++d) {
    const double slack = rounding * level.spacing[d];
    const double low = low_end(level, d) - slack, high = high_end(level, d) + slack;
    const double from = line.start[d], along = line.end[d] - from;
    if (along == 0) {
      if (from < low || from > high) part.t1 = -1;
      continue;
    }
    const double a = (low - from) / along, b = (high - from) / along;
    part.t0 = std::max(part.t0, std::min(a, b));
    part.t1 = std::min(part.t1, std::max(a, b));
  }
  return part;
}

IntVec3 cell_of(Vec3 x, const Level& level) {
  IntVec3 cell;
  for (int d = 0; d < 3; ++d) {
    const double index = std::floor((x[d] - level.anchor[d]) / level.spacing[d] + rounding);
    const double last = level.domain.upper[d] - 1.0;
    cell[d] = static_cast<int>(std::clamp<double>(index, level.domain.lower[d], last));
  }
  return cell;
}

// Where the line passes from one cell into the next, with both ends of the part.
std::vector<double> crossings(const AnalysedLine& line, const Level& level, const Part& part) {
  std::vector<double> t = {part.t0, part.t1};
  for (int d = 0; d < 3; ++d) {
    const double along = line.end[d] - line.start[d];
    if (along == 0) continue;
    for (int i = level.domain.lower[d]; i <= level.domain.upper[d]; ++i) {
      const double here = (level.anchor[d] + i * level.spacing[d] - line.start[d]) / along;
      if (here > part.t0 && here < part.t1) t.push_back(here);
    }
  }
  std::sort(t.begin(), t.end());
  return t;
}

void add_cell(LineCells& found, IntVec3 cell) {
  if (found.cells.empty() || !(found.cells.back() == cell)) found.cells.push_back(cell);
}

}  // namespace

LineCells cells_on_line(const AnalysedLine& line, const Level& level) {
  LineCells found;
  const Part part = inside_domain(line, level);
  found.clipped = part.t0 > 0 || part.t1 < 1;
  if (part.t1 < part.t0) return found;
  const Vec3 along = line.end - line.start;
  const double length = std::sqrt(dot(along, along));
  const double cell = std::min({level.spacing.x, level.spacing.y, level.spacing.z});
  if (length <= rounding * cell) {
    add_cell(found, cell_of(line.start, level));
    return found;
  }
  if (line.step > smallest_step * cell) {
    const double per_step = line.step / length;
    const double first = std::ceil(part.t0 / per_step - rounding);
    const double last = std::floor(part.t1 / per_step + rounding);
    for (double n = first; n <= last; ++n)
      add_cell(found, cell_of(point_at(line, n * per_step), level));
    return found;
  }
  const std::vector<double> t = crossings(line, level, part);
  const double shortest = rounding * cell / length;
  for (std::size_t n = 1; n < t.size(); ++n)
    if (t[n] - t[n - 1] > shortest)
      add_cell(found, cell_of(point_at(line, 0.5 * (t[n] + t[n - 1])), level));
  return found;
}

}  // namespace sluice
