#include "framework/run/levels/level_ghosts.hpp"

#include <utility>

#include "framework/base/reduction.hpp"

namespace sluice {

LevelGhosts::LevelGhosts(const StateFacet& component, LevelStates& states, Communicator& ranks,
                         std::shared_ptr<const ThreadTeam> team)
    : component_(&component), states_(&states), ranks_(&ranks), team_(std::move(team)) {
  lay_out();
}

void LevelGhosts::lay_out() {
  halo_ = std::make_unique<HaloExchange>(states_->level(), states_->width(), ranks_->rank(),
                                         LevelStates::arrays);
  filled_ = false;
}

// All ranks come here together: they fill the same levels in the same order.
void LevelGhosts::sum_for_boundary() {
  const std::size_t count = component_->boundary_sums();
  if (count == 0) return;
  std::vector<ExactSum> local(count);
  component_->add_boundary_sums(states_->present(), local);
  Reduction all;
  std::vector<Reduction::Sum> slots;
  for (const ExactSum& sum : local) slots.push_back(all.add_sum(sum));
  ranks_->reduce(all);
  boundary_sums_.clear();
  for (const Reduction::Sum slot : slots) boundary_sums_.push_back(all.sum(slot).value());
}

void LevelGhosts::fill(double time, const std::function<void(Warehouse&)>& interface,
                       const LevelGhosts* coarsest) {
  if (filled_) return;
  Warehouse& state = states_->present();
  halo_->run(state, states_->slots(), team_.get());
  if (interface) interface(state);
  if (coarsest == nullptr) sum_for_boundary();
  component_->fill_boundary(
      state, time, coarsest == nullptr ? boundary_sums_ : coarsest->boundary_sums_, *team_);
  filled_ = true;
}

void LevelGhosts::fill_work(Label label) {
  Warehouse& state = states_->present();
  int slot = 0;
  while (state.info(slot).label != label) ++slot;
  exchange(slot);
  component_->fill_work_boundary(state, label, *team_);
}

void LevelGhosts::exchange(int slot) {
  halo_->run(states_->present(), {slot}, team_.get());
}

}  // namespace sluice
