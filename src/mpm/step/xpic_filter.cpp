#include "mpm/step/xpic_filter.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/from_grid.hpp"

namespace sluice::mpm {
namespace {

// v_i - v_ref of every node into lanes of their own; the largest component.
double take(const BlockTable& table, const NodeLanes& nodes, NodeLanes& to) {
  double most = 0;
  for (int b = 0; b < table.count(); ++b) {
    const std::int64_t* node = nodes.sums(b);
    std::int64_t* v = to.sums(b);
    for (int n = 0; n < block_nodes; ++n, node += lanes, v += lanes)
      for (int d = 0; d < 3; ++d) {
        const double before = as_real(node[d]) - as_real(node[4 + d]);  // v* - dv
        v[d] = as_bits(before);
        most = std::max(most, std::fabs(before));
      }
  }
  return most;
}

// Columns of particles counted from a chunk, with velocities that were read.
ParticlesToGrid chunk_of(const BlockWork& w, const Columns& c, std::size_t at,
                         const GridAtParticles& read) {
  ParticlesToGrid p;
  p.x = places_of(*w.set, c);
  p.shape = shape_of(*w.set, c);
  p.mass = w.set->column(static_cast<std::size_t>(c.mass)) + at;
  const auto go_on = [&](auto& columns) {
    for (const double*& column : columns)
      if (column != nullptr) column += at;
  };
  go_on(p.x);
  go_on(p.shape.half);
  go_on(p.shape.F);
  go_on(p.shape.edges);
  go_on(p.shape.corners);
  for (std::size_t d = 0; d < 3; ++d) p.v[d] = read.u[d];
  return p;
}

}  // namespace

// Of one thread.
struct XpicFilter::Scratch {
  explicit Scratch(const BlockShape& shape) : from(shape, 1), to(shape, 1) {}
  Window from, to;
  GridAtParticles read;
};

XpicFilter::XpicFilter(const MpmScene& solids, const LevelNodes& nodes, std::vector<Body>& bodies)
    : solids_(&solids),
      nodes_(&nodes),
      bodies_(&bodies),
      velocities_(solids.materials.size()),
      sums_(solids.materials.size()),
      units_(solids.materials.size()) {}

std::vector<double> XpicFilter::take_velocities() {
  std::vector<double> most(bodies_->size());
  for (std::size_t m = 0; m < bodies_->size(); ++m) {
    const Body& body = (*bodies_)[m];
    velocities_[m].clear();
    velocities_[m].fit(body.table);
    if (!body.material->law->rigid()) most[m] = take(body.table, body.nodes, velocities_[m]);
  }
  return most;
}

void XpicFilter::begin(std::span<const double> most) {
  for (std::size_t m = 0; m < bodies_->size(); ++m) {
    const Body& body = (*bodies_)[m];
    units_[m] = {};
    units_[m].mass = body.units.mass;
    // What is read at a particle is a mean of these velocities, but for rounding.
    units_[m].momentum = scale_for(body.rates.mass * most[m] * (1 + 1e-12));
  }
  add(solids_->xpic_order);
}

void XpicFilter::add(double factor) {
  for (std::size_t m = 0; m < bodies_->size(); ++m) {
    Body& body = (*bodies_)[m];
    if (body.material->law->rigid()) continue;
    for (int b = 0; b < body.table.count(); ++b) {
      std::int64_t* node = body.nodes.sums(b);
      const std::int64_t* v = velocities_[m].sums(b);
      for (int n = 0; n < block_nodes; ++n, node += lanes, v += lanes)
        for (int d = 0; d < 3; ++d)
          node[4 + d] = as_bits(as_real(node[4 + d]) + factor * as_real(v[d]));
    }
  }
}

void XpicFilter::sum(std::span<const BlockWork> work, bool first) {
  const ThreadTeam& team = *nodes_->team;
  for (std::size_t m = 0; m < bodies_->size(); ++m) {
    sums_[m].clear();
    sums_[m].fit((*bodies_)[m].table);
  }
  std::vector<Scratch> scratch(static_cast<std::size_t>(team.size()), Scratch(nodes_->shape));
  team.for_each(work.size(), [&](std::size_t n, int thread) {
    pass(work[n], first, team.size() > 1, scratch[static_cast<std::size_t>(thread)]);
  });
}

void XpicFilter::pass(const BlockWork& w, bool first, bool shared, Scratch& s) {
  const auto m = static_cast<std::size_t>(w.kind);
  const Body& body = (*bodies_)[m];
  const Columns& c = body.carried->columns;
  s.from.load(w.lowest, w.highest, body.table, velocities_[m]);
  s.to.begin(w.lowest, w.highest);
  for (std::size_t at = w.run.begin; at < w.run.end; at += chunk_size) {
    const int n = static_cast<int>(std::min<std::size_t>(chunk_size, w.run.end - at));
    read_window(solids_->basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                static_cast<int>(at), n, false, s.from, s.read);
    for (int d = 0; d < 3 && first; ++d)
      std::copy_n(s.read.u[d], n, w.next->column(static_cast<std::size_t>(c.velocity + d)) + at);
    add_to_window(solids_->basis, body.grid, chunk_of(w, c, at, s.read), 0, n, units_[m], s.to);
  }
  s.to.add_to(body.table, sums_[m], shared);
}

void XpicFilter::finish() {
  for (std::size_t m = 0; m < bodies_->size(); ++m) {
    Body& body = (*bodies_)[m];
    body.nodes.fit(body.table);
    velocities_[m].fit(body.table);
    for (int b = 0; b < body.table.count(); ++b) {
      const std::int64_t *from = sums_[m].sums(b), *node = body.nodes.sums(b);
      std::int64_t* v = velocities_[m].sums(b);
      for (int n = 0; n < block_nodes; ++n, from += lanes, node += lanes, v += lanes) {
        const double mass = as_real(node[3]);
        for (int d = 0; d < 3; ++d)
          v[d] = as_bits(mass > 0 && from[count_lane] != 0
                             ? sum_in(from, 1 + d) / units_[m].momentum / mass
                             : 0.0);
      }
    }
  }
}

}  // namespace sluice::mpm
