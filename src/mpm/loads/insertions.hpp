// Particles that jump: at a time, those of a colour are moved by a way and get a velocity. A file
// has rows t, colour, way (3), velocity (3), or rows t, material, colour, way, velocity.
#pragma once
#include <string>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice::mpm {

struct Insertion {
  double time = 0, colour = 0;  // s, without unit
  int material = -1;            // of the solids; -1: any
  Vec3 way{}, velocity{};       // m, m/s
};

// InputError with file, line and column; `materials`: how many solids there are.
std::vector<Insertion> read_insertions(const std::string& file, int materials);

// Those of a step from `time` to time + dt (exclusive).
std::vector<Insertion> insertions_in(const std::vector<Insertion>& all, double time, double dt);

}  // namespace sluice::mpm
