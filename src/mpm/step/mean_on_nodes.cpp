// Means of what particles carry around nodes, for outputs.
#include <algorithm>
#include <cmath>
#include <map>

#include "framework/base/reduction.hpp"
#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/solid_step.hpp"
#include "mpm/transfer/values_to_grid.hpp"

namespace sluice::mpm {
namespace {

// Columns w, w q_1, ..., w q_n of all particles of a set.
std::vector<std::vector<double>> weighted(const ParticleSet& set, int weight, int first,
                                          int count) {
  const double* w = set.column(static_cast<std::size_t>(weight));
  std::vector<std::vector<double>> columns(1, std::vector<double>(w, w + set.size()));
  for (int n = 0; n < count; ++n) {
    const double* q = set.column(static_cast<std::size_t>(first + n));
    std::vector<double>& column = columns.emplace_back(set.size());
    for (std::size_t p = 0; p < set.size(); ++p) column[p] = w[p] * q[p];
  }
  return columns;
}

}  // namespace

std::vector<NodeMean> SolidStep::mean_on_nodes(const StageScope& scope, int number, int weight,
                                               int first, int count) {
  Body& body = bodies_[static_cast<std::size_t>(number)];
  std::map<const ParticleSet*, std::vector<std::vector<double>>> columns;
  std::vector<double> bounds(static_cast<std::size_t>(1 + count), 0.0);
  for (const BlockWork& w : work_) {
    if (w.kind != number || columns.contains(w.set)) continue;
    const auto& made = columns[w.set] = weighted(*w.set, weight, first, count);
    for (std::size_t n = 0; n < made.size(); ++n)
      for (const double q : made[n]) bounds[n] = std::max(bounds[n], std::fabs(q));
  }
  Reduction reduction;
  std::vector<Reduction::Maximum> slots;
  for (const double b : bounds) slots.push_back(reduction.add_maximum(b));
  scope.ranks->reduce(reduction);
  std::vector<ValueLane> lanes_of(bounds.size());
  for (std::size_t n = 0; n < bounds.size(); ++n)
    lanes_of[n].unit = scale_for(reduction.maximum(slots[n]));
  NodeLanes sums;
  sums.fit(body.table);
  Window window(shape_, reach_of(solids_->basis));
  for (const BlockWork& w : work_) {
    if (w.kind != number) continue;
    const Columns& c = body.carried->columns;
    for (std::size_t n = 0; n < lanes_of.size(); ++n) lanes_of[n].values = columns[w.set][n].data();
    window.begin(w.lowest, w.highest);
    add_values_to_window(solids_->basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                         lanes_of, static_cast<int>(w.run.begin), static_cast<int>(w.run.end),
                         window);
    window.add_to(body.table, sums, false);
  }
  boundary_->fold_scalars(number, body.table, sums);
  NodeLanes* const groups[] = {&sums};
  exchange_->share(body.table, groups);
  std::vector<NodeMean> means;
  for (int b = 0; b < body.table.count(); ++b) {
    const IntVec3 low = shape_.lower(body.table.block(b));
    const std::int64_t* node = sums.sums(b);
    for (int n = 0; n < block_nodes; ++n, node += lanes) {
      if (node[count_lane] == 0 || sum_in(node, 0) <= 0) continue;
      NodeMean& m = means.emplace_back();
      m.node = node_of(shape_, low, n);
      m.weight = sum_in(node, 0) / lanes_of[0].unit;
      for (int q = 0; q < count; ++q)
        m.mean[static_cast<std::size_t>(q)] =
            sum_in(node, 1 + q) / lanes_of[static_cast<std::size_t>(1 + q)].unit / m.weight;
    }
  }
  return means;
}

}  // namespace sluice::mpm
