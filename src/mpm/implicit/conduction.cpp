#include "mpm/implicit/conduction.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sluice::mpm {
namespace {

// What particles give to the nodes.
struct HeatOfNodes {
  std::vector<double> capacity, heat, source;  // J/K, J, W
  double low = 1e300, high = -1e300;           // temperatures, K
};

HeatOfNodes sum_heat(const NodesOfStep::Parts& p, const OutsideForces& outside, double time) {
  HeatOfNodes h;
  for (std::vector<double>* field : {&h.capacity, &h.heat, &h.source})
    field->assign(p.reached->count(), 0.0);
  for (std::size_t k = 0; k < p.particles->count(); ++k) {
    const ParticleSet& set = p.particles->kind(k).now;
    const Columns& c = (*p.carried)[k].columns;
    const Stencils& s = p.reached->of(k);
    const double* m = set.column(static_cast<std::size_t>(c.mass));
    const double* T = set.column(static_cast<std::size_t>(c.temperature));
    const double specific = p.solids->materials[k].constants.specific_heat;
    std::vector<double> source(set.size());
    if (outside.loads().heats(static_cast<int>(k)) && c.marks >= 0)
      outside.loads().add_heat(time, outside.counts(),
                               outside.loaded(static_cast<int>(k), set, 0, set.size()),
                               source.data());
    for (std::size_t q = 0; q < set.size(); ++q) {
      h.low = std::min(h.low, T[q]);
      h.high = std::max(h.high, T[q]);
      for (std::size_t e = s.first(q); e < s.first(q + 1); ++e) {
        const auto n = static_cast<std::size_t>(s.node[e]);
        const double share = m[q] * specific * s.weight[e];
        h.capacity[n] += share;
        h.heat[n] += share * T[q];
        h.source[n] += s.weight[e] * source[q];
      }
    }
  }
  return h;
}

// What a side says of the temperature of its nodes; the last that speaks of a place counts.
std::optional<double> given_temperature(const NodesOfStep::Parts& p, IntVec3 node) {
  const Level& level = *p.level;
  std::optional<double> given;
  for (const SolidBoundary& b : p.solids->boundaries) {
    const int d = direction_of(b.side);
    if (b.kind != SolidBoundary::Kind::temperature || !level.active[static_cast<std::size_t>(d)])
      continue;
    if (is_plus(b.side) ? node[d] < level.domain.upper[d] : node[d] > level.domain.lower[d])
      continue;
    const auto& regions = p.scene->boundary.side(b.side).regions;
    const Vec3 place = level.anchor + to_real(node) * level.spacing;
    if (b.region <= 0 || regions[static_cast<std::size_t>(b.region)].shape.contains(d, place))
      given = b.value.x;
  }
  return given;
}

// K of one node with all others, in their order.
void row_of(const NodesOfStep::Parts& p, std::size_t node,
            std::vector<std::pair<std::int32_t, double>>& row) {
  row.clear();
  for (const ReachedNodes::Entry& entry : p.reached->reaching(node)) {
    const Stencils& s = p.reached->of(entry.kind);
    const Columns& c = (*p.carried)[entry.kind].columns;
    const double* V = p.particles->kind(entry.kind).now.column(static_cast<std::size_t>(c.volume));
    const double kV = p.solids->materials[entry.kind].constants.conductivity * V[entry.particle];
    const std::array<double, 3>& g = s.slope[entry.entry];
    for (std::size_t e = s.first(entry.particle); e < s.first(entry.particle + 1); ++e) {
      const std::array<double, 3>& h = s.slope[e];
      row.emplace_back(s.node[e], kV * (g[0] * h[0] + g[1] * h[1] + g[2] * h[2]));
    }
  }
  std::stable_sort(row.begin(), row.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::size_t to = 0;
  for (std::size_t n = 0; n < row.size(); ++n)
    if (to > 0 && row[to - 1].first == row[n].first)
      row[to - 1].second += row[n].second;
    else
      row[to++] = row[n];
  row.resize(to);
}

}  // namespace

bool conduct_heat(const NodesOfStep::Parts& p, const OutsideForces& outside, double time, double dt,
                  std::vector<double>& warmed) {
  const HeatOfNodes h = sum_heat(p, outside, time + dt);
  const std::size_t count = p.reached->count();
  warmed.assign(count, 0.0);
  std::vector<std::optional<double>> given(count);
  std::vector<int> unknown(count, -1);
  std::vector<double> before(count);
  bool moves = h.high > h.low;
  int unknowns = 0;
  for (std::size_t n = 0; n < count; ++n) {
    if (!(h.capacity[n] > 0)) continue;
    before[n] = h.heat[n] / h.capacity[n];
    given[n] = given_temperature(p, p.reached->index(n));
    if (given[n]) warmed[n] = *given[n] - before[n];
    moves |= h.source[n] != 0 || warmed[n] != 0;
    if (!given[n]) unknown[n] = unknowns++;
  }
  if (!moves) {
    warmed.clear();
    return true;
  }
  SparseRows rows;
  rows.begin.assign(1, 0);
  std::vector<double> right;
  std::vector<std::pair<std::int32_t, double>> row;
  const double storage = p.solids->implicit->heat_is_stored ? 1 / dt : 0;
  for (std::size_t n = 0; n < count; ++n) {
    if (unknown[n] < 0) continue;
    row_of(p, n, row);
    // For the change: (C/dt + K) (T_1 - T_0) = q - K T_0.
    double r = h.source[n];
    for (const auto& [m, value] : row) {
      const auto other = static_cast<std::size_t>(m);
      if (!(h.capacity[other] > 0)) continue;  // reached by a slope alone: nothing is known there
      r -= value * (before[other] - before[n]);
      if (unknown[other] < 0) {
        r -= value * warmed[other];
        continue;
      }
      rows.column.push_back(unknown[other]);
      rows.value.push_back(value + (other == n ? storage * h.capacity[n] : 0));
    }
    right.push_back(r);
    rows.begin.push_back(static_cast<int>(rows.column.size()));
  }
  std::vector<double> change;
  SparseSolver solver;
  if (!solver.solve(rows, right, change)) return false;
  for (std::size_t n = 0; n < count; ++n)
    if (unknown[n] >= 0) warmed[n] = change[static_cast<std::size_t>(unknown[n])];
  return true;
}

}  // namespace sluice::mpm
