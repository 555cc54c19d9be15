// Nodes that several bodies have: contact before and after forces, mpm_scheme, section 6.
//
// Rules act on the velocities of all bodies of a node. What friction and impacts take of their
// kinetic energy is D_c = W - sum J . vb: J, impulses of both hooks, vb = (v_i + v*)/2 (known when
// the block is finished), W, work of what acts from outside.
#pragma once
#include <vector>

#include "framework/task/schedule.hpp"
#include "mpm/step/body_surfaces.hpp"
#include "mpm/step/friction_heat.hpp"
#include "mpm/step/node_update.hpp"

namespace sluice::mpm {

// What one thread keeps of the blocks of a group from hook to hook; work: of contact, from outside.
struct MeetingScratch {
  ContactNode meeting;
  std::vector<BlockImpulses> impulses;  // by member
  std::array<double, block_nodes> work{};
};

class ContactStage {
 public:
  // Keeps references.
  ContactStage(const MpmScene& solids, const LevelNodes& nodes, std::vector<Body>& bodies);
  ContactStage(const ContactStage&) = delete;  // its parts refer to each other
  ContactStage& operator=(const ContactStage&) = delete;

  void begin_step(const StepScope& step) { contact_.begin_step(step.time, step.dt); }
  const Contact& rules() const { return contact_; }
  // Before particles give to nodes.
  void begin_sums() { surfaces_.clear(); }
  // Before ranks share the sums of nodes, where there are several.
  void unite_blocks() const { blocks_.unite(*bodies_); }
  // After it; `shared`: what they sent, by body.
  void find_meetings(std::span<const BlockWork> work, std::span<const SharedBlocks> shared);
  const BodySurfaces& surfaces() const { return surfaces_; }
  const MeetingBlocks& blocks() const { return blocks_; }

  // The step of all bodies on the nodes of a group of blocks. `heat`: null, or where what contact
  // takes goes.
  void move(const NodeStep& step, std::span<const BlockMember> group, const NodeUpdate& update,
            FrictionHeat* heat, MeetingScratch& scratch, NodeBooks& books);
  // Where contact holds a body: its direction, v* along it, as the midpoint transfer asks it.
  void begin_held();
  const NodeLanes& held(int body) const { return held_[static_cast<std::size_t>(body)]; }

 private:
  bool gather(std::span<const BlockMember> group, int n, IntVec3 at, bool side, Hook hook,
              ContactNode& meeting) const;
  void meet(const NodeStep& step, std::span<const BlockMember> group, Hook hook,
            MeetingScratch& scratch, NodeBooks& books) const;
  // Of what the rules left in the meeting: to the nodes, and the sum of the impulses.
  Vec3 take(std::span<const BlockMember> group, int n, Hook hook, MeetingScratch& scratch) const;
  const AtNode* giver_of(const ContactNode& meeting) const;
  void keep_held(BlockMember of, const BlockImpulses& impulses);

  const MpmScene* solids_;
  const LevelNodes* nodes_;
  std::vector<Body>* bodies_;
  Contact contact_;
  MeetingBlocks blocks_;
  BodySurfaces surfaces_;
  std::vector<NodeLanes> held_;  // by body; none: the transfer does not ask
};

}  // namespace sluice::mpm
