// The cells from which a line of <lineExtract> takes its values.
//
// With a <stepSize> the points start + n stepSize, n = 0, 1, ... up to the end, each standing for
// the cell that holds it; without one every cell that the line passes through. A cell comes once.
// A point on a face between two cells belongs to the upper one, on the high end of the domain to
// the last. What lies outside the domain is left out.
#pragma once
#include <vector>

#include "framework/grid/level.hpp"
#include "framework/scene/analysis_settings.hpp"

namespace sluice {

struct LineCells {
  std::vector<IntVec3> cells;  // from the start to the end of the line
  bool clipped = false;        // a part lies outside the domain
};

LineCells cells_on_line(const AnalysedLine& line, const Level& level);

}  // namespace sluice
