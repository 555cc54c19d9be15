#include "mpm/step/mean_on_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/base/reduction.hpp"
#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/values_to_grid.hpp"

namespace sluice::mpm {
namespace {

// Columns w, w q_1, ..., w q_n of all particles of a set.
std::vector<std::vector<double>> weighted(const ParticleSet& set, const MeanColumns& of) {
  const double* w = set.column(static_cast<std::size_t>(of.weight));
  std::vector<std::vector<double>> columns(1, std::vector<double>(w, w + set.size()));
  for (int n = 0; n < of.count; ++n) {
    const double* q = set.column(static_cast<std::size_t>(of.first + n));
    std::vector<double>& column = columns.emplace_back(set.size());
    for (std::size_t p = 0; p < set.size(); ++p) column[p] = w[p] * q[p];
  }
  return columns;
}

// The largest sizes of the columns, of all ranks.
std::vector<double> bounds_of(
    const std::map<const ParticleSet*, std::vector<std::vector<double>>>& all, int count,
    Communicator& ranks) {
  std::vector<double> bounds(static_cast<std::size_t>(1 + count), 0.0);
  for (const auto& [set, made] : all)
    for (std::size_t n = 0; n < made.size(); ++n)
      for (const double q : made[n]) bounds[n] = std::max(bounds[n], std::fabs(q));
  Reduction reduction;
  std::vector<Reduction::Maximum> slots;
  for (const double b : bounds) slots.push_back(reduction.add_maximum(b));
  ranks.reduce(reduction);
  for (std::size_t n = 0; n < bounds.size(); ++n) bounds[n] = reduction.maximum(slots[n]);
  return bounds;
}

// Sums of nodes over these units, where there is weight.
std::vector<NodeMean> means_of(const LevelNodes& nodes, const BlockTable& table,
                               const NodeLanes& sums, std::span<const ValueLane> lanes_of) {
  std::vector<NodeMean> means;
  for (int b = 0; b < table.count(); ++b)
    for_each_node(nodes.shape, nodes.lower(table, b), [&](int n, IntVec3 at) {
      const std::int64_t* node = sums.sums(b) + n * lanes;
      if (node[count_lane] == 0 || sum_in(node, 0) <= 0) return;
      NodeMean& m = means.emplace_back();
      m.node = at;
      m.weight = sum_in(node, 0) / lanes_of[0].unit;
      for (std::size_t q = 1; q < lanes_of.size(); ++q)
        m.mean[q - 1] = sum_in(node, static_cast<int>(q)) / lanes_of[q].unit / m.weight;
    });
  return means;
}

}  // namespace

std::vector<NodeMean> mean_on_nodes(const MpmScene& solids, const LevelNodes& nodes, Body& body,
                                    int number, std::span<const BlockWork> work,
                                    Communicator& ranks, const MeanColumns& of) {
  std::map<const ParticleSet*, std::vector<std::vector<double>>> columns;
  for (const BlockWork& w : work)
    if (w.kind == number && !columns.contains(w.set)) columns[w.set] = weighted(*w.set, of);
  const std::vector<double> bounds = bounds_of(columns, of.count, ranks);
  std::vector<ValueLane> lanes_of(bounds.size());
  for (std::size_t n = 0; n < bounds.size(); ++n) lanes_of[n].unit = scale_for(bounds[n]);
  NodeLanes sums;
  sums.fit(body.table);
  Window window(nodes.shape, reach_of(solids.basis));
  for (const BlockWork& w : work) {
    if (w.kind != number) continue;
    const Columns& c = body.carried->columns;
    for (std::size_t n = 0; n < lanes_of.size(); ++n) lanes_of[n].values = columns[w.set][n].data();
    window.begin(w.lowest, w.highest);
    add_values_to_window(solids.basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                         lanes_of, static_cast<int>(w.run.begin), static_cast<int>(w.run.end),
                         window);
    window.add_to(body.table, sums, false);
  }
  nodes.boundary->fold_scalars(number, body.table, sums);
  NodeLanes* const groups[] = {&sums};
  nodes.exchange->share(body.table, groups);
  return means_of(nodes, body.table, sums, lanes_of);
}

}  // namespace sluice::mpm
