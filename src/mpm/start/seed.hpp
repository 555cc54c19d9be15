// The particles of a deck's geometry objects, the same whatever boxes ask for them.
//
// A cell with the low corner x_c is divided into n = res parts a direction; a particle stands in
// the middle of each part, x = x_c + dx ((i + 1/2)/n), where the piece contains x. Its edges are
// R0 = A diag(1/n) in cells (A: the affine map, which also takes x to A x + b), its volume is
// V = det(R0) dx dy dz, of the whole part; axisymmetric: V = x det2(R0) dx dy, of one radian. Mass:
// rho0 V, times volumeFraction.
//
// - numLevelsParticleFilling N: a part that holds no particle is divided in two along each
//   direction of more than one cell, |N| - 1 times. N < 0: a particle's points at a quarter of its
//   edges from the middle, on the diagonals, must be inside too.
// - cut_cells: every part that the piece reaches holds a particle, with the volume and the centroid
//   of what is inside; shares below 1e-6 are left out. Its edges are shortened alike in each
//   direction of more than one cell, so that V = det(R0) dx dy dz.
// - Point files and smooth cylinders give their particles one by one; edges in files are lengths.
//
// Ids: id = base + number. A number counts the parts of the smallest window of cells that holds the
// object (x fastest), or the rows of its list. Bases are given out over materials, objects, levels
// and sizes in that order, so that no id depends on boxes or ranks; all are below 2^53.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "framework/grid/level.hpp"
#include "mpm/deck/mpm_scene.hpp"
#include "mpm/start/fill_object.hpp"
#include "mpm/start/point_list.hpp"
#include "mpm/start/seeded_particles.hpp"

namespace sluice::mpm {

class Seeder {
 public:
  // Keeps a reference to the scene. InputError when there would be more than 2^53 ids.
  Seeder(const MpmScene& scene, const Grid& grid);

  // Adds the particles of a material (local number) that stand in the cells of a window of a level
  // and in no box of `covered`, which are boxes of the same level with finer ones above.
  void seed(int material, const Level& level, const IndexBox& window,
            std::span<const IndexBox> covered, SeededParticles& particles) const;

  // One object alone.
  void seed_object(int material, int object, const Level& level, const IndexBox& window,
                   std::span<const IndexBox> covered, SeededParticles& particles) const;

  // How many ids there may be.
  std::int64_t max_ids() const { return next_; }

 private:
  // What is known of an object before any particle is made.
  struct Prepared {
    std::optional<PointList> list;
    std::vector<IndexBox> windows;                 // by level: cells that its places may lie in
    std::vector<std::vector<std::int64_t>> bases;  // of ids, by level and size
  };
  Prepared prepare(const SeedObject& object, const Grid& grid);
  std::int64_t take_ids(std::int64_t count, const SeedObject& object);
  ObjectOnLevel object_of(int material, const SeedObject& object, const Level& level) const;

  const MpmScene& scene_;
  std::vector<std::vector<Prepared>> prepared_;  // by material and object
  std::vector<OptionalColumns> optional_;        // by material
  std::int64_t next_ = 0;
};

// How many particles of a filled object (no list) stand in the cells of a window.
std::int64_t count_places(const GeometryPiece& piece, const SeedObject& object, const Level& level,
                          const IndexBox& window);
// Cells of a level in which the object's places may lie, before its map.
IndexBox window_of(const SeedObject& object, const Level& level);

}  // namespace sluice::mpm
