// Particles at the start.
#include "mpm/start/seed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/deck/faults.hpp"
#include "mpm/start/fill_object.hpp"
#include "mpm/start/lattice_visit.hpp"

namespace sluice::mpm {
namespace {

constexpr std::int64_t most_ids_of_all = std::int64_t{1} << 53;

int sizes_of(const SeedObject& object) {
  return std::max(1, std::abs(object.filling_levels));
}

}  // namespace

IndexBox window_of(const SeedObject& object, const Level& level) {
  const Bounds b = object.piece->bounds();
  IndexBox window;
  for (int d = 0; d < 3; ++d) {
    // Cells beyond the domain count where a map may bring their places back into it.
    const double low = std::floor((b.lower[d] - level.anchor[d]) / level.spacing[d]);
    const double high = std::floor((b.upper[d] - level.anchor[d]) / level.spacing[d]) + 1;
    const double first = level.domain.lower[d], last = level.domain.upper[d];
    const bool clipped = !object.mapped || !std::isfinite(low) || !std::isfinite(high) ||
                         std::abs(low) > 1e8 || std::abs(high) > 1e8;
    window.lower[d] = static_cast<int>(clipped ? std::clamp(low, first, last) : low);
    window.upper[d] = static_cast<int>(clipped ? std::clamp(high, first, last) : high);
  }
  return window;
}

Seeder::Seeder(const MpmScene& scene, const Grid& grid) : scene_(scene) {
  for (const SolidMaterial& material : scene.materials) {
    std::vector<Prepared> objects;
    OptionalColumns wanted;
    wanted.corners = scene.carries_corners();
    for (const SeedObject& object : material.objects) {
      objects.push_back(prepare(object, grid));
      const std::optional<PointList>& list = objects.back().list;
      if (!list) continue;
      wanted.external_force = wanted.external_force || !list->external_force.empty();
      wanted.fibre = wanted.fibre || !list->fibre.empty();
      wanted.normal = wanted.normal || !list->normal.empty();
      wanted.load_curve = wanted.load_curve || !list->load_curve.empty();
    }
    prepared_.push_back(std::move(objects));
    optional_.push_back(wanted);
  }
}

Seeder::Prepared Seeder::prepare(const SeedObject& object, const Grid& grid) {
  Prepared p;
  p.list = point_list(object);
  for (const Level& level : grid.levels) {
    p.windows.push_back(window_of(object, level));
    std::vector<std::int64_t> bases;
    if (p.list) {
      // The same row has the same id on every level.
      bases.push_back(level.index == 0
                          ? take_ids(static_cast<std::int64_t>(p.list->place.size()), object)
                          : p.bases.front().front());
    } else {
      for (int size = 0; size < sizes_of(object); ++size) {
        const IntVec3 res = res_of_size(object.per_cell, size, wide_directions(level));
        // In floating point first: a product may exceed what 64 bits hold.
        const double parts = static_cast<double>(res.x) * res.y * res.z *
                             static_cast<double>(p.windows.back().volume());
        bases.push_back(take_ids(parts < static_cast<double>(most_ids_of_all)
                                     ? p.windows.back().volume() * res.x * res.y * res.z
                                     : most_ids_of_all,
                                 object));
      }
    }
    p.bases.push_back(std::move(bases));
  }
  return p;
}

std::int64_t Seeder::take_ids(std::int64_t count, const SeedObject& object) {
  if (count > most_ids_of_all - next_)
    throw DeckError(object.where,
                    fmt::format("with this <geom_object> there are more than 2^53 positions for "
                                "particles, {} before it: the particle numbers are exhausted",
                                next_),
                    "write fewer particles per cell (res), or make the piece smaller");
  const std::int64_t base = next_;
  next_ += count;
  return base;
}

void Seeder::seed(int material, const Level& level, const IndexBox& window,
                  std::span<const IndexBox> covered, SeededParticles& particles) const {
  const auto count = static_cast<int>(prepared_[material].size());
  for (int object = 0; object < count; ++object)
    seed_object(material, object, level, window, covered, particles);
}

namespace {

// Cells whose places a map may take into the window: the window taken back, with a cell's margin.
IndexBox taken_back(const SeedObject& object, const Level& level, const IndexBox& window) {
  const Map back_map = inverse(object.map);
  const Bounds space = {level.anchor + to_real(window.lower) * level.spacing,
                        level.anchor + to_real(window.upper) * level.spacing};
  Bounds back = Bounds::nothing();
  for (int n = 0; n < 8; ++n) {
    const Vec3 p = applied(back_map, space.corner(n) - object.shift);
    back = bounding(back, {p, p});
  }
  IndexBox cells;
  for (int d = 0; d < 3; ++d) {
    const auto cell = [&](double x) {
      return static_cast<int>(
          std::clamp(std::floor((x - level.anchor[d]) / level.spacing[d]), -1e9, 1e9));
    };
    cells.lower[d] = cell(back.lower[d]) - 1;
    cells.upper[d] = cell(back.upper[d]) + 2;
  }
  return cells;
}

}  // namespace

ObjectOnLevel Seeder::object_of(int material, const SeedObject& object, const Level& level) const {
  return {object,
          level,
          scene_.materials[material].constants.density * object.volume_fraction.value_or(1.0),
          scene_.axisymmetric,
          scene_.basis == Basis::cpti,
          optional_[material]};
}

void Seeder::seed_object(int material, int object, const Level& level, const IndexBox& window,
                         std::span<const IndexBox> covered, SeededParticles& particles) const {
  const SeedObject& o = scene_.materials[material].objects[object];
  const Prepared& p = prepared_[material][object];
  const IndexBox target = intersection(window, level.domain);
  if (target.empty()) return;
  if (p.list)
    return seed_list(object_of(material, o, level), *p.list, p.bases.front().front(), target,
                     covered, particles);
  const IndexBox own = p.windows[level.index];
  const IndexBox cells = intersection(own, o.mapped ? taken_back(o, level, target) : target);
  if (cells.empty()) return;
  const std::size_t l = level.index;
  fill_object(object_of(material, o, level), {own, p.bases[l]}, cells, target, covered, particles);
}

std::int64_t count_places(const GeometryPiece& piece, const SeedObject& object, const Level& level,
                          const IndexBox& window) {
  const CellLattice lattice{level.anchor, level.spacing};
  const IntVec3 n = object.per_cell;
  std::int64_t count = 0;
  const auto settled = [&](IntVec3 lower, IntVec3 upper) {
    count += IndexBox{lower, upper}.volume() * n.x * n.y * n.z;
  };
  const auto leaf = [&](const GeometryPiece& part, IntVec3 cell) {
    count += count_inside(part, lattice, cell, n);
  };
  LatticeVisit visit(lattice, n, {}, settled, leaf);
  visit.visit(piece, window.lower, window.upper);
  return count;
}

}  // namespace sluice::mpm
