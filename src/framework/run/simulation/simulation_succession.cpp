// A run in which one component takes over from another.
#include <fmt/format.h>

#include "framework/base/json.hpp"
#include "framework/run/simulation/simulation.hpp"

namespace sluice {
namespace {

SolverOptions solver_options(const RunOptions& o) {
  SolverOptions s;
  s.threads = o.threads;
  s.force_all = o.force_all;
  s.sample_every = 61;
  s.block = o.block;
  s.max_box_cells = o.max_box_cells;
  return s;
}

}  // namespace

bool Simulation::is_next_due() const {
  return running_ < options_.successors.size() &&
         options_.successors[running_].after <= time_.state().step;
}

// Levels without a state.
std::unique_ptr<Hierarchy> Simulation::empty_hierarchy(const Scene& scene,
                                                       const Component& component) const {
  return std::make_unique<Hierarchy>(scene, component, *communicator_, solver_options(options_));
}

// All that the run keeps of its component, but for the state.
void Simulation::turn_to(std::size_t number) {
  const Successor& next = options_.successors[number - 1];
  running_ = number;
  scene_ = next.scene;
  component_ = next.component;
  time_.take_limits(scene_->time);
  hierarchy_ = empty_hierarchy(*scene_, *component_);
  analysis_ = std::make_unique<AnalysisRecorder>(*scene_, *hierarchy_, *communicator_);
}

// The component that wrote a checkpoint reads it.
void Simulation::turn_to_component_of(const std::map<std::string, std::string>& kept) {
  const auto found = kept.find("component");
  if (found == kept.end() || options_.successors.empty()) return;
  const auto number = Json::parse(found->second).get<std::size_t>();
  if (number > options_.successors.size())
    throw InputError(
        fmt::format("the checkpoint is of component {} of a run, and the deck has {}: a restart "
                    "continues with the same components",
                    number + 1, options_.successors.size() + 1));
  if (number > 0) turn_to(number);
}

// What a later component cannot save must not end the run when its turn comes.
void Simulation::check_saves_of_successors() const {
  for (const Successor& next : options_.successors)
    sort_saves(next.scene->output, *empty_hierarchy(*next.scene, *next.component));
}

// After a step, its outputs and its checkpoint, which are those of the component that made it. The
// step to come is the first of the next one: as after a restart, but for nothing on disk.
void Simulation::hand_over() {
  const Component& before = *component_;
  const std::unique_ptr<Hierarchy> earlier = std::move(hierarchy_);
  turn_to(running_ + 1);
  hierarchy_->succeed(*earlier);
  if (output_ != nullptr) output_->follow(*scene_, *component_, *hierarchy_, analysis_.get());
  // Totals are of the same particles: what has been booked until now stays.
  set_totals(false);
  limit_ = hierarchy_->rates().limit();
  time_.remember_physics_dt(limit_.dt);
  EventPlace place;
  place.step = time_.state().step;
  place.task = fmt::format("{} -> {}", before.name(), component_->name());
  place.value = time_.state().time;
  ledger_.keep("next component", place);
  if (communicator_->is_root() && options_.limits.tell)
    progress_->note(fmt::format("after step {} at t = {:.6g}: {} continues after {}", place.step,
                                place.value, component_->name(), before.name()));
}

}  // namespace sluice
