#include "framework/run/levels/ghosts_in_time.hpp"

#include <algorithm>

namespace sluice {

GhostsInTime::GhostsInTime(const Scene& scene, const Component& component, Levels& levels)
    : scene_(&scene),
      component_(&component),
      levels_(&levels),
      done_(levels.possible(), 0),
      ends_(levels.possible(), 0.0) {}

void GhostsInTime::begin() {
  std::fill(done_.begin(), done_.end(), 0);
}

void GhostsInTime::note_advance(int l, double end) {
  const std::size_t n = l;
  ends_[n] = end;
  if (n > 0) ++done_[n];
  if (n + 1 < done_.size()) done_[n + 1] = 0;
}

// Where the present state of a level stands between the two states of the next coarser one. Outside
// a coarse step, and before the coarser level has advanced in it, both levels are at its end.
double GhostsInTime::share_of(int l) const {
  return advancing_ ? static_cast<double>(done_[l]) / levels_->substeps(l) : 1.0;
}

void GhostsInTime::fill(int l, double time) {
  LevelSolver& solver = (*levels_)[l];
  if (l == 0) {
    solver.fill_ghosts(time);
    return;
  }
  const auto interface = [&](Warehouse& state) {
    LevelSolver& coarser = (*levels_)[l - 1];
    const double share = share_of(l);
    // Its new state stands at the end of its own step; the old one was filled when it was swept.
    if (share > 0) fill(l - 1, advancing_ ? ends_[l - 1] : time);
    const Warehouse* before = share < 1 ? &coarser.states().previous() : nullptr;
    const Warehouse* after = share > 0 ? &coarser.state() : nullptr;
    levels_->interface(l - 1)->ghosts.run(before, after, share, state, solver.state_slots(),
                                          component_->levels().transfer(),
                                          scene_->refinement.interface_order, solver.team());
  };
  solver.fill_ghosts(time, interface, &(*levels_)[0]);
}

void GhostsInTime::fill_all(double time) {
  for (int l = 0; l < levels_->count(); ++l) fill(l, time);
}

}  // namespace sluice
