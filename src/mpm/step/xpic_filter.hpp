// The filter of XPIC on one level: what PIC would take from velocities is given back but for what
// the grid cannot hold. SolidLevels::filter_velocities has the formula, and joins the levels.
#pragma once
#include <vector>

#include "mpm/step/body.hpp"
#include "mpm/step/level_nodes.hpp"

namespace sluice::mpm {

class XpicFilter {
 public:
  // Keeps references.
  XpicFilter(const MpmScene& solids, const LevelNodes& nodes, std::vector<Body>& bodies);

  // v_i - v_ref of all nodes in lanes of their own. By body the largest component, of this rank.
  std::vector<double> take_velocities();
  // The first term of the filter.
  void begin(std::span<const double> most);
  // Nodes to particles and back. The first time, S v_i of each particle is kept where its new
  // velocity will stand.
  void sum(std::span<const BlockWork> work, bool first);
  // Once ranks and levels agree on the sums: velocities of the pass.
  void finish();
  // Adds the velocities in hand, times a factor, to the lanes of dv.
  void add(double factor);

  NodeLanes& velocities(int body) { return velocities_[static_cast<std::size_t>(body)]; }
  NodeLanes& sums(int body) { return sums_[static_cast<std::size_t>(body)]; }

 private:
  struct Scratch;
  void pass(const BlockWork& work, bool first, bool shared, Scratch& scratch);

  const MpmScene* solids_;
  const LevelNodes* nodes_;
  std::vector<Body>* bodies_;
  std::vector<NodeLanes> velocities_, sums_;  // by body
  std::vector<SumUnits> units_;
};

}  // namespace sluice::mpm
