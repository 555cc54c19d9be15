// MUSL on one level: see SolidLevels::map_back.
#include <algorithm>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/solid_step.hpp"

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

// Beside a master, and of bodies that have one velocity for good, that along the impulse of contact
// is what this gave: found anew, a body would leave a wall faster than it came. Where bodies that
// deform meet, each keeps the velocities of its particles: strain of those of the nodes would lose
// a fifth of the energy of a thin ring that is hit, and gain some at longer steps.
void hold_met(Body& body) {
  for (int b = 0; b < body.met.blocks(); ++b) {
    const std::int64_t* met = body.met.sums(b);
    std::int64_t* node = body.mapped.sums(b);
    for (int n = 0; n < block_nodes; ++n, met += lanes, node += lanes) {
      if (met[count_lane] == 0) continue;
      double lacking = as_real(met[3]);
      for (int d = 0; d < 3; ++d)
        lacking -= as_real(met[d]) * (as_real(node[d]) + body.mapped_units.reference[d]);
      for (int d = 0; d < 3; ++d) node[d] = as_bits(as_real(node[d]) + lacking * as_real(met[d]));
    }
  }
}

}  // namespace

void SolidStep::sum_back(const StageScope& scope, std::span<const KindRates> bounds) {
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    Body& body = bodies_[m];
    KindRates rates = bounds[m];
    rates.mass = body.rates.mass;
    rates.extent = extent_of_middle(body);
    body.mapped_units = units_of(body, static_cast<int>(m), rates);
    body.mapped.clear();
  }
  const bool middle = solids_->midpoint();
  for (const BlockWork& w : work_) {
    Body& body = bodies_[static_cast<std::size_t>(w.kind)];
    if (middle && !body.material->rigid) add_blocks(body.table, w.middle_lowest, w.middle_highest);
  }
  for (Body& body : bodies_) body.mapped.fit(body.table);
  const ThreadTeam& team = *scope.levels.front()->team();
  std::vector<Window> windows(static_cast<std::size_t>(team.size()), Window(shape_, 1));
  team.for_each(work_.size(), [&](std::size_t n, int thread) {
    const BlockWork& w = work_[n];
    Body& body = bodies_[static_cast<std::size_t>(w.kind)];
    const Columns& c = body.carried->columns;
    ParticlesToGrid p;
    if (middle && body.material->rigid) return;
    p.x = places_of_gradients(w);
    p.shape = shape_of_gradients(w);
    p.v = read_columns<3>(*w.next, c.velocity);
    p.mass = w.set->column(static_cast<std::size_t>(c.mass));
    Window& window = windows[static_cast<std::size_t>(thread)];
    if (middle) {
      p.spin = read_columns<3>(*w.next, c.spin);
      window.begin(w.middle_lowest, w.middle_highest);
    } else {
      window.begin(w.lowest, w.highest);
    }
    add_to_window(solids_->basis, body.grid, p, static_cast<int>(w.run.begin),
                  static_cast<int>(w.run.end), body.mapped_units, window);
    window.add_to(body.table, body.mapped, team.size() > 1);
  });
}

void SolidStep::finish_back(const StageScope& scope) {
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    Body& body = bodies_[m];
    body.nodes.fit(body.table);
    scope.levels.front()->team()->for_each(
        static_cast<std::size_t>(body.table.count()), [&](std::size_t b, int) {
          std::int64_t* node = body.mapped.sums(static_cast<int>(b));
          for (int n = 0; n < block_nodes; ++n) to_velocities(node + n * lanes, body.mapped_units);
        });
    hold_met(body);
    hold_boundary(static_cast<int>(m));
    boundary_->unfold(static_cast<int>(m), body.table, body.mapped);
  }
}

// Given velocities hold for those that were mapped back too.
void SolidStep::hold_boundary(int m) {
  Body& body = bodies_[static_cast<std::size_t>(m)];
  for (int b = 0; b < body.table.count(); ++b) {
    const IntVec3 low = shape_.lower(body.table.block(b));
    if (!boundary_->meets(low, shape_.edge)) continue;
    std::int64_t* node = body.mapped.sums(b);
    for (int n = 0; n < block_nodes; ++n, node += lanes) {
      const IntVec3 at = low + IntVec3{n % shape_.edge.x, n / shape_.edge.x % shape_.edge.y,
                                       n / (shape_.edge.x * shape_.edge.y)};
      if (boundary_->is_image(at, m)) continue;
      const GivenVelocity given = boundary_->at(at, m);
      for (int d = 0; d < 3; ++d)
        if (given.given[static_cast<std::size_t>(d)])
          node[d] = as_bits(given.value[d] - body.mapped_units.reference[d]);
    }
  }
}

}  // namespace sluice::mpm
