#include "mpm/step/node_update.hpp"

#include <cmath>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/mirror_books.hpp"

namespace sluice::mpm {
namespace {

// Lanes become M, v_i | f, 1 where there is mass; else all zero.
void to_reals(std::int64_t* node, const SumUnits& units) {
  const double mass = sum_in(node, 0);
  const bool any = node[count_lane] != 0 && mass > 0;
  double real[lanes] = {};
  if (any) {
    real[0] = mass / units.mass;
    for (int d = 0; d < 3; ++d) {
      real[1 + d] = units.reference[d] + sum_in(node, 1 + d) / units.momentum / real[0];
      real[4 + d] = sum_in(node, 4 + d) / units.force;
    }
    real[count_lane] = node_moved;
  }
  for (int l = 0; l < lanes; ++l) node[l] = as_bits(real[l]);
}

// Impulse and work of dk M (g - alpha v), v: after contact A.
void book_body_force(const NodeStep& step, double mass, Vec3 v, Vec3 changed, Vec3 after,
                     NodeBooks& books) {
  for (int d = 0; d < 3; ++d) {
    const double impulse = step.kick * mass * (step.gravity[d] - step.damping * changed[d]);
    if (impulse == 0) continue;
    books.add(StepSums::force_x + d, impulse);
    books.add(StepSums::force_work, impulse * 0.5 * (v[d] + after[d]));
  }
}

// K* - K of a node, the work of its forces, and what contact took: each by vb = (v + v*)/2.
void book_energy(const NodeImpulses& of, double mass, Vec3 v, Vec3 after, bool kicked,
                 BodyEnergySums& body, NodeBooks& books) {
  const Vec3 middle = 0.5 * (v + after);
  body[BodyEnergySums::node_gain].add(0.5 * mass * (dot(after, after) - dot(v, v)));
  body[BodyEnergySums::node_work].add(dot(of.push, middle));
  if (of.met != Vec3{}) {
    books.add(StepSums::contact_loss, -dot(of.met, middle));
    body[BodyEnergySums::contact_slack].add(dot(of.met, after - middle));
  }
  if (!kicked && of.met == Vec3{}) return;
  const Vec3 change = after - v;
  body[BodyEnergySums::kick].add(dot(mass * change - of.push, change));
}

}  // namespace

// A node on a mirror has no velocity normal to it: its image brings the opposite.
void NodeUpdate::start(const NodeStep& step, BlockMember of, NodeBooks& books) const {
  Body& b = body(of);
  std::int64_t* node = b.nodes.sums(of.block);
  for (int n = 0; n < block_nodes; ++n) to_reals(node + n * lanes, b.units);
  const IntVec3 low = nodes_->lower(b.table, of.block);
  if (!nodes_->boundary->meets(low, nodes_->shape.edge)) return;
  for (int n = 0; n < block_nodes; ++n) {
    const std::array<bool, 3> on =
        nodes_->boundary->on_mirror(node_of(nodes_->shape, low, n), of.body);
    for (int d = 0; d < 3; ++d)
      if (on[static_cast<std::size_t>(d)]) node[n * lanes + 1 + d] = as_bits(0.0);
  }
  for (SolidEffect* effect : effects_) effect->start_block(of);
  book_mirrored_forces(*nodes_, b, of, step.kick, books);
}

// v* = v + a + dk (f/M - alpha (v + a) + g), a: change by contact A.
void NodeUpdate::kick(const NodeStep& step, BlockMember of, BlockImpulses& impulses) const {
  for (SolidEffect* effect : effects_)
    if (effect->kick_block(step, of, impulses)) return;
  std::int64_t* node = body(of).nodes.sums(of.block);
  for (int n = 0; n < block_nodes; ++n, node += lanes) {
    if (node[count_lane] == 0) continue;
    NodeImpulses& at = impulses[static_cast<std::size_t>(n)];
    const double mass = as_real(node[0]);
    for (int d = 0; d < 3; ++d) {
      const double v = as_real(node[1 + d]) + at.change[d], f = as_real(node[4 + d]);
      at.push[d] = step.kick * f;
      node[4 + d] = as_bits(v + step.kick * (f / mass - step.damping * v + step.gravity[d]));
    }
  }
}

bool NodeUpdate::hold(BlockMember of, IntVec3 at, double mass, Vec3 v, bool booked, Vec3& after,
                      NodeBooks& books) const {
  const GivenVelocity given = nodes_->boundary->at(at, of.body);
  if (!given.any()) return false;
  for (int d = 0; d < 3; ++d) {
    if (!given.given[static_cast<std::size_t>(d)]) continue;
    const double impulse = mass * (given.value[d] - after[d]);
    if (booked) {
      books.add(StepSums::impulse_x + d, impulse);
      books.add(StepSums::work, impulse * 0.5 * (v[d] + given.value[d]));
    }
    after[d] = given.value[d];
  }
  return true;
}

void NodeUpdate::finish(const NodeStep& step, BlockMember of, const BlockImpulses& impulses,
                        NodeBooks& books) const {
  Body& b = body(of);
  const IntVec3 low = nodes_->lower(b.table, of.block);
  const bool side = nodes_->boundary->meets(low, nodes_->shape.edge) && !b.material->rigid;
  const bool booked = nodes_->booked(b.table, of.block);
  const bool forced = booked && (step.damping != 0 || step.gravity != Vec3{});
  std::int64_t* node = b.nodes.sums(of.block);
  for (int n = 0; n < block_nodes; ++n, node += lanes) {
    if (node[count_lane] == 0) continue;
    const double mass = as_real(node[0]);
    const Vec3 v{as_real(node[1]), as_real(node[2]), as_real(node[3])};
    Vec3 after{as_real(node[4]), as_real(node[5]), as_real(node[6])};
    bool image = false, held = false;
    if (side) {
      const IntVec3 at = node_of(nodes_->shape, low, n);
      image = nodes_->boundary->is_image(at, of.body);
      held = !image && hold(of, at, mass, v, booked, after, books);
    }
    const NodeImpulses& got = impulses[static_cast<std::size_t>(n)];
    if (forced && !image) book_body_force(step, mass, v, v + got.change, after, books);
    if (booked && !image)
      book_energy(got, mass, v, after, held || forced, books.body(of.body), books);
    for (int d = 0; d < 3; ++d) {
      node[d] = as_bits(after[d] - b.units.reference[d]);
      node[4 + d] = as_bits(after[d] - v[d]);
    }
    node[3] = as_bits(mass);
    if (held || got.met != Vec3{}) node[count_lane] = node_met;
  }
  for (SolidEffect* effect : effects_) effect->finish_block(step, of, side, booked, books);
}

void NodeUpdate::move(const NodeStep& step, BlockMember of, BlockImpulses& impulses,
                      NodeBooks& books) const {
  impulses.fill({});
  start(step, of, books);
  kick(step, of, impulses);
  finish(step, of, impulses, books);
}

// Lanes as finish() leaves them.
void NodeUpdate::prescribe(const std::array<double, 9>& G, BlockMember of) const {
  NodeBooks unused;  // what is prescribed is no balance of forces
  unused.make_room(bodies_->size());
  start({}, of, unused);
  Body& b = body(of);
  const IntVec3 low = nodes_->lower(b.table, of.block);
  std::int64_t* node = b.nodes.sums(of.block);
  for (int n = 0; n < block_nodes; ++n, node += lanes) {
    if (node[count_lane] == 0) continue;
    const Vec3 x = nodes_->place(node_of(nodes_->shape, low, n));
    const double mass = as_real(node[0]);
    for (int d = 0; d < 3; ++d) {
      const auto row = static_cast<std::size_t>(3 * d);
      const double v = G[row] * x.x + G[row + 1] * x.y + G[row + 2] * x.z;
      node[d] = as_bits(v - b.units.reference[d]);
      node[4 + d] = as_bits(0.0);
    }
    node[3] = as_bits(mass);
  }
}

}  // namespace sluice::mpm
