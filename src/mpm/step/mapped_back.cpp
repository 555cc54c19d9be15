#include "mpm/step/mapped_back.hpp"

#include "mpm/nodes/node_sums.hpp"

namespace sluice::mpm {
namespace {

// Lanes become v - v_ref, 1 where there is mass | ., .
void to_velocities(std::int64_t* node, const SumUnits& units) {
  const double mass = sum_in(node, 0);
  double real[lanes] = {};
  if (node[count_lane] != 0 && mass > 0) {
    for (int d = 0; d < 3; ++d)
      real[d] = sum_in(node, 1 + d) / units.momentum / (mass / units.mass);
    real[3] = 1;
  }
  for (int l = 0; l < lanes; ++l) node[l] = as_bits(real[l]);
}

}  // namespace

std::array<const double*, 3> places_of_gradients(const BlockWork& w, const Columns& c,
                                                 bool middle) {
  if (!middle) return places_of(*w.set, c);
  return {w.next->coordinate(0), w.next->coordinate(1), w.next->coordinate(2)};
}

ParticleShape shape_of_gradients(const BlockWork& w, const Columns& c, bool middle) {
  ParticleShape shape = shape_of(*w.set, c);
  if (middle) shape.corners = corners_of(*w.next, c);
  return shape;
}

double extent_of_middle(const MpmScene& solids, const Body& body) {
  return body.rates.extent + (solids.carries_corners() ? 2 * farthest_middle : 0.0);
}

MappedBack::MappedBack(const MpmScene& solids, const LevelNodes& nodes, std::vector<Body>& bodies,
                       const ContactStage* contact)
    : solids_(&solids),
      nodes_(&nodes),
      bodies_(&bodies),
      contact_(contact),
      lanes_(solids.materials.size()),
      units_(solids.materials.size()) {}

void MappedBack::sum(std::span<const BlockWork> work, const LevelSpacings& spacings,
                     std::span<const KindRates> bounds) {
  for (std::size_t m = 0; m < lanes_.size(); ++m) {
    const Body& body = (*bodies_)[m];
    KindRates rates = bounds[m];
    rates.mass = body.rates.mass;
    rates.extent = extent_of_middle(*solids_, body);
    units_[m] = sum_units(*solids_, *nodes_->boundary, spacings, body, static_cast<int>(m), rates,
                          0);  // no forces
    lanes_[m].clear();
  }
  for (const BlockWork& w : work) {
    Body& body = (*bodies_)[static_cast<std::size_t>(w.kind)];
    if (solids_->midpoint() && !body.material->rigid)
      add_blocks(body.table, w.middle_lowest, w.middle_highest);
  }
  for (std::size_t m = 0; m < lanes_.size(); ++m) lanes_[m].fit((*bodies_)[m].table);
  const ThreadTeam& team = *nodes_->team;
  std::vector<Window> windows(static_cast<std::size_t>(team.size()), Window(nodes_->shape, 1));
  team.for_each(work.size(), [&](std::size_t n, int thread) {
    give(work[n], windows[static_cast<std::size_t>(thread)], team.size() > 1);
  });
}

void MappedBack::give(const BlockWork& w, Window& window, bool shared) {
  const auto m = static_cast<std::size_t>(w.kind);
  const Body& body = (*bodies_)[m];
  const Columns& c = body.carried->columns;
  const bool middle = solids_->midpoint();
  if (middle && body.material->rigid) return;
  ParticlesToGrid p;
  p.x = places_of_gradients(w, c, middle);
  p.shape = shape_of_gradients(w, c, middle);
  p.v = read_columns<3>(*w.next, c.velocity);
  p.mass = w.set->column(static_cast<std::size_t>(c.mass));
  if (middle) {
    p.spin = read_columns<3>(*w.next, c.spin);
    window.begin(w.middle_lowest, w.middle_highest);
  } else {
    window.begin(w.lowest, w.highest);
  }
  add_to_window(solids_->basis, body.grid, p, static_cast<int>(w.run.begin),
                static_cast<int>(w.run.end), units_[m], window);
  window.add_to(body.table, lanes_[m], shared);
}

void MappedBack::finish() {
  for (std::size_t k = 0; k < lanes_.size(); ++k) {
    Body& body = (*bodies_)[k];
    body.nodes.fit(body.table);
    nodes_->team->for_each(static_cast<std::size_t>(body.table.count()), [&](std::size_t b, int) {
      std::int64_t* node = lanes_[k].sums(static_cast<int>(b));
      for (int n = 0; n < block_nodes; ++n) to_velocities(node + n * lanes, units_[k]);
    });
    const int m = static_cast<int>(k);
    if (contact_ != nullptr && solids_->midpoint()) hold_met(m);
    hold_boundary(m);
    nodes_->boundary->unfold(m, body.table, lanes_[k]);
  }
}

// Beside a master, and of bodies that have one velocity for good, that along the impulse of contact
// is what this gave: found anew, a body would leave a wall faster than it came. Where bodies that
// deform meet, each keeps the velocities of its particles: strain of those of the nodes would lose
// a fifth of the energy of a thin ring that is hit, and gain some at longer steps.
void MappedBack::hold_met(int m) {
  const NodeLanes& held = contact_->held(m);
  const Vec3 reference = units(m).reference;
  for (int b = 0; b < held.blocks(); ++b) {
    const std::int64_t* met = held.sums(b);
    std::int64_t* node = of(m).sums(b);
    for (int n = 0; n < block_nodes; ++n, met += lanes, node += lanes) {
      if (met[count_lane] == 0) continue;
      double lacking = as_real(met[3]);
      for (int d = 0; d < 3; ++d) lacking -= as_real(met[d]) * (as_real(node[d]) + reference[d]);
      for (int d = 0; d < 3; ++d) node[d] = as_bits(as_real(node[d]) + lacking * as_real(met[d]));
    }
  }
}

// Given velocities hold for those that were mapped back too.
void MappedBack::hold_boundary(int m) {
  const Body& body = (*bodies_)[static_cast<std::size_t>(m)];
  const NodeBoundary& boundary = *nodes_->boundary;
  for (int b = 0; b < body.table.count(); ++b) {
    const IntVec3 low = nodes_->lower(body.table, b);
    if (!boundary.meets(low, nodes_->shape.edge)) continue;
    for_each_node(nodes_->shape, low, [&](int n, IntVec3 at) {
      if (boundary.is_image(at, m)) return;
      std::int64_t* node = of(m).sums(b) + n * lanes;
      const GivenVelocity given = boundary.at(at, m);
      for (int d = 0; d < 3; ++d)
        if (given.given[static_cast<std::size_t>(d)])
          node[d] = as_bits(given.value[d] - units(m).reference[d]);
    });
  }
}

}  // namespace sluice::mpm
