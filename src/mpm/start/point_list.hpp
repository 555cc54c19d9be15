// Particles that a piece gives one by one: the rows of a point file, the rings of a smoothcyl. SI
// units: m, m^3, K, m/s, N; colours, directions and numbers of load curves have none.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "mpm/deck/mpm_scene.hpp"
#include "mpm/start/seeded_particles.hpp"

namespace sluice::mpm {

struct PointList {
  std::vector<Vec3> place;
  std::vector<double> volume;                                   // empty: as the edges say
  std::vector<std::array<Vec3, 3>> edges;                       // m; empty: res of the object
  std::vector<double> temperature, colour;                      // empty: the object's
  std::vector<Vec3> velocity;                                   // empty: the object's
  std::vector<Vec3> external_force, fibre, normal, load_curve;  // empty: none
};

// Nothing where the piece is filled with particles at places of its cells.
std::optional<PointList> point_list(const SeedObject& object);

}  // namespace sluice::mpm
