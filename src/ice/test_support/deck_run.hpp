// A deck's gas, run in this process through all its levels.
#pragma once
#include <memory>
#include <string>

#include "framework/run/levels/hierarchy.hpp"
#include "ice/test_support/classic.hpp"

namespace sluice::ice {

class DeckRun {
 public:
  // Throws InputError with the first error of the deck.
  explicit DeckRun(const std::string& text, IntVec3 boxes = {}, int threads = 1)
      : scene_(text, boxes) {
    SolverOptions options;
    options.threads = threads;
    hierarchy_ = std::make_unique<Hierarchy>(scene_.scene, ice(), world(), options);
    hierarchy_->initialise();
  }

  // One coarse step, and the levels that it asks for; false, and nothing of it, if it is rejected.
  bool attempt(double dt) {
    if (!hierarchy_->attempt(step_ + 1, time_, dt, {}, *control_, ledger_).good) {
      hierarchy_->reject();
      return false;
    }
    hierarchy_->accept();
    time_ += dt;
    hierarchy_->regrid(++step_);
    return true;
  }
  double time() const { return time_; }
  double limit() const { return hierarchy_->rates().limit().dt; }
  Hierarchy& hierarchy() { return *hierarchy_; }
  const Hierarchy& hierarchy() const { return *hierarchy_; }
  const Ice& ice() const { return *scene_.ice; }
  const Level& level() const { return scene_.scene.grid.levels.front(); }

 private:
  DeckScene scene_;
  std::unique_ptr<Hierarchy> hierarchy_;
  std::shared_ptr<RunControl> control_ = shared_control();
  EventLedger ledger_;
  double time_ = 0;
  int step_ = 0;
};

}  // namespace sluice::ice
