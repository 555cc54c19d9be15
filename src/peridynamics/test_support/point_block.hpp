// Blocks of points for tests of single parts: a lattice in a box, perturbed or not, without a deck.
#pragma once
#include <functional>
#include <random>
#include <vector>

#include "framework/base/communicator.hpp"
#include "peridynamics/step/bonded_points.hpp"

namespace sluice::peridynamics {

struct BlockOptions {
  IntVec3 points{13, 13, 13};
  double spacing = 1;
  double perturbed = 0;  // by so many spacings at most
  IntVec3 boxes{1, 1, 1};
};

inline Level level_of(const PeriScene& scene, const BlockOptions& o) {
  Level level;
  level.spacing = Vec3::all(o.spacing);
  level.domain = {{0, 0, 0}, o.points};
  for (int d = scene.dimensions; d < 3; ++d) level.active[static_cast<std::size_t>(d)] = false;
  int id = 0;
  for (const IndexBox& cells : split(level.domain, o.boxes))
    level.boxes.push_back({cells, 0, id++});
  return level;
}

// Points in the middle of cells, x fastest; ids in this order.
inline std::vector<OwnPoint> places_of(const PeriScene& scene, const BlockOptions& o) {
  std::vector<OwnPoint> all;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-o.perturbed * o.spacing, o.perturbed * o.spacing);
  for_each_cell({{0, 0, 0}, o.points}, [&](IntVec3 c) {
    OwnPoint p;
    for (int d = 0; d < scene.dimensions; ++d)
      p.place[d] = (c[d] + 0.5) * o.spacing + (o.perturbed > 0 ? shift(random) : 0);
    p.volume = o.spacing * o.spacing * o.spacing;
    p.id = static_cast<std::int64_t>(all.size());
    all.push_back(p);
  });
  return all;
}

// One material; mu, k as given, density 1.
inline PeriScene scene_of(Law law, int dimensions, double horizon, double bulk, double shear) {
  PeriScene s;
  s.dimensions = dimensions;
  s.plane = dimensions == 3 ? Plane::space : dimensions == 2 ? Plane::strain : Plane::line;
  PeriMaterial& m = s.materials.emplace_back();
  m.law = law;
  m.density = 1;
  m.bulk = bulk;
  m.shear = shear;
  m.horizon = horizon;
  return s;
}

class PointBlock {
 public:
  explicit PointBlock(const PeriScene& scene, const BlockOptions& options = {})
      : scene_(scene), points(scene_, PointColumns{}) {
    points.make(places_of(scene_, options), level_of(scene_, options), nullptr, world());
  }

  // Forces of displacements u(X).
  void displace(const std::function<Vec3(Vec3)>& u) {
    Columns3& to = points.present().u;
    for_each([&](std::size_t i, Vec3 X) {
      const Vec3 own = u(X);
      for (std::size_t d = 0; d < 3; ++d) to[d][i] = own[static_cast<int>(d)];
    });
    points.fill_displacements(to);
    points.sum_dilatations(to, nullptr);
    points.fill_dilatations();
    points.sum_forces(to, nullptr);
  }
  // act(entry, X) of each point.
  void for_each(const std::function<void(std::size_t, Vec3)>& act) const {
    const PointTable& p = points.points();
    for (int i = 0; i < p.size(); ++i)
      if (p.is_own(i)) {
        const std::size_t n = static_cast<std::size_t>(i);
        act(n, {p.X[0][n], p.X[1][n], p.X[2][n]});
      }
  }
  Vec3 force(std::size_t i) const {
    return {points.force()[0][i], points.force()[1][i], points.force()[2][i]};
  }
  std::size_t entry(std::int64_t id) const { return static_cast<std::size_t>(points.entry_of(id)); }

 private:
  PeriScene scene_;

 public:
  BondedPoints points;
};

}  // namespace sluice::peridynamics
