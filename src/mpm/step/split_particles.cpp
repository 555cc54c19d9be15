#include "mpm/step/split_particles.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"

namespace sluice::mpm {
namespace {

using Kind = SplitCriterion::Kind;

// Numbers of the parts of particle n: n, n + 2^50, n + 2 2^50, ... of most eight.
constexpr std::int64_t next_part = std::int64_t{1} << 50;

// The edges of a particle in space, F R0, along the directions that are active.
struct Edges {
  std::array<Vec3, 3> edge{};
  std::array<int, 3> direction{};
  int count = 0;

  double length(int k) const {
    const Vec3 e = edge[static_cast<std::size_t>(k)];
    return std::sqrt(dot(e, e));
  }
  int longest() const {
    int k = 0;
    for (int other = 1; other < count; ++other)
      if (length(other) > length(k)) k = other;
    return k;
  }
  double stretch_ratio() const {
    double shortest = length(0);
    for (int k = 1; k < count; ++k) shortest = std::min(shortest, length(k));
    return length(longest()) / shortest;
  }
};

Edges edges_of(const ParticleSet& set, const Columns& c, std::size_t p, const Level& level) {
  const auto F = read_columns<9>(set, c.F), R0 = read_columns<9>(set, c.size);
  Edges edges;
  for (int k = 0; k < 3; ++k) {
    if (!level.active[static_cast<std::size_t>(k)]) continue;
    const auto n = static_cast<std::size_t>(edges.count);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        edges.edge[n][i] += F[static_cast<std::size_t>(3 * i + j)][p] * level.spacing[j] *
                            R0[static_cast<std::size_t>(3 * j + k)][p];
    edges.direction[n] = k;
    ++edges.count;
  }
  return edges;
}

double stress_norm(const ParticleSet& set, const Columns& c, std::size_t p) {
  const auto s = read_columns<6>(set, c.stress);  // xx, xy, xz, yy, yz, zz
  double sum = 0;
  for (std::size_t e = 0; e < 6; ++e)
    sum += (e == 0 || e == 3 || e == 5 ? 1 : 2) * s[e][p] * s[e][p];
  return std::sqrt(sum);
}

std::vector<SplitCriterion> criteria_of(const MpmScene& solids, int kind) {
  std::vector<SplitCriterion> own = solids.splits;
  std::erase_if(own,
                [&](const SplitCriterion& s) { return s.material >= 0 && s.material != kind; });
  return own;
}

// The criterion that a particle meets, the first of the deck; null: none.
const SplitCriterion* met(const std::vector<SplitCriterion>& criteria, const ParticleSet& set,
                          const Columns& c, std::size_t p, const Level& level) {
  for (const SplitCriterion& s : criteria) {
    if (s.kind == Kind::stress_norm) {
      if (stress_norm(set, c, p) > s.value) return &s;
    } else {
      const double ratio = edges_of(set, c, p, level).stretch_ratio();
      if (ratio > s.value || ratio < 1 / s.value) return &s;
    }
  }
  return nullptr;
}

// Where the parts are, and the shares of the edges that they have.
struct Parts {
  std::vector<Vec3> offsets;
  std::array<double, 3> share{1, 1, 1};  // by direction of the level
};

Parts parts_of(Kind kind, const Edges& edges) {
  Parts parts;
  if (kind == Kind::stretch_ratio) {
    const int k = edges.longest();
    for (const double at : {-0.375, -0.125, 0.125, 0.375})
      parts.offsets.push_back(at * edges.edge[static_cast<std::size_t>(k)]);
    parts.share[static_cast<std::size_t>(edges.direction[static_cast<std::size_t>(k)])] = 0.25;
    return parts;
  }
  for (int corner = 0; corner < 1 << edges.count; ++corner) {
    Vec3 offset{};
    for (int k = 0; k < edges.count; ++k)
      offset += (corner >> k & 1 ? 0.25 : -0.25) * edges.edge[static_cast<std::size_t>(k)];
    parts.offsets.push_back(offset);
  }
  for (int k = 0; k < edges.count; ++k)
    parts.share[static_cast<std::size_t>(edges.direction[static_cast<std::size_t>(k)])] = 0.5;
  return parts;
}

void shrink(ParticleSet& set, const Columns& c, std::size_t p, const Parts& parts) {
  const double share = 1.0 / static_cast<double>(parts.offsets.size());
  const auto scale = [&](int column, double factor) {
    if (column >= 0) set.column(static_cast<std::size_t>(column))[p] *= factor;
  };
  for (const int column : c.of_losses()) scale(column, share);
  for (const int column : {c.mass, c.volume_0, c.volume, c.energy, c.heat_source})
    scale(column, share);
  for (int d = 0; d < 3; ++d) {
    const double of_edge = parts.share[static_cast<std::size_t>(d)];
    if (c.half >= 0) scale(c.half + d, of_edge);
    for (int i = 0; i < 3; ++i) scale(c.size + 3 * i + d, of_edge);
    if (c.given_force >= 0) scale(c.given_force + d, share);
    if (c.outside_force >= 0) scale(c.outside_force + d, share);
  }
  set.column(static_cast<std::size_t>(c.split))[p] = 1;
}

// The whole becomes its first part; loads that count particles stay with that one.
void split(ParticleCloud& cloud, int kind, int level, int box, const Columns& c, std::size_t p,
           const Parts& parts) {
  ParticleSet& set = cloud.store(kind).set(level, box);
  shrink(set, c, p, parts);
  const Vec3 middle = set.position(p);
  set.move_to(p, middle + parts.offsets.front());
  for (std::size_t n = 1; n < parts.offsets.size(); ++n) {
    cloud.add_copy(kind, level, box, p, middle + parts.offsets[n],
                   set.id(p) + static_cast<std::int64_t>(n) * next_part);
    for (int d = 0; d < 3 && c.marks >= 0; ++d)
      set.column(static_cast<std::size_t>(c.marks + d))[set.size() - 1] = 0;
  }
}

}  // namespace

bool split_particles(const MpmScene& solids, const std::vector<Carried>& carried,
                     ParticleCloud& cloud, Communicator& ranks) {
  bool any = false;
  for (int k = 0; k < static_cast<int>(solids.materials.size()); ++k) {
    const std::vector<SplitCriterion> criteria = criteria_of(solids, k);
    if (criteria.empty()) continue;
    const Columns& c = carried[static_cast<std::size_t>(k)].columns;
    ParticleStore& store = cloud.store(k);
    for (int l = 0; l < store.level_count(); ++l)
      for (int b = 0; b < store.box_count(l); ++b) {
        const std::size_t count = store.set(l, b).size();
        for (std::size_t p = 0; p < count; ++p) {
          const ParticleSet& set = store.set(l, b);
          if (set.column(static_cast<std::size_t>(c.split))[p] != 0) continue;
          const SplitCriterion* criterion = met(criteria, set, c, p, cloud.level(l));
          if (criterion == nullptr) continue;
          split(cloud, k, l, b, c, p,
                parts_of(criterion->kind, edges_of(set, c, p, cloud.level(l))));
          any = true;
        }
      }
  }
  Reduction all;
  const auto one = all.add_any(any);
  ranks.reduce(all);
  return all.any(one);
}

}  // namespace sluice::mpm
