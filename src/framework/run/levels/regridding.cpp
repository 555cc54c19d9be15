#include "framework/run/levels/regridding.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "framework/base/memory.hpp"
#include "framework/grid/grid_boxes.hpp"
#include "framework/run/levels/load_balance.hpp"

namespace sluice {
namespace {

// The cells that the deck's own finer levels cover.
void add_start_boxes(const RefinementSettings& settings, std::vector<FlagField>& flags) {
  for (std::size_t l = 0; l < std::min(flags.size(), settings.start_boxes.size()); ++l)
    for (const IndexBox& fine : settings.start_boxes[l].boxes) {
      const IndexBox cells =
          intersection(coarsen(fine, settings.start_boxes[l].ratio), flags[l].domain());
      for_each_cell(cells, [&](IntVec3 c) { flags[l].set(c); });
    }
}

}  // namespace

Regridding::Regridding(const Scene& scene, const Component& component, const SolverOptions& options,
                       Communicator& communicator, Levels& levels, GhostsInTime& ghosts,
                       LevelRates& rates, ParticleCloud* particles)
    : scene_(&scene),
      communicator_(&communicator),
      levels_(&levels),
      ghosts_(&ghosts),
      rates_(&rates),
      particles_(particles),
      flags_(scene.refinement, component, scene.grid.levels) {
  if (!scene.refinement.adaptive || levels.possible() < 2) return;
  regridder_.emplace(scene.refinement, scene.grid.levels, communicator.size(), options.threads,
                     component.step().courant_number());
  regridder_->limit_boxes(options.max_box_cells);
  keep_freed_memory();
}

// Levels whose cells ask for finer ones, coarse to fine, and how many must be read to know.
int Regridding::flagging_levels() const {
  return std::min(levels_->count(), levels_->possible() - 1);
}

int Regridding::read_levels() const {
  return flags_.levels_read(levels_->count(), flagging_levels());
}

std::vector<FlagField> Regridding::flags(double time) {
  std::vector<LevelSolver*> levels;
  for (int l = 0; l < read_levels(); ++l) {
    ghosts_->fill(l, time);
    levels.push_back(&(*levels_)[l]);
  }
  return flags_.of(levels, flagging_levels(), time, *communicator_, particles_);
}

// The boxes that the regridder wants, coarse to fine. Each new level needs the ghost cells of the
// one below it, and those the joint below: the next step finds them filled, as those of levels that
// nothing changes below. The first level that has changed.
int Regridding::lay_out(bool from_deck, double time) {
  int first = levels_->possible(), laid_out = -1;  // and the last one
  for (int l = 1; l < levels_->possible(); ++l) {
    std::vector<GridBox> boxes = regridder_->boxes(l);
    deal_out(boxes, (*levels_)[l], particles_, *communicator_);
    if (same_boxes(boxes, (*levels_)[l].level().boxes)) {
      if (laid_out == l - 1) levels_->make_interface(l - 1);
      if (laid_out > 0)
        (*levels_)[l].mark_modified();  // cells have come where it took ghosts of ghosts from
      continue;
    }
    if (!from_deck && !boxes.empty()) ghosts_->fill(l - 1, time);
    levels_->lay_out(l, std::move(boxes), from_deck);
    first = std::min(first, l);
    laid_out = l;
    levels_->make_interface(l - 1);
  }
  levels_->connect(first);
  return first;
}

bool Regridding::add_level_at_start(double time) {
  std::vector<FlagField> wanted = flags(time);
  add_start_boxes(scene_->refinement, wanted);
  if (!regridder_->regrid_at_start(wanted)) return false;
  lay_out(true, time);
  return true;
}

// Memory follows the cells, but is not returned and asked for again with every regrid.
void Regridding::return_memory() {
  std::size_t bytes = 0;
  for (int l = 0; l < levels_->count(); ++l) bytes += (*levels_)[l].memory_bytes();
  max_bytes_ = std::max(max_bytes_, bytes);
  if (bytes > max_bytes_ / 2) return;
  return_freed_memory();
  max_bytes_ = bytes;
}

bool Regridding::regrid(int step, double time) {
  if (!regridder_ || !regridder_->looks_at(step)) return false;
  // Ghost cells that are filled to look at flags are those of the next step, except of levels that
  // are laid anew.
  using Clock = std::chrono::steady_clock;
  std::vector<Clock::time_point> filled = {Clock::now()};  // before the first, and after each level
  for (int l = 0; l < read_levels(); ++l) {
    ghosts_->fill(l, time);
    filled.push_back(Clock::now());
  }
  const int levels_before = levels_->count();
  auto start = filled.back();
  const bool changed = regridder_->regrid(step, flags(time));
  if (changed) {
    start = filled[std::min(static_cast<std::size_t>(lay_out(false, time)), filled.size() - 1)];
    if (particles_ != nullptr)
      particles_->follow(levels_->existing());  // rates are those of levels
    rates_->measure(levels_before, time);
    return_memory();
    ++count_;
  }
  seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
  return changed;
}

void Regridding::restore(const RegridState& state) {
  regridder_->restore(state);
  for (int l = 1; l < levels_->possible(); ++l) {
    (*levels_)[l].lay_out(regridder_->boxes(l));
    levels_->make_interface(l - 1);
  }
  levels_->connect();
}

std::string Regridding::state() const {
  return regridder_ ? to_json_text(regridder_->state()) : std::string();
}

}  // namespace sluice
