// Both velocities of a node over a kick, what sides give to water there, and its books.
#include <cmath>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/mirror_books.hpp"
#include "mpm/step/pore_water.hpp"

namespace sluice::mpm {

// w = v_w - v_s: w* = w e^-x + (a_w - a_s) t (1 - e^-x)/x with x = lambda t; both from w* and from
// their momentum, which no drag changes.
void PhasePair::kick(double time, double a_solid, double a_water) {
  const double x = relaxation * time;
  const double decay = std::exp(-x), mean = x > 0 ? -std::expm1(-x) / x : 1.0;
  const double apart = (of_water - of_solid) * decay + (a_water - a_solid) * time * mean;
  const double share = water / (solid + water);  // of the momentum's mass
  const double together =
      (1 - share) * (of_solid + time * a_solid) + share * (of_water + time * a_water);
  of_solid = together - share * apart;
  of_water = together + (1 - share) * apart;
}

// A node on a mirror has no velocity normal to it.
void PoreWater::start_block(BlockMember of) {
  if (!in(of.body)) return;
  const Body& body = (*bodies_)[static_cast<std::size_t>(of.body)];
  std::int64_t* node = lanes_of(of.body).sums(of.block);
  for_each_node(nodes_->shape, nodes_->lower(body.table, of.block), [&](int n, IntVec3 at) {
    const std::array<bool, 3> on = nodes_->boundary->on_mirror(at, of.body);
    for (int d = 0; d < 3; ++d)
      if (on[static_cast<std::size_t>(d)]) node[n * lanes + 1 + d] = as_bits(0.0);
  });
}

bool PoreWater::kick_block(const NodeStep& step, BlockMember of, BlockImpulses& impulses) {
  if (!in(of.body)) return false;
  const auto k = static_cast<std::size_t>(of.body);
  std::int64_t* solid = (*bodies_)[k].nodes.sums(of.block);
  std::int64_t* water = water_[k].sums(of.block);
  const std::int64_t* scalars = scalars_[k].sums(of.block);
  for (int n = 0; n < block_lanes; n += lanes)
    if (solid[n + count_lane] != 0)
      kick_node(step, impulses[static_cast<std::size_t>(n / lanes)], solid + n, water + n,
                scalars + n);
  return true;
}

void PoreWater::kick_node(const NodeStep& step, NodeImpulses& of, std::int64_t* solid,
                          std::int64_t* water, const std::int64_t* scalars) {
  const double full = as_real(scalars[0]);
  PhasePair pair;
  pair.solid = as_real(solid[0]);
  pair.water = as_real(water[0]);
  const bool wet = water[count_lane] != 0 && full > 0;
  if (wet) pair.relaxation = as_real(scalars[1]) / full * (1 + pair.water / pair.solid);
  for (int d = 0; d < 3; ++d) {
    const double v = as_real(solid[1 + d]) + of.change[d], v_w = as_real(water[1 + d]);
    const double F = wet ? as_real(water[4 + d]) / full : 0.0;
    const double around = step.gravity[d] - step.damping * v;
    pair.of_solid = v;
    pair.of_water = v_w;
    const double a_w = F + step.gravity[d] - step.damping * v_w;
    pair.kick(step.kick, (as_real(solid[4 + d]) - pair.water * F) / pair.solid + around, a_w);
    of.push[d] = pair.solid * (pair.of_solid - v - step.kick * around);
    solid[4 + d] = as_bits(pair.of_solid);
    water[4 + d] = as_bits(pair.of_water);
  }
}

// Of one direction: K* - K, what gravity and damping gave, and the rest, each by the mean velocity.
static void book(const NodeStep& step, int d, double mass, double before, double after,
                 NodeBooks& books) {
  const double middle = 0.5 * (before + after);
  const double impulse = step.kick * mass * (step.gravity[d] - step.damping * before);
  books.sums[static_cast<std::size_t>(StepSums::force_x + d)].add(impulse);
  books.sums[StepSums::force_work].add(impulse * middle);
  books.sums[StepSums::node_gain].add(mass * (after - before) * middle);
  books.sums[StepSums::node_work].add((mass * (after - before) - impulse) * middle);
}

void PoreWater::finish_block(const NodeStep& step, BlockMember of, bool side, bool booked,
                             NodeBooks& books) {
  if (!in(of.body)) return;
  const Body& body = (*bodies_)[static_cast<std::size_t>(of.body)];
  const std::int64_t* solid = body.nodes.sums(of.block);
  std::int64_t* water = lanes_of(of.body).sums(of.block);
  for_each_node(nodes_->shape, nodes_->lower(body.table, of.block), [&](int n, IntVec3 at) {
    if (solid[n * lanes + count_lane] != 0 && water[n * lanes + count_lane] != 0)
      finish_node(step, of.body, at, side, booked, water + n * lanes, books);
  });
}

void PoreWater::finish_node(const NodeStep& step, int kind, IntVec3 at, bool side, bool booked,
                            std::int64_t* node, NodeBooks& books) const {
  const NodeBoundary& boundary = *nodes_->boundary;
  const double mass = as_real(node[0]);
  const bool image = side && boundary.is_image(at, kind);
  const GivenVelocity given = side && !image ? boundary.at(at, kind) : GivenVelocity{};
  for (int d = 0; d < 3; ++d) {
    const double before = as_real(node[1 + d]), free = as_real(node[4 + d]);
    const double after = given.given[static_cast<std::size_t>(d)] ? given.value[d] : free;
    if (booked && !image) {
      book(step, d, mass, before, free, books);
      const double impulse = mass * (after - free);
      const double work = impulse * 0.5 * (free + after);
      if (impulse != 0) {
        books.sums[static_cast<std::size_t>(StepSums::impulse_x + d)].add(impulse);
        books.sums[StepSums::work].add(work);
        books.sums[StepSums::node_gain].add(work);
      }
    }
    node[d] = as_bits(after);
    node[4 + d] = as_bits(after - before);
  }
  node[3] = as_bits(mass);
}

void PoreWater::after_nodes(const NodeStep& /*step*/, NodeBooks& books) {
  for (int m = 0; m < static_cast<int>(water_.size()); ++m) {
    if (!in(m)) continue;
    const Body& body = (*bodies_)[static_cast<std::size_t>(m)];
    book_mirrored_changes(*nodes_, body, m, lanes_of(m), books);
    nodes_->boundary->unfold(m, body.table, lanes_of(m));
  }
}

}  // namespace sluice::mpm
