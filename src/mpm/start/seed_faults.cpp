// Faults of bodies that show only where their particles are looked for.
#include "mpm/start/seed_faults.hpp"

#include <fmt/format.h>

#include "framework/deck/faults.hpp"
#include "framework/geometry/boolean.hpp"
#include "framework/geometry/sampling.hpp"
#include "mpm/start/load_faults.hpp"
#include "mpm/start/near_bodies.hpp"
#include "mpm/start/point_list.hpp"
#include "mpm/start/seed.hpp"

namespace sluice::mpm {
namespace {

Bounds bounds_of(const Level& level) {
  return {level.anchor + to_real(level.domain.lower) * level.spacing,
          level.anchor + to_real(level.domain.upper) * level.spacing};
}

struct Count {
  std::int64_t inside = 0, outside = 0;
};

Count count_rows(const PointList& list, const SeedObject& o, const Level& level) {
  Count count;
  const CellLattice lattice{level.anchor, level.spacing};
  for (const Vec3 x : list.place) {
    const Vec3 to = applied(o.map, x) + o.shift;
    ++(level.domain.contains(lattice.cell_of(to)) ? count.inside : count.outside);
  }
  return count;
}

Count count_of(const Seeder& seeder, int material, int number, const SeedObject& o,
               const Grid& grid) {
  const Level& coarsest = grid.levels.front();
  if (const auto list = point_list(o)) return count_rows(*list, o, coarsest);
  Count count;
  // Cut parts, small sizes and maps are rare: there the particles themselves are counted.
  if (o.mapped || o.cut_cells || o.filling_levels < 0 || o.filling_levels > 1) {
    SeededParticles particles;
    seeder.seed_object(material, number, coarsest, coarsest.domain, {}, particles);
    count.inside = static_cast<std::int64_t>(particles.count());
    if (o.mapped && o.filling_levels == 1 && !o.cut_cells)
      count.outside = count_places(*o.piece, o, coarsest, window_of(o, coarsest)) - count.inside;
    return count;
  }
  for (const Level& level : grid.levels) {
    count.inside += count_places(*o.piece, o, level, window_of(o, level));
    if (count.inside > 0) break;
  }
  return count;
}

void tell_of_empty(const SeedObject& o, const Level& level, std::vector<Fault>& faults) {
  if (!o.mapped && !o.piece->bounds().meets(bounds_of(level)))
    add_warning(faults, o.where, "<geom_object> is outside of the domain: it has no particle",
                "move it, or remove it");
  else
    add_warning(faults, o.where, "<geom_object> has no particle: no particle position is inside",
                "write more particles per cell (res), or finer cells");
}

// Places of one object that an earlier one of the material fills too.
std::int64_t shared_places(const SeedObject& first, const SeedObject& second, const Level& level) {
  if (first.mapped || second.mapped) return 0;
  if (first.piece->points() != nullptr || second.piece->points() != nullptr) return 0;
  if (!first.piece->bounds().meets(second.piece->bounds())) return 0;
  const IntersectionPiece both({first.piece, second.piece});
  return count_places(both, second, level,
                      intersection(window_of(first, level), window_of(second, level)));
}

// One warning for each object; of many only the first is shown, with how many there are. Beyond
// what is shown, one earlier object that an object shares places with is enough: there may be many
// pairs.
void check_overlaps(const SolidMaterial& material, const Level& level, std::vector<Fault>& faults) {
  constexpr std::size_t most_shown = 3;
  std::vector<Fault> found;
  for (std::size_t b = 1; b < material.objects.size(); ++b) {
    const SeedObject& second = material.objects[b];
    std::int64_t count = 0;
    const SeedObject* with = nullptr;
    for (std::size_t a = 0; a < b && (with == nullptr || found.size() <= most_shown); ++a) {
      const std::int64_t shared = shared_places(material.objects[a], second, level);
      if (shared > 0 && with == nullptr) with = &material.objects[a];
      count += shared;
    }
    if (with == nullptr) continue;
    add_warning(found, second.where,
                fmt::format("{} particles of this <geom_object> are inside the one at {}{}, of the "
                            "same material: the space is filled twice",
                            count, to_string(with->where), b > 1 ? " or others" : ""),
                "cut one out of the other with <difference>");
  }
  if (found.size() > most_shown) {
    found.front().message =
        fmt::format("{}; {} objects of this material fill space that an earlier object also fills",
                    found.front().message, found.size());
    found.resize(1);
  }
  faults.insert(faults.end(), found.begin(), found.end());
}

}  // namespace

void check_seeds(const MpmScene& scene, const Grid& grid, std::vector<Fault>& faults) {
  const Seeder seeder(scene, grid);
  const Level& coarsest = grid.levels.front();
  std::int64_t all = 0;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const SolidMaterial& material = scene.materials[m];
    for (std::size_t n = 0; n < material.objects.size(); ++n) {
      const SeedObject& o = material.objects[n];
      if (o.piece == nullptr) return;  // a fault already
      const Count count = count_of(seeder, static_cast<int>(m), static_cast<int>(n), o, grid);
      all += count.inside;
      if (count.inside == 0)
        tell_of_empty(o, coarsest, faults);
      else if (count.outside > 0)
        add_warning(faults, o.where,
                    fmt::format("{} of {} particles of this <geom_object> are outside of the "
                                "domain; they are omitted",
                                count.outside, count.inside + count.outside));
    }
    check_overlaps(material, coarsest, faults);
    check_near_bodies(material, grid.levels.back(), faults);
  }
  if (all == 0 && !scene.materials.empty())
    add_error(faults, scene.materials.front().where,
              "no <geom_object> has a particle: there is nothing to run",
              "see the warnings of the objects");
  else
    check_loads(scene, grid, seeder, faults);
}

}  // namespace sluice::mpm
