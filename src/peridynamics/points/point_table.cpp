#include "peridynamics/points/point_table.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "framework/base/reduction.hpp"

namespace sluice::peridynamics {

// A point on its way to its place in the columns.
struct PointTable::Entry {
  std::array<int, 3> bins{};  // z, y, x
  OwnPoint point;
  int image = 0;   // of those that arrived; own points have the image 0
  int source = 0;  // number among own points, or behind them among those that arrived
  auto key() const { return std::tie(bins, point.id, image); }
};

namespace {

double spacing_of(double volume, const PeriScene& scene) {
  const double v = volume / scene.thickness;
  return scene.dimensions == 3 ? std::cbrt(v) : scene.dimensions == 2 ? std::sqrt(v) : v;
}

struct Extent {
  double spacing = 1e300, reach = 0;
  std::array<double, 3> low{1e300, 1e300, 1e300};
};

Extent extent_of(const std::vector<OwnPoint>& own, const PeriScene& scene, Communicator& ranks) {
  const BondRule rule{scene.influence, scene.partial_volume};
  Extent e;
  double widest = 0;
  for (const OwnPoint& p : own) {
    const double dx = spacing_of(p.volume, scene);
    e.spacing = std::min(e.spacing, dx);
    widest = std::max(widest, dx);
    for (int d = 0; d < 3; ++d)
      e.low[static_cast<std::size_t>(d)] = std::min(e.low[static_cast<std::size_t>(d)], p.place[d]);
  }
  Reduction all;
  const auto spacing = all.add_minimum(e.spacing);
  const auto wide = all.add_maximum(widest);
  std::array<Reduction::Minimum, 3> low;
  for (std::size_t d = 0; d < 3; ++d) low[d] = all.add_minimum(e.low[d]);
  ranks.reduce(all);
  e.spacing = all.minimum(spacing);
  for (std::size_t d = 0; d < 3; ++d) e.low[d] = all.minimum(low[d]);
  for (const PeriMaterial& m : scene.materials)
    e.reach = std::max(e.reach, rule.reach(m.horizon, all.maximum(wide)));
  return e;
}

}  // namespace

// Places of a lattice stand in the middle of bins.
int PointTable::bin_of(double x, int d) const {
  return static_cast<int>(std::floor((x - low[static_cast<std::size_t>(d)]) / bin + 0.5));
}

void PointTable::build(const std::vector<OwnPoint>& own, const Level& level, const PeriScene& scene,
                       Communicator& ranks) {
  const Extent extent = extent_of(own, scene, ranks);
  bin = extent.spacing;
  low = extent.low;
  largest_reach = extent.reach;
  const std::vector<Ghosts::Arrived> arrived =
      ghosts_.find(level, scene.mirrors, largest_reach, own, ranks);
  std::vector<Entry> all;
  all.reserve(own.size() + arrived.size());
  const auto add = [&](const OwnPoint& p, int image, std::size_t source) {
    all.push_back({{bin_of(p.place.z, 2), bin_of(p.place.y, 1), bin_of(p.place.x, 0)},
                   p,
                   image,
                   static_cast<int>(source)});
  };
  for (std::size_t n = 0; n < own.size(); ++n) add(own[n], 0, n);
  for (std::size_t n = 0; n < arrived.size(); ++n)
    add(arrived[n].point, arrived[n].image, own.size() + n);
  std::sort(all.begin(), all.end(),
            [](const Entry& a, const Entry& b) { return a.key() < b.key(); });
  own_count_ = own.size();
  put(all);
  for (std::size_t n = 0; n < all.size(); ++n)
    spacing[n + margin] = spacing_of(all[n].point.volume, scene);
}

void PointTable::put(const std::vector<Entry>& all) {
  const std::size_t count = all.size() + 2 * margin;
  for (Column& x : X) x.assign(count, 0.0);
  V.assign(count, 0.0);
  spacing.assign(count, 1.0);
  material.assign(count, -1);
  id.assign(count, -1);
  own_.assign(count, 0);
  std::vector<int> place(all.size());
  for (std::size_t n = 0; n < all.size(); ++n) {
    const std::size_t at = n + margin;
    const Entry& e = all[n];
    for (int d = 0; d < 3; ++d) X[static_cast<std::size_t>(d)][at] = e.point.place[d];
    V[at] = e.point.volume;
    material[at] = e.point.material;
    id[at] = e.point.id;
    own_[at] = static_cast<std::size_t>(e.source) < own_count_;
    place[static_cast<std::size_t>(e.source)] = static_cast<int>(at);
  }
  const auto own_end = place.begin() + static_cast<std::ptrdiff_t>(own_count_);
  entries_.assign(place.begin(), own_end);
  ghosts_.place(entries_, {own_end, place.end()});
}

}  // namespace sluice::peridynamics
