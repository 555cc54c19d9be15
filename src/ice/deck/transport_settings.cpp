#include "ice/deck/transport_settings.hpp"

#include <algorithm>
#include <cmath>

#include "framework/grid/level.hpp"

namespace sluice::ice {

std::vector<TransportModels::Sponge> sponge_cells(const ViscosityModels& models,
                                                  const Level& level) {
  // coefficient: index of a cell beyond any level, where bounds may be infinite; unit: 1
  constexpr double far = 1 << 28;
  std::vector<TransportModels::Sponge> all;
  for (const SpongeLayer& layer : models.sponges)
    for (const Bounds& box : layer.boxes) {
      TransportModels::Sponge sponge{{}, layer.viscosity};
      for (int d = 0; d < 3; ++d) {
        const auto index = [&](double x) {
          return std::clamp((x - level.anchor[d]) / level.spacing[d] - 0.5, -far, far);
        };
        sponge.cells.lower[d] = static_cast<int>(std::ceil(index(box.lower[d])));
        sponge.cells.upper[d] = static_cast<int>(std::floor(index(box.upper[d]))) + 1;
      }
      all.push_back(sponge);
    }
  return all;
}

}  // namespace sluice::ice
