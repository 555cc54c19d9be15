// The switch and the ramp.
#include "ice/conservative/leaving_shocks.hpp"

#include "ice/limiters.hpp"

namespace sluice::ice {
namespace {

constexpr int ratio = 4, coarse_cells = 4, depth = ratio * coarse_cells;
constexpr double least_fall = 0.07, full_fall = 0.21;  // of rho c^2, over two cells

}  // namespace

IntVec3 leaving_depth(const Level& level) {
  IntVec3 d;
  for (int n = 0; n < 3; ++n) d[n] = level.index > 0 && level.ratio[n] >= ratio ? depth : 0;
  return d;
}

void damp_leaving_shocks(const Row& row, const InterfaceDistance& ends, int axis,
                         const PressureRows& q, double* __restrict slope) {
  for (const bool high : {false, true}) {
    const std::uint8_t* far = ends.ahead(row.box(), axis, high, row.cell());
    if (far == nullptr) continue;
    const double* __restrict behind = high ? q.minus : q.plus;
    const double* __restrict ahead = high ? q.plus : q.minus;
    for (int i = 0; i < row.count(); ++i) {
      if (far[i] > depth) continue;
      const double bulk = q.rho[i] * (q.sound[i] * q.sound[i]);
      const double steep = (behind[i] - ahead[i]) - least_fall * bulk;
      const double s = smaller(larger(0.0, steep) / ((full_fall - least_fall) * bulk), 1.0);
      const double w = larger(0.0, far[i] - 0.5) / depth;
      slope[i] *= 1.0 - s * (1.0 - w);
    }
  }
}

}  // namespace sluice::ice
