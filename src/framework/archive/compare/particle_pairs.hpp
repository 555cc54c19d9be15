// Which particle of one archive is which of another: by number, or by place.
//
// Programs number particles in different ways, and a raw archive may hold no numbers. Particles are
// then paired at the first output that is compared: two that are each other's nearest. Where both
// archives have numbers, these pairs hold for all later outputs; otherwise every output is paired
// by place, which is right as long as the archives differ by less than half the distance between
// particles. Lengths in m.
#pragma once
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "framework/archive/particle_table.hpp"

namespace sluice {

struct ParticlePairs {
  std::vector<std::pair<std::size_t, std::size_t>> places;  // in the tables of both
  bool by_number = false;
  double farthest = 0;  // distance of the two of a pair, where they are paired by place
};

// Of one material, over outputs in order.
class ParticlePairing {
 public:
  ParticlePairs pair(const ParticleTable& a, const ParticleTable& b);

 private:
  std::optional<std::map<std::int64_t, std::int64_t>> partners_;  // numbers of a to those of b
};

// Places of points that are each other's nearest.
std::vector<std::pair<std::size_t, std::size_t>> mutual_nearest(const std::vector<Vec3>& a,
                                                                const std::vector<Vec3>& b);

}  // namespace sluice
