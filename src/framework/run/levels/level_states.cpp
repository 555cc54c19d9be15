#include "framework/run/levels/level_states.hpp"

#include <utility>

namespace sluice {

LevelStates::LevelStates(const StateFacet& component, const Level& level, int rank, int substeps)
    : level_(level),
      rank_(rank),
      substeps_(substeps),
      width_(halo_width(component)),
      present_(level_, rank, arrays),
      next_(level_, rank, arrays),
      start_(level_, rank, arrays) {
  for (const SlotInfo& s : component.slots()) {
    add_slot(s);
    slots_.push_back(present_.find(s.label, s.material));
  }
  for (const SlotInfo& s : component.work_slots()) add_slot(s);
}

void LevelStates::add_slot(SlotInfo info, Contents contents) {
  info.ghosts = width_;
  present_.add(info, contents);
  next_.add(info, contents);
  if (substeps_ > 1) start_.add(info, contents);
}

Warehouse LevelStates::lay_out(std::vector<GridBox> boxes) {
  Warehouse before = std::move(present_);
  level_.boxes = std::move(boxes);
  present_ = Warehouse(level_, rank_, arrays);
  next_ = Warehouse(level_, rank_, arrays);
  start_ = Warehouse(level_, rank_, arrays);
  // Interior cells are filled by the caller, ghosts before every use, the others by sweeps.
  for (int s = 0; s < before.slot_count(); ++s) add_slot(before.info(s), Contents::undefined);
  accept();
  return before;
}

void LevelStates::store_start_state() {
  if (advanced_ != 1 || substeps_ == 1 || start_kept_) return;
  next_.swap(start_);
  start_kept_ = true;
}

void LevelStates::advance() {
  present_.swap(next_);
  ++advanced_;
}

void LevelStates::accept() {
  advanced_ = 0;
  start_kept_ = false;
}

bool LevelStates::reject() {
  const bool changed = advanced_ > 0;
  if (changed) present_.swap(start_kept_ ? start_ : next_);
  accept();
  return changed;
}

void LevelStates::cut(IntVec3 extents) {
  for (Warehouse* w : {&present_, &next_, &start_})
    if (w->blocks().extents() != extents) w->cut(extents);
}

}  // namespace sluice
