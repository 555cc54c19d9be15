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

// Impulse and work of dk M (g - alpha v), v: after contact A.
static void book_body_force(const NodeStep& step, double mass, Vec3 v, Vec3 changed, Vec3 after,
                            NodeBooks& books) {
  for (int d = 0; d < 3; ++d) {
    const double impulse = step.kick * mass * (step.gravity[d] - step.damping * changed[d]);
    if (impulse == 0) continue;
    books.sums[static_cast<std::size_t>(StepSums::force_x + d)].add(impulse);
    books.sums[StepSums::force_work].add(impulse * 0.5 * (v[d] + after[d]));
  }
}

// A node on a mirror has no velocity normal to it: its image brings the opposite.
void SolidStep::start_block(const NodeStep& step, int m, int block, NodeBooks& books) {
  Body& body = bodies_[static_cast<std::size_t>(m)];
  std::int64_t* node = body.nodes.sums(block);
  for (int n = 0; n < block_nodes; ++n) to_reals(node + n * lanes, body.units);
  const IntVec3 low = shape_.lower(body.table.block(block));
  if (!boundary_->meets(low, shape_.edge)) return;
  for (int n = 0; n < block_nodes; ++n) {
    const std::array<bool, 3> on = boundary_->on_mirror(node_of(shape_, low, n), m);
    for (int d = 0; d < 3; ++d)
      if (on[static_cast<std::size_t>(d)]) {
        node[n * lanes + 1 + d] = as_bits(0.0);
        if (water_ != nullptr && water_->in(m))
          water_->lanes_of(m).sums(block)[n * lanes + 1 + d] = as_bits(0.0);
      }
  }
  book_mirrored_forces(step, m, block, books);
}

// v* = v + a + dk (f/M - alpha (v + a) + g), a: change by contact A.
void SolidStep::kick_block(const NodeStep& step, int m, int block, BlockImpulses& impulses) {
  std::int64_t* node = bodies_[static_cast<std::size_t>(m)].nodes.sums(block);
  const bool wet = water_ != nullptr && water_->in(m);
  for (int n = 0; n < block_nodes; ++n, node += lanes) {
    if (node[count_lane] == 0) continue;
    NodeImpulses& of = impulses[static_cast<std::size_t>(n)];
    if (wet) {
      water_->kick(step, m, block, n, of, node);
      continue;
    }
    const double mass = as_real(node[0]);
    for (int d = 0; d < 3; ++d) {
      const double v = as_real(node[1 + d]) + of.change[d], f = as_real(node[4 + d]);
      of.push[d] = step.kick * f;
      node[4 + d] = as_bits(v + step.kick * (f / mass - step.damping * v + step.gravity[d]));
    }
  }
}

// K* - K of a node, the work of its forces, and what contact took: each by vb = (v + v*)/2.
static void book_energy(const NodeImpulses& of, double mass, Vec3 v, Vec3 after, bool kicked,
                        BodyEnergySums& body, NodeBooks& books) {
  const Vec3 middle = 0.5 * (v + after);
  body[BodyEnergySums::node_gain].add(0.5 * mass * (dot(after, after) - dot(v, v)));
  body[BodyEnergySums::node_work].add(dot(of.push, middle));
  if (of.met != Vec3{}) {
    books.sums[StepSums::contact_loss].add(-dot(of.met, middle));
    body[BodyEnergySums::contact_slack].add(dot(of.met, after - middle));
  }
  if (!kicked && of.met == Vec3{}) return;
  const Vec3 change = after - v;
  body[BodyEnergySums::kick].add(dot(mass * change - of.push, change));
}

// Along the impulse of contact the velocity of a node is given.
static void keep_met(Body& body, int block, int n, Vec3 impulse, Vec3 after) {
  const Vec3 direction = (1 / std::sqrt(dot(impulse, impulse))) * impulse;
  std::int64_t* met = body.met.sums(block) + n * lanes;
  for (int d = 0; d < 3; ++d) met[d] = as_bits(direction[d]);
  met[3] = as_bits(dot(after, direction));
  met[count_lane] = 1;
}

void SolidStep::finish_block(const NodeStep& step, int m, int block, const BlockImpulses& impulses,
                             NodeBooks& books) {
  Body& body = bodies_[static_cast<std::size_t>(m)];
  const IntVec3 low = shape_.lower(body.table.block(block));
  const bool side = boundary_->meets(low, shape_.edge) && !body.material->rigid;
  const bool booked = exchange_->is_home(body.table, block);
  const bool wet = water_ != nullptr && water_->in(m);
  const bool forced = booked && (step.damping != 0 || step.gravity != Vec3{});
  std::int64_t* node = body.nodes.sums(block);
  for (int n = 0; n < block_nodes; ++n, node += lanes) {
    if (node[count_lane] == 0) continue;
    const double mass = as_real(node[0]);
    const Vec3 v{as_real(node[1]), as_real(node[2]), as_real(node[3])};
    Vec3 after{as_real(node[4]), as_real(node[5]), as_real(node[6])};
    bool image = false, held = false;
    if (side) {
      const IntVec3 at = node_of(shape_, low, n);
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
          held = true;
        }
      }
    }
    const NodeImpulses& of = impulses[static_cast<std::size_t>(n)];
    if (forced && !image) book_body_force(step, mass, v, v + of.change, after, books);
    if (booked && !image)
      book_energy(of, mass, v, after, held || forced, books.bodies[static_cast<std::size_t>(m)],
                  books);
    if (solids_->midpoint() && of.held && of.met != Vec3{}) keep_met(body, block, n, of.met, after);
    for (int d = 0; d < 3; ++d) {
      node[d] = as_bits(after[d] - body.units.reference[d]);
      node[4 + d] = as_bits(after[d] - v[d]);
    }
    node[3] = as_bits(mass);
    if (wet)
      water_->finish(step, *boundary_, m, block, n, node_of(shape_, low, n), side, booked, books);
  }
}

void SolidStep::move_block(const NodeStep& step, int m, int block, MeetingScratch& scratch,
                           NodeBooks& books) {
  if (scratch.impulses.empty()) scratch.impulses.resize(1);
  scratch.impulses.front().fill({});
  start_block(step, m, block, books);
  kick_block(step, m, block, scratch.impulses.front());
  finish_block(step, m, block, scratch.impulses.front(), books);
}

// v* = G x, and v likewise: the velocities of particles do not change. Lanes as finish_block()
// leaves them.
void SolidStep::prescribe(const Matrix3& G, int m, int block) {
  NodeBooks unused;  // what is prescribed is no balance of forces
  unused.bodies.resize(bodies_.size());
  start_block({}, m, block, unused);
  Body& body = bodies_[static_cast<std::size_t>(m)];
  const IntVec3 low = shape_.lower(body.table.block(block));
  std::int64_t* node = body.nodes.sums(block);
  for (int n = 0; n < block_nodes; ++n, node += lanes) {
    if (node[count_lane] == 0) continue;
    const Vec3 x = level_.anchor + to_real(node_of(shape_, low, n)) * level_.spacing;
    const double mass = as_real(node[0]);
    for (int d = 0; d < 3; ++d) {
      const auto row = static_cast<std::size_t>(3 * d);
      const double v = G[row] * x.x + G[row + 1] * x.y + G[row + 2] * x.z;
      node[d] = as_bits(v - body.units.reference[d]);
      node[4 + d] = as_bits(0.0);
    }
    node[3] = as_bits(mass);
  }
}

void NodeBooks::merge(const NodeBooks& other) {
  for (std::size_t s = 0; s < sums.size(); ++s) sums[s].merge(other.sums[s]);
  for (std::size_t k = 0; k < other.given.size(); ++k)
    for (std::size_t d = 0; d < 3; ++d) given[k][d].merge(other.given[k][d]);
  for (std::size_t k = 0; k < other.bodies.size(); ++k) bodies[k].merge(other.bodies[k]);
}

Verdict SolidStep::move_nodes(const StageScope& scope) {
  NodeStep step;
  step.dt = scope.step.dt;
  const bool whole = solids_->whole_kicks || (solids_->full_first_kick && scope.dt_before == 0);
  step.kick = whole ? step.dt : 0.5 * (scope.dt_before + step.dt);
  for (int d = 0; d < 3; ++d)
    if (level_.active[static_cast<std::size_t>(d)]) step.gravity[d] = scene_->constants.gravity[d];
  step.damping = solids_->damping;
  const ThreadTeam& team = *scope.levels.front()->team();
  std::vector<NodeBooks> books(static_cast<std::size_t>(team.size()));
  for (NodeBooks& of : books) {
    of.given.resize(bodies_.size());
    of.bodies.resize(bodies_.size());
  }
  if (prescribed_ != nullptr) {
    const Matrix3 rate = prescribed_->rate(scope.step.time, scope.step.dt);
    for (std::size_t m = 0; m < bodies_.size(); ++m)
      if (!bodies_[m].material->rigid)
        for (int b = 0; b < bodies_[m].table.count(); ++b) prescribe(rate, static_cast<int>(m), b);
  } else {
    if (water_ != nullptr) water_->to_nodes(lend_to_water(scope));
    list_groups();
    for (Body& body : bodies_) {
      body.friction.clear();
      body.met.clear();
      if (any_meets_ && solids_->midpoint()) body.met.fit(body.table);
      // Levels pass it on to each other: there it stands everywhere.
      const bool several = finest_ != coarsest_;
      if (solids_->contact_heats() && (any_meets_ || several)) body.friction.fit(body.table);
    }
    std::vector<MeetingScratch> scratch(static_cast<std::size_t>(team.size()));
    team.for_each(groups_.size(), [&](std::size_t g, int thread) {
      const auto t = static_cast<std::size_t>(thread);
      move_group(step, std::span(members_).subspan(groups_[g].first, groups_[g].second), scratch[t],
                 books[t]);
    });
    book_mirrored_changes(books[0]);
  }
  for (std::size_t n = 1; n < books.size(); ++n) books[0].merge(books[n]);
  kick_ = step.kick;
  fall_ = step.kick * step.gravity;
  sum_transmitted(step, books[0]);
  if (prescribed_ == nullptr) {
    unfold();
    for (int m = 0; m < static_cast<int>(bodies_.size()) && water_ != nullptr; ++m)
      if (water_->in(m)) boundary_->unfold(m, body(m).table, water_->lanes_of(m));
    if (solids_->contact_heats()) unfold_friction();
  }
  if (cohesive_ != nullptr) cohesive_->advance(*boundary_, bodies_, step.dt);
  books_ = std::move(books[0]);
  if (!solids_->midpoint()) book_corner_work(step.dt, books_);
  return Verdict::good;
}

}  // namespace sluice::mpm
