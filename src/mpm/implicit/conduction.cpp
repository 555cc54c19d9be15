#include "mpm/implicit/conduction.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mpm/implicit/node_pairs.hpp"
#include "mpm/implicit/node_solver.hpp"

namespace sluice::mpm {
namespace {

constexpr double tolerance = 1e-12;  // residual over right-hand side

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

// K_ij = sum k V G_i.G_j.
solve::BlockRows conductances(const NodesOfStep::Parts& p, const solve::Workers& workers) {
  NodePairs pairs(p, {true, false}, workers);
  solve::BlockRows rows = pairs.number(1);
  for (std::size_t k = 0; k < p.particles->count(); ++k) {
    const ParticleSet& set = p.particles->kind(k).now;
    const Stencils& s = p.reached->of(k);
    const double* V = set.column(static_cast<std::size_t>((*p.carried)[k].columns.volume));
    for (std::size_t q = 0; q < set.size(); ++q) {
      const double kV = p.solids->materials[k].constants.conductivity * V[q];
      for (std::size_t a = s.first(q); a < s.first(q + 1); ++a) {
        const std::array<double, 3>& g = s.slope[a];
        for (std::size_t b = s.first(q); b < s.first(q + 1); ++b) {
          const std::array<double, 3>& h = s.slope[b];
          rows.value[pairs.block(rows, s.node[a], s.node[b])] +=
              kV * (g[0] * h[0] + g[1] * h[1] + g[2] * h[2]);
        }
      }
    }
  }
  return rows;
}

// For the change: (C/dt + K) (T_1 - T_0) = q - K T_0. Makes K the matrix of the free nodes, and
// adds to q what is known.
void reduce_to_free(const HeatOfNodes& h, const std::vector<double>& before,
                    const std::vector<double>& warmed, const std::vector<std::uint8_t>& free,
                    double storage, solve::BlockRows& K, std::vector<double>& q) {
  for (std::size_t n = 0; n < K.count(); ++n)
    for (std::size_t e = K.begin[n]; e < K.begin[n + 1]; ++e) {
      const auto other = static_cast<std::size_t>(K.column[e]);
      // Nodes that are reached by a slope alone: nothing is known there.
      const double value = h.capacity[other] > 0 ? K.value[e] : 0;
      q[n] -= value * (before[other] - before[n]);
      if (free[other] == 0) q[n] -= value * warmed[other];
      K.value[e] = free[n] != 0 && free[other] != 0 ? value : 0;
      if (other == n && free[n] != 0) K.value[e] += storage * h.capacity[n];
    }
  for (std::size_t n = 0; n < K.count(); ++n)
    if (free[n] == 0) q[n] = 0;
}

double share_of_storage(const HeatOfNodes& h, double storage, const std::vector<std::uint8_t>& free,
                        const solve::BlockRows& K) {
  double stored = 0, all = 0;
  for (std::size_t n = 0; n < K.count(); ++n) {
    if (free[n] == 0) continue;
    stored += storage * h.capacity[n];
    all += *K.find(n, static_cast<std::int32_t>(n));
  }
  return all > 0 ? stored / all : 0;
}

}  // namespace

bool conduct_heat(const NodesOfStep::Parts& p, const OutsideForces& outside, const HeatStep& step,
                  std::vector<double>& warmed) {
  HeatOfNodes h = sum_heat(p, outside, step.time + step.dt);
  const std::size_t count = p.reached->count();
  warmed.assign(count, 0.0);
  std::vector<std::uint8_t> free(count, 0);
  std::vector<double> before(count);
  bool moves = h.high > h.low;
  for (std::size_t n = 0; n < count; ++n) {
    if (!(h.capacity[n] > 0)) continue;
    before[n] = h.heat[n] / h.capacity[n];
    const std::optional<double> given = given_temperature(p, p.reached->index(n));
    if (given) warmed[n] = *given - before[n];
    moves |= h.source[n] != 0 || warmed[n] != 0;
    free[n] = given ? 0 : 1;
  }
  if (!moves) {
    warmed.clear();
    return true;
  }
  const solve::Workers workers = workers_of(*step.team);
  const double storage = p.solids->implicit->heat_is_stored ? 1 / step.dt : 0;
  solve::BlockRows K = conductances(p, workers);
  reduce_to_free(h, before, warmed, free, storage, K, h.source);
  SparseSolver direct;
  NodeSolver solver({&K, free, p.level->active_count(), p.solids->implicit->direct}, workers,
                    direct);
  solver.set_up(0, share_of_storage(h, storage, free, K));
  std::vector<double> change;
  if (!solver.solve(h.source, change, tolerance).solved) return false;
  for (std::size_t n = 0; n < count; ++n)
    if (free[n] != 0) warmed[n] = change[n];
  return true;
}

}  // namespace sluice::mpm
