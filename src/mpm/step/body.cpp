#include "mpm/step/body.hpp"

namespace sluice::mpm {

TransferGrid transfer_grid(const MpmScene& solids, const Level& level,
                           const std::array<double, 3>& half) {
  TransferGrid g;
  g.count = 0;
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<std::size_t>(d);
    g.axes[n] = axis_of(level, d);
    if (level.active[n]) g.active[static_cast<std::size_t>(g.count++)] = d;
  }
  g.half = half;
  g.corner_limit = solids.cpdi_limit;
  return g;
}

}  // namespace sluice::mpm
