#include "mpm/step/resting.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpm {

void keep_particles(ParticleStore& store, const ParticleKind& kind, int level) {
  const std::vector<std::size_t> advanced = kind.advanced_columns();
  for (int b = 0; b < store.box_count(level); ++b) {
    const ParticleSet& set = store.set(level, b);
    ParticleSet& next = store.next(level, b);
    for (int d = 0; d < 3; ++d) std::copy_n(set.coordinate(d), set.size(), next.coordinate(d));
    for (const std::size_t a : advanced) std::copy_n(set.column(a), set.size(), next.column(a));
  }
}

double keep_resting(const Level& level, std::span<const Body> bodies, const StepScope& step,
                    std::vector<KindRates>& rates) {
  double rate = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const SolidMaterial& material = *bodies[k].material;
    if (material.takes_part(step.time)) continue;
    const KindRates& own = bodies[k].rates;
    rates[k] = own;
    if (!own.any() || !material.takes_part(step.time + step.dt)) continue;
    for (int d = 0; d < 3; ++d)
      if (level.active[static_cast<std::size_t>(d)])
        rate = std::max(rate, own.wave + std::max(std::fabs(own.up[d]), std::fabs(own.down[d])) /
                                             level.spacing[d]);
  }
  return rate;
}

}  // namespace sluice::mpm
