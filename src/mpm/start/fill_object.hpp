// The particles of one object in a window of one level.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "framework/grid/level.hpp"
#include "mpm/deck/mpm_scene.hpp"
#include "mpm/start/point_list.hpp"
#include "mpm/start/seeded_particles.hpp"

namespace sluice::mpm {

// An object with what its particles take from its surroundings.
struct ObjectOnLevel {
  const SeedObject& object;
  const Level& level;
  double density;     // rho_0, times volumeFraction; kg/m^3
  bool axisymmetric;  // x is a radius: volumes of one radian
  bool tetrahedra;    // edges in files span tetrahedra
  OptionalColumns columns;
};

// How ids of a filled object follow from places: see seed.hpp.
struct PlaceNumbers {
  IndexBox window;                         // cells whose parts are numbered
  const std::vector<std::int64_t>& bases;  // by size of the particles, the largest first
};

// Directions of more than one cell: those in which particles are halved or cut.
std::array<bool, 3> wide_directions(const Level& level);
// Particles per cell and direction, of the size-th halving.
IntVec3 res_of_size(IntVec3 res, int size, const std::array<bool, 3>& wide);

// Places of the lattice in the parts of `cells`, as far as they then stand in `target` and in no
// box of `covered`. Without a map `cells` must lie in `target`.
void fill_object(const ObjectOnLevel& object, const PlaceNumbers& numbers, const IndexBox& cells,
                 const IndexBox& target, std::span<const IndexBox> covered,
                 SeededParticles& particles);

// Rows of a list that stand in `target` and in no box of `covered`; row n has the id base + n.
void seed_list(const ObjectOnLevel& object, const PointList& list, std::int64_t base,
               const IndexBox& target, std::span<const IndexBox> covered,
               SeededParticles& particles);

bool is_covered(std::span<const IndexBox> covered, IntVec3 cell);

}  // namespace sluice::mpm
