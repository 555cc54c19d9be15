// A deck's gas, run in this process through all its levels.
#pragma once
#include <memory>
#include <string>

#include "framework/run/hierarchy.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/classic/classic_test_support.hpp"

namespace sluice::ice {

class DeckRun {
 public:
  // Throws InputError with the first fault of the deck.
  explicit DeckRun(const std::string& text, IntVec3 boxes = {}, int threads = 1) {
    Schema schema;
    add_framework_tags(schema);
    add_ice_tags(schema);
    deck_ = load_deck_text(text, "box.ups", {}, schema);
    std::vector<Fault> faults = deck_.faults;
    SceneOptions scene_options;
    scene_options.boxes = boxes;
    if (deck_.good()) scene_ = read_scene(deck_, scene_options, faults);
    IceScene ice_scene;
    if (!any_error(faults)) ice_scene = read_ice_scene(deck_, scene_, faults);
    for (const Fault& f : faults)
      if (f.severity == Severity::error) throw InputError(to_string(f));
    ice_ = std::make_unique<Ice>(scene_, std::move(ice_scene));
    SolverOptions options;
    options.threads = threads;
    hierarchy_ = std::make_unique<Hierarchy>(scene_, *ice_, world(), options);
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
  double limit() const { return hierarchy_->step_limit().dt; }
  Hierarchy& hierarchy() { return *hierarchy_; }
  const Hierarchy& hierarchy() const { return *hierarchy_; }
  const Ice& ice() const { return *ice_; }
  const Level& level() const { return scene_.grid.levels.front(); }

 private:
  Deck deck_;
  Scene scene_;
  std::unique_ptr<Ice> ice_;
  std::unique_ptr<Hierarchy> hierarchy_;
  std::shared_ptr<RunControl> control_ = shared_control();
  EventLedger ledger_;
  double time_ = 0;
  int step_ = 0;
};

}  // namespace sluice::ice
