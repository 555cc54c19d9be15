// A hierarchy that goes on from a checkpoint.
#include <fmt/format.h>

#include <algorithm>

#include "framework/archive/archive.hpp"
#include "framework/base/error.hpp"
#include "framework/run/levels/hierarchy.hpp"

namespace sluice {
namespace {

// A checkpoint continues on its own grid only, level by level.
void check_same_grid(const Level& now, const Level& then, const std::string& where) {
  const std::string level = now.index == 0 ? "" : fmt::format(" on level {}", now.index);
  auto differs = [&](const char* what) {
    throw InputError(
        fmt::format("{} contains a grid of [{}, {}, {}] cells{} with another {} than the deck's "
                    "[{}, {}, {}]: a restart continues with the same grid; leave {} out of --set",
                    where, then.domain.size().x, then.domain.size().y, then.domain.size().z, level,
                    what, now.domain.size().x, now.domain.size().y, now.domain.size().z,
                    now.index == 0 ? "Grid" : "Grid and AMR"));
  };
  if (!(then.domain == now.domain)) differs("number of cells");
  if (!(then.anchor == now.anchor)) differs("lower corner");
  if (!(then.spacing == now.spacing)) differs("spacing");
  if (then.periodic != now.periodic) differs("periodicity");
}

// Tiles of another size may lie elsewhere. That no cell is missing is seen when cells are read.
void check_same_cells(const Level& now, const Level& then, const std::string& where) {
  if (now.cell_count() == then.cell_count()) return;
  throw InputError(
      fmt::format("{} contains {} cells on level {}, where this deck has {}: a restart continues "
                  "with the same boxes and tiles; leave Grid and AMR out of --set",
                  where, then.cell_count(), now.index, now.cell_count()));
}

void read_level(LevelSolver& solver, const Component& component, const ArchiveStep& checkpoint) {
  Warehouse& state = solver.state();
  const std::vector<SlotInfo> slots = component.state().slots();
  const std::vector<std::vector<Label>> labels = component.state().checkpoint_labels();
  const int index = solver.level().index;
  for (std::size_t s = 0; s < slots.size(); ++s)
    for (std::size_t c = 0; c < labels[s].size(); ++c) {
      const FieldInfo* field = checkpoint.find(labels[s][c].name(), slots[s].material, index);
      if (field == nullptr)
        throw InputError(
            fmt::format("{} contains no {} on level {}: it cannot be restarted with this deck",
                        checkpoint.folder().string(), labels[s][c].name(), index));
      for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
        checkpoint.read_into(*field, 0, state.local_boxes()[b].cells,
                             state.view(solver.state_slots()[s], static_cast<int>(c), b));
    }
}

}  // namespace

void Hierarchy::restore(const ArchiveStep& checkpoint) {
  const std::vector<Level>& then = checkpoint.grid().levels;
  for (int l = 0; l < std::min(static_cast<int>(then.size()), levels_.possible()); ++l)
    check_same_grid(level(l).level(), then[l], checkpoint.folder().string());
  time_ = checkpoint.info().time;
  if (regridding_.adaptive()) {
    const auto& kept = checkpoint.info().state;
    const auto found = kept.find("regrid");
    if (found == kept.end())
      throw InputError(
          fmt::format("{} has no data of adaptive levels: it was written by a run without them; "
                      "leave AMR out of --set",
                      checkpoint.folder().string()));
    regridding_.restore(regrid_state_from_json_text(found->second));
    coarse_step_.renew();
  }
  if (static_cast<int>(checkpoint.grid().levels.size()) != level_count())
    throw InputError(fmt::format(
        "{} contains {} levels, but the deck has {}: a restart continues with the same levels",
        checkpoint.folder().string(), checkpoint.grid().levels.size(), level_count()));
  for (int l = 0; l < level_count(); ++l) {
    check_same_cells(level(l).level(), then[l], checkpoint.folder().string());
    read_level(level(l), *component_, checkpoint);
    level(l).mark_modified();
  }
  if (particles_ != nullptr) particles_->restore(checkpoint, levels_.existing());
}

}  // namespace sluice
