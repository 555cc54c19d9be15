// Numbers drawn for a particle: a function of its id and of a seed, so that they are the same on
// any boxes, ranks and threads, and after a restart.
#pragma once
#include <cmath>
#include <cstdint>

namespace sluice::mpm {

// Evenly in (0, 1), neither end included. `draw`: the how-manieth number of this particle.
inline double particle_random(std::int64_t id, std::uint64_t seed, std::uint64_t draw) {
  // The mixing of splitmix64 (Steele, Lea, Flood 2014), once for each of the three.
  const auto mix = [](std::uint64_t z) {
    z += 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  };
  const std::uint64_t bits = mix(mix(mix(static_cast<std::uint64_t>(id)) ^ seed) ^ draw);
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

// Of mean 0 and deviation 1, by Box and Muller.
inline double particle_gauss(std::int64_t id, std::uint64_t seed, std::uint64_t draw) {
  const double u = particle_random(id, seed, 2 * draw), v = particle_random(id, seed, 2 * draw + 1);
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * 3.14159265358979323846 * v);
}

}  // namespace sluice::mpm
