#include "peridynamics/start/family_bound.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "mpm/start/point_list.hpp"
#include "mpm/start/seed.hpp"
#include "peridynamics/points/bond_rule.hpp"

namespace sluice::peridynamics {
namespace {

struct Source {
  Vec3 parts{};  // of a lattice: widths between points, 0 along no direction
  bool is_lattice = true;
  double reach = 0;
  int own = 0, any = 0;  // neighbours among its own points, about any place
  std::int64_t points = 0;
};

Vec3 parts_of(const Level& level, const mpm::SeedObject& object) {
  Vec3 parts{};
  for (int d = 0; d < 3; ++d)
    if (level.active[d]) parts[d] = level.spacing[d] / object.per_cell[d];
  return parts;
}

// Points of a lattice within `reach` of one of them, itself left out.
int count_around(Vec3 parts, double reach) {
  IntVec3 most{};
  for (int d = 0; d < 3; ++d)
    if (parts[d] > 0) most[d] = static_cast<int>(reach / parts[d]) + 1;
  int count = 0;
  for (int k = -most.z; k <= most.z; ++k)
    for (int j = -most.y; j <= most.y; ++j)
      for (int i = -most.x; i <= most.x; ++i) {
        const Vec3 at = to_real({i, j, k}) * parts;
        if (dot(at, at) <= reach * reach * (1 + 1e-9)) ++count;
      }
  return count - 1;
}

// The most points of a list within `reach` of one of them.
int count_in_list(const std::vector<Vec3>& places, const std::array<bool, 3>& active,
                  double reach) {
  using Cell = std::tuple<int, int, int>;
  std::map<Cell, std::vector<Vec3>> cells;
  const auto cell_of = [&](Vec3 p) {
    return Cell(static_cast<int>(std::floor(p.x / reach)),
                static_cast<int>(std::floor(p.y / reach)),
                static_cast<int>(std::floor(p.z / reach)));
  };
  const auto flat = [&](Vec3 p) {
    for (int d = 0; d < 3; ++d)
      if (!active[d]) p[d] = 0;
    return p;
  };
  for (const Vec3 p : places) cells[cell_of(flat(p))].push_back(flat(p));
  int most = 0;
  for (const auto& [cell, points] : cells) {
    std::vector<Vec3> near;
    const auto [i, j, k] = cell;
    for (int z = k - 1; z <= k + 1; ++z)
      for (int y = j - 1; y <= j + 1; ++y)
        for (int x = i - 1; x <= i + 1; ++x)
          if (const auto at = cells.find({x, y, z}); at != cells.end())
            near.insert(near.end(), at->second.begin(), at->second.end());
    for (const Vec3 p : points) {
      const auto count = std::count_if(near.begin(), near.end(), [&](Vec3 q) {
        return dot(q - p, q - p) <= reach * reach * (1 + 1e-9);
      });
      most = std::max(most, static_cast<int>(count));
    }
  }
  return most;
}

Source source_of(const PeriScene& scene, const Level& level, const PeriMaterial& material,
                 const mpm::SeedObject& object, double widest) {
  const BondRule rule{scene.influence, scene.partial_volume};
  Source s;
  s.reach = rule.reach(material.horizon, widest);
  if (const auto list = mpm::point_list(object)) {
    s.is_lattice = false;
    s.points = static_cast<std::int64_t>(list->place.size());
    s.own = count_in_list(list->place, level.active, s.reach) - 1;
    s.any = count_in_list(list->place, level.active, 2 * s.reach);
    return s;
  }
  s.parts = parts_of(level, object);
  s.own = count_around(s.parts, s.reach);
  s.any = count_around(s.parts, s.reach + 0.5 * std::sqrt(dot(s.parts, s.parts))) + 1;
  s.points = mpm::count_places(*object.piece, object, level, mpm::window_of(object, level));
  return s;
}

}  // namespace

double spacing_of(const PeriScene& scene, const Level& level, const mpm::SeedObject& object) {
  const auto of_volume = [&](double volume) {
    return std::pow(volume / scene.thickness, 1.0 / scene.dimensions);
  };
  if (const auto list = mpm::point_list(object); list && !list->volume.empty())
    return of_volume(*std::max_element(list->volume.begin(), list->volume.end()));
  const Vec3 n = to_real(object.per_cell);
  return of_volume(level.cell_volume() / (n.x * n.y * n.z));
}

FamilyBound bound_families(const PeriScene& scene, const Level& level) {
  double widest = 0;
  for (const mpm::SolidMaterial& material : scene.seeds.materials)
    for (const mpm::SeedObject& object : material.objects)
      widest = std::max(widest, spacing_of(scene, level, object));
  FamilyBound bound;
  double weighted = 0;
  const auto add = [&](const std::vector<Source>& sources) {
    int all = 0;
    for (const Source& s : sources) all += s.any;
    for (const Source& s : sources) {
      bound.largest = std::max(bound.largest, all - s.any + s.own);
      bound.points += s.points;
      weighted += static_cast<double>(s.points) * s.own;
    }
  };
  std::vector<Source> together;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    if (!scene.all_bonded) together.clear();
    for (const mpm::SeedObject& object : scene.seeds.materials[m].objects)
      together.push_back(source_of(scene, level, scene.materials[m], object, widest));
    if (!scene.all_bonded) add(together);
  }
  if (scene.all_bonded) add(together);
  if (bound.points > 0) bound.typical = weighted / static_cast<double>(bound.points);
  // Images beyond sides may add as many again.
  if (!scene.mirrors.empty()) bound.largest *= 2;
  return bound;
}

}  // namespace sluice::peridynamics
