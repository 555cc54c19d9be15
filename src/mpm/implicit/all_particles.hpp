// The particles of all ranks in one order, by id, on each of them: what an implicit step computes
// from them has no bit that depends on boxes or ranks.
#pragma once
#include <cstdint>
#include <vector>

#include "framework/run/levels/particle_cloud.hpp"

namespace sluice::mpm {

class AllParticles {
 public:
  // One kind: as the particles are, and what a step makes of what it advances.
  struct Kind {
    ParticleSet now, next;
    // Of those that live on this rank: row in the sets, box, number there.
    struct Home {
      std::size_t row = 0;
      int box = 0;
      std::size_t number = 0;
    };
    std::vector<Home> homes;
  };

  // Level 0. Collective.
  void gather(const ParticleCloud& cloud, const std::vector<ParticleKind>& kinds,
              Communicator& ranks);
  // What the step made goes beside the particles of this rank.
  void give_back(ParticleCloud& cloud, const std::vector<ParticleKind>& kinds) const;

  std::size_t count() const { return kinds_.size(); }
  Kind& kind(std::size_t k) { return kinds_[k]; }
  const Kind& kind(std::size_t k) const { return kinds_[k]; }

 private:
  std::vector<Kind> kinds_;
};

}  // namespace sluice::mpm
