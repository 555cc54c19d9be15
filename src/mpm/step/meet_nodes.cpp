// Blocks of nodes that several bodies have: contact before and after forces, mpm_scheme, section 6.
#include <algorithm>

#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {

// Groups of blocks of several bodies at one place; a block alone is a group of its own.
void SolidStep::list_groups() {
  members_.clear();
  groups_.clear();
  const int count = static_cast<int>(bodies_.size());
  const auto table = [&](int m) -> const BlockTable& {
    return bodies_[static_cast<std::size_t>(m)].table;
  };
  const auto meets = [&](int m) { return contact_ != nullptr && contact_->takes(m); };
  for (int m = 0; m < count; ++m) {
    if (!meets(m) && solids_->materials[static_cast<std::size_t>(m)].rigid) continue;
    for (int b = 0; b < table(m).count(); ++b) {
      const IntVec3 block = table(m).block(b);
      bool earlier = false;  // a body before it has listed the block
      for (int k = 0; k < m && meets(m) && !earlier; ++k)
        earlier = meets(k) && table(k).find(block) >= 0;
      if (earlier) continue;
      const std::size_t first = members_.size();
      members_.push_back({m, b});
      for (int k = m + 1; k < count && meets(m); ++k) {
        const int other = meets(k) ? table(k).find(block) : -1;
        if (other >= 0) members_.push_back({k, other});
      }
      groups_.emplace_back(first, members_.size() - first);
    }
  }
}

bool SolidStep::meets(std::span<const BlockMember> members) const {
  return contact_ != nullptr &&
         std::any_of(members.begin(), members.end(), [&](const BlockMember& b) {
           const std::vector<char>& of_body = bodies_[static_cast<std::size_t>(b.body)].meets;
           const auto block = static_cast<std::size_t>(b.block);  // others came later, without mass
           return contact_->takes(b.body) && block < of_body.size() && of_body[block] != 0;
         });
}

void SolidStep::move_group(const NodeStep& step, std::span<const BlockMember> members,
                           MeetingScratch& scratch, NodeBooks& books) {
  const auto rigid = [&](const BlockMember& b) {
    return solids_->materials[static_cast<std::size_t>(b.body)].rigid;
  };
  if (!meets(members)) {
    for (const BlockMember& b : members)
      if (!rigid(b)) move_block(step, b.body, b.block, scratch, books);
    return;
  }
  scratch.work.fill(0);
  scratch.impulses.resize(std::max(scratch.impulses.size(), members.size()));
  for (std::size_t k = 0; k < members.size(); ++k) {
    scratch.impulses[k].fill({});
    start_block(step, members[k].body, members[k].block, books);
  }
  meet(step, members, Hook::before_forces, scratch, books);
  for (std::size_t k = 0; k < members.size(); ++k)
    if (!rigid(members[k]))
      kick_block(step, members[k].body, members[k].block, scratch.impulses[k]);
  meet(step, members, Hook::after_forces, scratch, books);
  for (std::size_t k = 0; k < members.size(); ++k)
    if (!rigid(members[k]))
      finish_block(step, members[k].body, members[k].block, scratch.impulses[k], books);
  if (solids_->contact_heats()) keep_friction_heat(members, scratch);
}

// The bodies with mass at node n of a block; false: no rule can act.
bool SolidStep::gather(std::span<const BlockMember> members, int n, IntVec3 at, bool side,
                       Hook hook, ContactNode& meeting) const {
  meeting.bodies.clear();
  meeting.outside = {};
  bool leads = false;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const auto [m, block] = members[k];
    const Body& body = bodies_[static_cast<std::size_t>(m)];
    const std::int64_t* node = body.nodes.sums(block) + n * lanes;
    if (node[count_lane] == 0 || (side && boundary_->is_image(at, m))) continue;
    leads = leads || contact_->leads(m);
    AtNode b;
    b.body = m;
    b.member = static_cast<int>(k);
    b.rigid = body.material->rigid;
    b.mass = as_real(node[0]);
    b.before = {as_real(node[1]), as_real(node[2]), as_real(node[3])};
    b.v = b.before;
    const MasterMotion* motion = b.rigid ? contact_->motion_of(m) : nullptr;
    if (motion != nullptr) b.v = motion->at(meeting.place);
    if (!b.rigid && hook == Hook::after_forces)
      b.v = {as_real(node[4]), as_real(node[5]), as_real(node[6])};
    if (contact_->needs_surfaces()) {
      SurfaceAtNode s = surface_at(body.surfaces.sums(block) + n * lanes, surface_units_);
      if (side) {
        const std::array<bool, 3> on = boundary_->on_mirror(at, m);
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

// One hook of contact on all nodes of a block. Loss of both: D_c = W - sum J . vb, J: impulses of
// both hooks, vb = (v_i + v*)/2 (known when the block is finished), W: work of what acts from
// outside.
void SolidStep::meet(const NodeStep& step, std::span<const BlockMember> members, Hook hook,
                     MeetingScratch& scratch, NodeBooks& books) {
  const Body& first = bodies_[static_cast<std::size_t>(members.front().body)];
  const int first_block = members.front().block;
  const IntVec3 low = shape_.lower(first.table.block(first_block));
  const bool side = boundary_->meets(low, shape_.edge);
  const bool booked = exchange_->is_home(first.table, first_block);
  ContactNode& meeting = scratch.meeting;
  meeting.cell_volume = level_.cell_volume();
  for (int n = 0; n < block_nodes; ++n) {
    const IntVec3 at = node_of(shape_, low, n);
    meeting.place = level_.anchor + to_real(at) * level_.spacing;
    if (!gather(members, n, at, side, hook, meeting)) continue;
    contact_->act(hook, meeting);
    OutsideBudget& outside = meeting.outside;
    Vec3 given{};
    const AtNode* giver = nullptr;  // that transmits forces
    const bool held =
        std::any_of(meeting.bodies.begin(), meeting.bodies.end(), [&](const AtNode& b) {
          return b.rigid || contact_->leads(b.body) || contact_->joins(b.body);
        });
    for (const AtNode& b : meeting.bodies) {
      if (b.rigid) {
        if (giver == nullptr && transmits(b.body)) giver = &b;
        continue;
      }
      const auto [m, block] = members[static_cast<std::size_t>(b.member)];
      std::int64_t* node = bodies_[static_cast<std::size_t>(m)].nodes.sums(block) + n * lanes;
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
      if (value != 0) books.sums[static_cast<std::size_t>(sum)].add(value);
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
