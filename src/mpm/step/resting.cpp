// Materials before their activation_time and after their deactivation_time: what they are at the
// end of a step is what they were.
#include <algorithm>
#include <cmath>

#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {

bool SolidStep::rests(int kind, double time) const {
  return !bodies_[static_cast<std::size_t>(kind)].material->takes_part(time);
}

void SolidStep::keep(int kind, ParticleStore& store) const {
  const std::vector<std::size_t> advanced =
      (*kinds_)[static_cast<std::size_t>(kind)].advanced_columns();
  for (int b = 0; b < store.box_count(level_.index); ++b) {
    const ParticleSet& set = store.set(level_.index, b);
    ParticleSet& next = store.next(level_.index, b);
    for (int d = 0; d < 3; ++d) std::copy_n(set.coordinate(d), set.size(), next.coordinate(d));
    for (const std::size_t a : advanced) std::copy_n(set.column(a), set.size(), next.column(a));
  }
}

// Bounds of what rests stay; c/h + |v|/h of what awakes counts for the next step, 1/s.
double SolidStep::keep_resting(const StepScope& step, std::vector<KindRates>& rates) const {
  double rate = 0;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const auto kind = static_cast<int>(k);
    if (!rests(kind, step.time)) continue;
    const KindRates& own = bodies_[k].rates;
    rates[k] = own;
    if (!own.any() || rests(kind, step.time + step.dt)) continue;
    for (int d = 0; d < 3; ++d)
      if (level_.active[static_cast<std::size_t>(d)])
        rate = std::max(rate, own.wave + std::max(std::fabs(own.up[d]), std::fabs(own.down[d])) /
                                             level_.spacing[d]);
  }
  return rate;
}

}  // namespace sluice::mpm
