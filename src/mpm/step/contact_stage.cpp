#include "mpm/step/contact_stage.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/transmitted_forces.hpp"

namespace sluice::mpm {

ContactStage::ContactStage(const MpmScene& solids, const LevelNodes& nodes,
                           std::vector<Body>& bodies)
    : solids_(&solids),
      nodes_(&nodes),
      bodies_(&bodies),
      contact_(solids, nodes.level),
      blocks_(contact_),
      surfaces_(solids, contact_, nodes),
      held_(solids.midpoint() ? solids.materials.size() : 0) {}

void ContactStage::find_meetings(std::span<const BlockWork> work,
                                 std::span<const SharedBlocks> shared) {
  blocks_.find(*bodies_);
  if (blocks_.any() && contact_.needs_surfaces()) surfaces_.gather(blocks_, *bodies_, work, shared);
}

void ContactStage::begin_held() {
  for (std::size_t m = 0; m < held_.size(); ++m) {
    held_[m].clear();
    if (blocks_.any()) held_[m].fit((*bodies_)[m].table);
  }
}

void ContactStage::move(const NodeStep& step, std::span<const BlockMember> group,
                        const NodeUpdate& update, FrictionHeat* heat, MeetingScratch& scratch,
                        NodeBooks& books) {
  const auto rigid = [&](const BlockMember& b) {
    return (*bodies_)[static_cast<std::size_t>(b.body)].material->rigid;
  };
  scratch.impulses.resize(std::max(scratch.impulses.size(), group.size()));
  if (!blocks_.meets(group)) {
    for (const BlockMember& b : group)
      if (!rigid(b)) update.move(step, b, scratch.impulses.front(), books);
    return;
  }
  scratch.work.fill(0);
  for (std::size_t k = 0; k < group.size(); ++k) {
    scratch.impulses[k].fill({});
    update.start(step, group[k], books);
  }
  meet(step, group, Hook::before_forces, scratch, books);
  for (std::size_t k = 0; k < group.size(); ++k)
    if (!rigid(group[k])) update.kick(step, group[k], scratch.impulses[k]);
  meet(step, group, Hook::after_forces, scratch, books);
  for (std::size_t k = 0; k < group.size(); ++k) {
    if (rigid(group[k])) continue;
    if (!held_.empty()) keep_held(group[k], scratch.impulses[k]);
    update.finish(step, group[k], scratch.impulses[k], books);
  }
  if (heat != nullptr) heat->keep(group, scratch.impulses, scratch.work);
}

// Along the impulse of contact the velocity of a node is given: that with which it will leave the
// step.
void ContactStage::keep_held(BlockMember of, const BlockImpulses& impulses) {
  const Body& body = (*bodies_)[static_cast<std::size_t>(of.body)];
  const NodeBoundary& boundary = *nodes_->boundary;
  const IntVec3 low = nodes_->lower(body.table, of.block);
  const bool side = boundary.meets(low, nodes_->shape.edge);
  const std::int64_t* node = body.nodes.sums(of.block);
  std::int64_t* held = held_[static_cast<std::size_t>(of.body)].sums(of.block);
  for (int n = 0; n < block_nodes; ++n, node += lanes, held += lanes) {
    const NodeImpulses& got = impulses[static_cast<std::size_t>(n)];
    if (node[count_lane] == 0 || !got.held || got.met == Vec3{}) continue;
    Vec3 after{as_real(node[4]), as_real(node[5]), as_real(node[6])};
    const IntVec3 at = node_of(nodes_->shape, low, n);
    if (side && !boundary.is_image(at, of.body)) {
      const GivenVelocity given = boundary.at(at, of.body);
      for (int d = 0; d < 3; ++d)
        if (given.given[static_cast<std::size_t>(d)]) after[d] = given.value[d];
    }
    const Vec3 direction = (1 / std::sqrt(dot(got.met, got.met))) * got.met;
    for (int d = 0; d < 3; ++d) held[d] = as_bits(direction[d]);
    held[3] = as_bits(dot(after, direction));
    held[count_lane] = 1;
  }
}

// The bodies with mass at node n of a block; false: no rule can act.
bool ContactStage::gather(std::span<const BlockMember> group, int n, IntVec3 at, bool side,
                          Hook hook, ContactNode& meeting) const {
  meeting.bodies.clear();
  meeting.outside = {};
  bool leads = false;
  for (std::size_t k = 0; k < group.size(); ++k) {
    const auto [m, block] = group[k];
    const Body& body = (*bodies_)[static_cast<std::size_t>(m)];
    const std::int64_t* node = body.nodes.sums(block) + n * lanes;
    if (node[count_lane] == 0 || (side && nodes_->boundary->is_image(at, m))) continue;
    leads = leads || contact_.leads(m);
    AtNode b;
    b.body = m;
    b.member = static_cast<int>(k);
    b.rigid = body.material->rigid;
    b.mass = as_real(node[0]);
    b.before = {as_real(node[1]), as_real(node[2]), as_real(node[3])};
    b.v = b.before;
    const MasterMotion* motion = b.rigid ? contact_.motion_of(m) : nullptr;
    if (motion != nullptr) b.v = motion->at(meeting.place);
    if (!b.rigid && hook == Hook::after_forces)
      b.v = {as_real(node[4]), as_real(node[5]), as_real(node[6])};
    if (contact_.needs_surfaces()) {
      SurfaceAtNode s = surfaces_.at(group[k], n);
      if (side) {
        const std::array<bool, 3> on = nodes_->boundary->on_mirror(at, m);
        for (int d = 0; d < 3; ++d)
          if (on[static_cast<std::size_t>(d)]) s.gradient[d] = s.place[d] = 0;
      }
      b.volume = s.volume;
      b.gradient = s.gradient;
      b.place = s.place;
    }
    meeting.bodies.push_back(b);
  }
  return meeting.bodies.size() > 1 || leads;
}

// The first body of a meeting that transmits forces.
const AtNode* ContactStage::giver_of(const ContactNode& meeting) const {
  for (const AtNode& b : meeting.bodies)
    if (b.rigid && transmits_forces(solids_->materials[static_cast<std::size_t>(b.body)],
                                    contact_.motion_of(b.body)))
      return &b;
  return nullptr;
}

Vec3 ContactStage::take(std::span<const BlockMember> group, int n, Hook hook,
                        MeetingScratch& scratch) const {
  const std::vector<AtNode>& met = scratch.meeting.bodies;
  const bool held = std::any_of(met.begin(), met.end(), [&](const AtNode& b) {
    return b.rigid || contact_.leads(b.body) || contact_.joins(b.body);
  });
  Vec3 given{};
  for (const AtNode& b : met) {
    if (b.rigid) continue;
    const auto [m, block] = group[static_cast<std::size_t>(b.member)];
    std::int64_t* node = (*bodies_)[static_cast<std::size_t>(m)].nodes.sums(block) + n * lanes;
    NodeImpulses& of =
        scratch.impulses[static_cast<std::size_t>(b.member)][static_cast<std::size_t>(n)];
    if (hook == Hook::before_forces) {
      of.change = b.v - b.before;
      continue;
    }
    const Vec3 kicked{as_real(node[4]), as_real(node[5]), as_real(node[6])};
    of.met = b.mass * (of.change + (b.v - kicked));
    of.held = held;
    given += of.met;
    for (int d = 0; d < 3; ++d) node[4 + d] = as_bits(b.v[d]);
  }
  return given;
}

// One hook of contact on all nodes of a block.
void ContactStage::meet(const NodeStep& step, std::span<const BlockMember> group, Hook hook,
                        MeetingScratch& scratch, NodeBooks& books) const {
  const Body& first = (*bodies_)[static_cast<std::size_t>(group.front().body)];
  const IntVec3 low = nodes_->lower(first.table, group.front().block);
  const bool side = nodes_->boundary->meets(low, nodes_->shape.edge);
  const bool booked = nodes_->booked(first.table, group.front().block);
  ContactNode& meeting = scratch.meeting;
  meeting.cell_volume = nodes_->level.cell_volume();
  for (int n = 0; n < block_nodes; ++n) {
    const IntVec3 at = node_of(nodes_->shape, low, n);
    meeting.place = nodes_->place(at);
    if (!gather(group, n, at, side, hook, meeting)) continue;
    contact_.act(hook, meeting);
    OutsideBudget& outside = meeting.outside;
    const AtNode* giver = giver_of(meeting);
    const Vec3 given = take(group, n, hook, scratch);
    scratch.work[static_cast<std::size_t>(n)] += outside.work;
    if (!booked) continue;
    if (giver != nullptr && hook == Hook::after_forces)
      for (int d = 0; d < 3; ++d)
        if (given[d] != 0)
          books.given[static_cast<std::size_t>(giver->body)][static_cast<std::size_t>(d)].add(
              given[d]);
    if (giver != nullptr) {  // both stay among the bodies
      outside.impulse = {};
      outside.work = 0;
    }
    const auto add = [&](int sum, double value) {
      if (value != 0) books.add(sum, value);
    };
    for (int d = 0; d < 3; ++d) {
      add(StepSums::impulse_x + d, outside.impulse[d]);
      add(StepSums::reaction_x + d, outside.reaction[d] / step.kick);
      add(StepSums::torque_x + d, outside.torque[d] / step.kick);
    }
    add(StepSums::work, outside.work);
    add(StepSums::contact_loss, outside.work);
  }
}

}  // namespace sluice::mpm
