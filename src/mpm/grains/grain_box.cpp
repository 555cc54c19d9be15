#include "mpm/grains/grain_box.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpm {

void add_grain_boxes(const ParticleSet& set, const Columns& c, double loosest, const Level& level,
                     std::vector<GrainBox>& boxes, double& corners) {
  // Places of neighbours carry round-off: boxes that should touch do.
  constexpr double slack = 1 + 1e-9;
  const auto F = read_columns<9>(set, c.F), R0 = read_columns<9>(set, c.size);
  const double* volume = set.column(c.volume);
  const double* volume_0 = set.column(c.volume_0);
  const double power = 1.0 / std::max(1, level.active_count());
  for (std::size_t p = 0; p < set.size(); ++p) {
    GrainBox& box = boxes.emplace_back();
    box.id = box.label = set.id(p);
    const double scale = slack * std::pow(loosest * volume_0[p] / volume[p], power);
    double far = 0;
    for (int d = 0; d < 3; ++d) {
      if (!level.active[d]) continue;
      box.place[d] = set.coordinate(d)[p];
      double squares = 0, along = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        if (!level.active[k]) continue;
        double edge = 0;
        for (std::size_t j = 0; j < 3; ++j)
          edge += F[3 * d + j][p] * level.spacing[static_cast<int>(j)] * R0[3 * j + k][p];
        squares += edge * edge;
        along += std::fabs(edge);
      }
      box.half[d] = std::min(0.5 * scale * std::sqrt(squares), level.spacing[d]);
      far = std::max(far, 0.5 * along / level.spacing[d]);
    }
    corners = std::max(corners, far);
  }
}

}  // namespace sluice::mpm
