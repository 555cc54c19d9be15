#include "framework/run/levels/balancing.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "framework/run/levels/load_balance.hpp"

namespace sluice {

bool Balancing::balance(int step) {
  // Coarse steps: enough to measure, rare enough to cost nothing. The first look (next_) is early,
  // for solids that lie in a few boxes.
  constexpr int interval = 50;
  if (communicator_->size() == 1 || step < next_) return false;
  next_ = step + interval;
  const auto start = std::chrono::steady_clock::now();
  int moved = levels_->count();  // the first level with boxes that moved
  for (int l = 0; l < levels_->count(); ++l) {
    std::vector<GridBox> boxes =
        rebalanced((*levels_)[l], particles_, scene_->refinement.balance_gain, *communicator_);
    if (boxes.empty()) continue;
    levels_->lay_out(l, std::move(boxes), false);
    moved = std::min(moved, l);
  }
  const bool any = moved < levels_->count();
  if (any) {
    for (int l = std::max(0, moved - 1); l + 1 < levels_->count(); ++l) levels_->make_interface(l);
    levels_->connect(moved);
    if (particles_ != nullptr) particles_->follow(levels_->existing());
    ++count_;
  }
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return any;
}

void Balancing::succeed(const Balancing& earlier) {
  next_ = earlier.next_;
  count_ = earlier.count_;
  seconds_ = earlier.seconds_;
}

}  // namespace sluice
