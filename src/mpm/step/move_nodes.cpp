// The step on nodes: v = v_ref + P/M, contact, v* = v + dk (f/M - alpha v + g), contact, boundary.
#include <cmath>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {

// Lanes become M, v_i | f, 1 where there is mass; else all zero.
static void to_reals(std::int64_t* node, const SumUnits& units) {
  const double mass = sum_in(node, 0);
  const bool any = node[count_lane] != 0 && mass > 0;
  double real[lanes] = {};
  if (any) {
    real[0] = mass / units.mass;
    for (int d = 0; d < 3; ++d) {
      real[1 + d] = units.reference[d] + sum_in(node, 1 + d) / units.momentum / real[0];
      real[4 + d] = sum_in(node, 4 + d) / units.force;
    }
    real[count_lane] = 1;
  }
  for (int l = 0; l < lanes; ++l) node[l] = as_bits(real[l]);
}

// Impulse and work of dk M (g - alpha v).
static void book_body_force(const NodeStep& step, double mass, Vec3 v, Vec3 after,
                            NodeBooks& books) {
  for (int d = 0; d < 3; ++d) {
    const double impulse = step.kick * mass * (step.gravity[d] - step.damping * v[d]);
    if (impulse == 0) continue;
    books.sums[static_cast<std::size_t>(StepSums::force_x + d)].add(impulse);
    books.sums[StepSums::force_work].add(impulse * 0.5 * (v[d] + after[d]));
  }
}

// Lanes M, v | f, . become v* - v_ref, M | v* - v, 1.
void SolidStep::integrate(const NodeStep& step, int m, int block, NodeBooks& books) {
  Body& body = bodies_[static_cast<std::size_t>(m)];
  const IntVec3 low = shape_.lower(body.table.block(block));
  const bool side = boundary_->meets(low, shape_.edge);
  const bool body_force = step.damping != 0 || step.gravity != Vec3{};
  const bool booked = (side || body_force) && exchange_->is_home(body.table, block);
  std::int64_t* node = body.nodes.sums(block);
  for (int n = 0; n < block_nodes; ++n, node += lanes) {
    if (node[count_lane] == 0) continue;
    const double mass = as_real(node[0]);
    Vec3 v{as_real(node[1]), as_real(node[2]), as_real(node[3])}, after;
    for (int d = 0; d < 3; ++d)
      after[d] = v[d] + step.kick * (as_real(node[4 + d]) / mass - step.damping * v[d] +
                                     step.gravity[d]);
    bool image = false;
    if (side) {
      const IntVec3 at = low + IntVec3{n % shape_.edge.x, n / shape_.edge.x % shape_.edge.y,
                                       n / (shape_.edge.x * shape_.edge.y)};
      const GivenVelocity given = boundary_->at(at, m);
      image = boundary_->is_image(at, m);
      if (given.any() && !image) {
        for (int d = 0; d < 3; ++d) {
          if (!given.given[static_cast<std::size_t>(d)]) continue;
          const double impulse = mass * (given.value[d] - after[d]);
          if (booked) {
            books.sums[static_cast<std::size_t>(StepSums::impulse_x + d)].add(impulse);
            books.sums[StepSums::work].add(impulse * 0.5 * (v[d] + given.value[d]));
          }
          after[d] = given.value[d];
        }
      }
    }
    if (body_force && booked && !image) book_body_force(step, mass, v, after, books);
    for (int d = 0; d < 3; ++d) {
      node[d] = as_bits(after[d] - body.units.reference[d]);
      node[4 + d] = as_bits(after[d] - v[d]);
    }
    node[3] = as_bits(mass);
  }
}

void SolidStep::move_block(const NodeStep& step, int m, int block, NodeBooks& books) {
  Body& body = bodies_[static_cast<std::size_t>(m)];
  std::int64_t* node = body.nodes.sums(block);
  for (int n = 0; n < block_nodes; ++n) to_reals(node + n * lanes, body.units);
  integrate(step, m, block, books);
}

Verdict SolidStep::move_nodes(const StageScope& scope) {
  NodeStep step;
  step.dt = scope.step.dt;
  step.kick = solids_->full_first_kick && scope.dt_before == 0 ? step.dt
                                                               : 0.5 * (scope.dt_before + step.dt);
  for (int d = 0; d < 3; ++d)
    if (level_.active[static_cast<std::size_t>(d)]) step.gravity[d] = scene_->constants.gravity[d];
  step.damping = solids_->damping;
  const ThreadTeam& team = *scope.levels.front()->team();
  std::vector<NodeBooks> books(static_cast<std::size_t>(team.size()));
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    if (solids_->materials[m].law->rigid()) continue;
    team.for_each(static_cast<std::size_t>(bodies_[m].table.count()),
                  [&](std::size_t b, int thread) {
                    move_block(step, static_cast<int>(m), static_cast<int>(b),
                               books[static_cast<std::size_t>(thread)]);
                  });
  }
  for (std::size_t n = 1; n < books.size(); ++n)
    for (std::size_t s = 0; s < books[0].sums.size(); ++s)
      books[0].sums[s].merge(books[n].sums[s]);
  unfold();
  books_ = std::move(books[0]);
  kick_ = step.kick;
  return Verdict::good;
}

}  // namespace sluice::mpm
