#include "framework/run/component/joined_particles.hpp"

#include <algorithm>

namespace sluice {

JoinedParticles::JoinedParticles(const ParticleMethod& first, const ParticleMethod& second)
    : first_(&first), second_(&second), kinds_(first.kinds()) {
  kinds_.insert(kinds_.end(), second.kinds().begin(), second.kinds().end());
}

const ParticleMethod& JoinedParticles::of(int& kind) const {
  const int count = static_cast<int>(first_->kinds().size());
  if (kind < count) return *first_;
  kind -= count;
  return *second_;
}

bool JoinedParticles::carries(const ParticleMethod& method, const std::string& name) {
  return std::any_of(method.kinds().begin(), method.kinds().end(), [&](const ParticleKind& k) {
    return std::any_of(k.attributes.begin(), k.attributes.end(),
                       [&](const ParticleAttribute& a) { return a.label.name() == name; });
  });
}

void JoinedParticles::start(int kind, const Level& level, const IndexBox& cells,
                            ParticleSet& particles) const {
  const ParticleMethod& own = of(kind);
  own.start(kind, level, cells, particles);
}

std::optional<std::int64_t> JoinedParticles::count_at_start(int kind, const Level& level,
                                                            const IndexBox& cells) const {
  const ParticleMethod& own = of(kind);
  return own.count_at_start(kind, level, cells);
}

void JoinedParticles::advance(int kind, const ParticleStep& step, ParticleSet& particles) const {
  const ParticleMethod& own = of(kind);
  own.advance(kind, step, particles);
}

bool JoinedParticles::asks_refinement(int kind, const ParticleSet& set, std::size_t n, int level,
                                      int coarse) const {
  const ParticleMethod& own = of(kind);
  return own.asks_refinement(kind, set, n, level, coarse);
}

bool JoinedParticles::in_stages(int kind) const {
  const ParticleMethod& own = of(kind);
  return own.in_stages(kind);
}

void JoinedParticles::follow_wrapped(int kind, const Level& level, ParticleSet& set) const {
  const ParticleMethod& own = of(kind);
  own.follow_wrapped(kind, level, set);
}

bool JoinedParticles::reflects(int kind, int level, Side side, IntVec3 cell) const {
  const ParticleMethod& own = of(kind);
  return own.reflects(kind, level, side, cell);
}

}  // namespace sluice
