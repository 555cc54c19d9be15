// Corners of the particles of an object that fills a lattice, and which of their faces are outer.
//
// A corner's place follows from its number on the lattice alone, so that particles that share it
// have the same bits, whatever box asks. Corners between parts with and without a particle are
// moved onto the surface of the piece (snap_corner.hpp), then all are rounded to Axis::unit.
#pragma once
#include <map>

#include "framework/geometry/sampling.hpp"
#include "framework/grid/level.hpp"
#include "mpm/deck/mpm_scene.hpp"
#include "mpm/shape/axis.hpp"
#include "mpm/start/seeded_particles.hpp"

namespace sluice::mpm {

// The measure of corners (length, area, volume) and their middle, in the directions of a level: m,
// m^2 or m^3; m.
struct CornerSpan {
  double measure = 0;
  Vec3 middle{};
};
// `place` of the particle, m.
CornerSpan span_of(const Level& level, const ParticleCorners& corners, Vec3 place);

// Place and volume of a particle become those of its corners; `row` has its edges.
void span_corners(const Level& level, SeededParticle& row);

class CornerLattice {
 public:
  CornerLattice(const SeedObject& object, const Level& level);

  // How far from the middle of a part answers depend on the piece, in parts.
  static constexpr double reach = 2;

  // Of the particle in a part of a cell. `piece`: has the same points around as the object's; null:
  // everything around is inside.
  ParticleCorners corners_of(const GeometryPiece* piece, IntVec3 cell, IntVec3 part);
  // Of a particle that stands alone, with these edges in cells: every face is outer.
  ParticleCorners alone(Vec3 place, const Map& edges) const;

 private:
  bool filled(const GeometryPiece* piece, IntVec3 number) const;
  bool seeded(const GeometryPiece* piece, IntVec3 number) const;
  Vec3 middle_of(IntVec3 number) const;
  Vec3 corner(const GeometryPiece* piece, IntVec3 number, IntVec3 part);
  Vec3 rounded(Vec3 x) const;

  const SeedObject& object_;
  const Level& level_;
  CellLattice lattice_;
  std::array<Axis, 3> axes_;
  std::array<int, 3> active_{};
  int count_ = 0;
  Vec3 step_{};
  std::map<std::array<int, 3>, Vec3> moved_;  // corners at the surface, by number
};

}  // namespace sluice::mpm
