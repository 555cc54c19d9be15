// Where bodies meet: blocks of nodes that several of them have, and those among them at which
// rules of contact may act (mpm_scheme, section 6).
//
// What all ranks agree upon of masses tells at which nodes two bodies meet. Alone a body costs what
// it costs without rules.
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "mpm/contact/contact.hpp"
#include "mpm/step/body.hpp"
#include "mpm/step/node_step.hpp"

namespace sluice::mpm {

// Blocks of several bodies at one place; a block alone is a group of its own.
class BlockGroups {
 public:
  std::size_t count() const { return first_.size(); }
  std::span<const BlockMember> operator[](std::size_t n) const {
    const std::size_t end = n + 1 < first_.size() ? first_[n + 1] : members_.size();
    return std::span(members_).subspan(first_[n], end - first_[n]);
  }
  void clear();
  void begin_group() { first_.push_back(members_.size()); }
  void add(BlockMember member) { members_.push_back(member); }

 private:
  std::vector<BlockMember> members_;  // group after group
  std::vector<std::size_t> first_;    // member of each group
};

// Each block of bodies that move alone, without rules.
void list_single_blocks(std::span<const Body> bodies, BlockGroups& groups);

class MeetingBlocks {
 public:
  explicit MeetingBlocks(const Contact& contact) : contact_(&contact) {}

  // With several ranks each that has a block of one body must learn of all bodies there.
  void unite(std::span<Body> bodies) const;
  // Marks blocks with a node at which several bodies have mass, or one whose rule acts on it alone.
  void find(std::span<const Body> bodies);
  // Of any block of this rank.
  bool any() const { return any_; }
  // By block of a body: contact may act at one of its nodes.
  const std::vector<char>& marks(int body) const { return marks_[static_cast<std::size_t>(body)]; }
  // May rules act in one of these blocks.
  bool meets(std::span<const BlockMember> members) const;
  void list_groups(std::span<const Body> bodies, BlockGroups& groups) const;

 private:
  void mark(BlockMember of);

  const Contact* contact_;
  std::vector<std::vector<char>> marks_;  // by body and block
  bool any_ = false;
};

}  // namespace sluice::mpm
