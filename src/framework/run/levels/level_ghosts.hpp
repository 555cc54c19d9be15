// Ghost cells of a level: those that other boxes fill, those at the interface with a coarser level,
// those outside the domain.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/run/levels/level_states.hpp"
#include "framework/task/halo.hpp"
#include "framework/task/thread_team.hpp"

namespace sluice {

class LevelGhosts {
 public:
  LevelGhosts(const StateFacet& component, LevelStates& states, Communicator& ranks,
              std::shared_ptr<const ThreadTeam> team);

  // Fills all ghost cells of the present state, unless it was done already. `interface`, where
  // given, fills those at the interface with a coarser level, before the boundary of the domain;
  // `coarsest`, of a finer level: whose boundary sums hold.
  void fill(double time, const std::function<void(Warehouse&)>& interface,
            const LevelGhosts* coarsest);
  // The present state was changed, or is another one: ghosts are to be filled anew.
  void mark_stale() { filled_ = false; }
  // The boxes are others.
  void lay_out();
  // Ghosts of a work slot (StateFacet::work_slots), by copies and at the sides of the domain.
  void fill_work(Label label);
  // Ghosts of one slot, by copies alone.
  void exchange(int slot);

 private:
  void sum_for_boundary();

  const StateFacet* component_;
  LevelStates* states_;
  Communicator* ranks_;
  std::shared_ptr<const ThreadTeam> team_;
  std::unique_ptr<HaloExchange> halo_;
  std::vector<double> boundary_sums_;  // of the coarsest level, as its ghosts were filled last
  bool filled_ = false;
};

}  // namespace sluice
