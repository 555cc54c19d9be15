// The particles of one kind on all levels: a set for each box of this rank.
#pragma once
#include <functional>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/particle/block_order.hpp"
#include "framework/particle/particle_map.hpp"
#include "framework/particle/particle_set.hpp"

namespace sluice {

class ParticleStore {
 public:
  // `by_blocks`: sets are kept in blocks of cells (block_order.hpp), else by cell and id.
  ParticleStore(std::size_t attributes, int rank, bool by_blocks = false)
      : attributes_(attributes), rank_(rank), by_blocks_(by_blocks) {}

  // Boxes as the map has them (which must outlive this): sets are made anew; where there were
  // particles before, they wait for settle().
  void lay_out(const ParticleMap& map);

  bool by_blocks() const { return by_blocks_; }
  void clear();  // no particles, no boxes

  int level_count() const { return static_cast<int>(sets_.size()); }
  // Local boxes of a level, numbered as a Warehouse does.
  int box_count(int level) const { return static_cast<int>(at(level).size()); }
  const GridBox& box(int level, int local) const;
  ParticleSet& set(int level, int local) { return at(level)[local].set; }
  const ParticleSet& set(int level, int local) const { return at(level)[local].set; }
  // What a step makes of a set, until it is accepted; and the blocks of a set in blocks.
  ParticleSet& next(int level, int local) { return at(level)[local].next; }
  const ParticleSet& next(int level, int local) const { return at(level)[local].next; }
  const std::vector<BlockRun>& runs(int level, int local) const { return at(level)[local].runs; }
  // The order of a set by cell and id.
  std::vector<std::uint32_t> order_by_cell(int level, int local) const;
  ParticleSet empty_set() const { return ParticleSet(attributes_); }

  // Adds a particle whose home is a box of this rank; others are none of its business.
  void adopt(const ParticleSet& from, std::size_t n);
  // Every particle to the box in which it lives now. Positions must lie in the domain. Collective.
  void settle(Communicator& communicator);

  std::int64_t count() const;  // on this rank

 private:
  struct Box {
    int id = 0;
    ParticleSet set;
    ParticleSet next;
    std::vector<BlockRun> runs;
  };
  std::vector<Box>& at(int level) { return sets_[level]; }
  const std::vector<Box>& at(int level) const { return sets_[level]; }
  ParticleSet& home_of(const ParticleMap::Home& home);
  ParticleMap::Home find(Vec3 point, std::int64_t id) const;
  void sort(int level, Box& box) const;
  std::vector<std::uint32_t> by_cell(int level, const Box& box) const;

  std::size_t attributes_;
  int rank_;
  bool by_blocks_;
  const ParticleMap* map_ = nullptr;
  std::vector<std::vector<Box>> sets_;    // by level, local box
  std::vector<std::vector<int>> locals_;  // by level, box id: its local number
  std::vector<int> neighbours_;           // ranks to which particles go in a step
  ParticleSet homeless_;
};

}  // namespace sluice
