#include "mpmice/step/coupling_on_levels.hpp"

#include <fmt/format.h>

#include "framework/base/reduction.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "ice/fluid/labels.hpp"

namespace sluice::mpmice {

CouplingOnLevels::CouplingOnLevels(const Scene& scene, const ice::FluidPart& fluid,
                                   const std::shared_ptr<solids::CoupledSolids>& solids,
                                   const std::vector<models::SolidBurn>& burns,
                                   const BurnReductions& places, const BurningCells& burning)
    : fluid_(&fluid), solids_(solids), burning_(&burning) {
  for (const Level& level : scene.grid.levels)
    levels_.push_back(make_coupling(level, fluid, solids, burns, places));
}

Verdict CouplingOnLevels::on_finest(CouplingTask task, const StageScope& scope) {
  const std::size_t finest = scope.levels.size() - 1;
  StageScope own = scope;
  own.levels = {scope.levels[finest]};
  std::vector<std::vector<double>> maxima = {(*scope.maxima)[finest]};
  own.maxima = &maxima;
  const Verdict verdict = levels_[finest]->run(task, own);
  (*scope.maxima)[finest] = maxima.front();
  return verdict;
}

bool CouplingOnLevels::all_on_finest(const StageScope& scope) const {
  const int finest = static_cast<int>(scope.levels.size()) - 1;
  bool coarse = false;
  for (int k = 0; k < static_cast<int>(solids_->kinds().size()); ++k)
    for (int l = 0; l < finest; ++l)
      for (int b = 0; b < scope.particles->store(k).box_count(l); ++b)
        coarse |= !scope.particles->store(k).set(l, b).empty();
  Reduction all;
  const auto any = all.add_any(coarse);
  scope.ranks->reduce(all);
  if (!all.any(any)) return true;
  *scope.reason = fmt::format(
      "a part of a solid lies on a level coarser than {}: solids in a fluid must lie on the finest "
      "level as a whole; refine around them",
      finest);
  return false;
}

// Coarser levels know of no solids.
void CouplingOnLevels::clear_coarser(const StageScope& scope) const {
  for (std::size_t l = 0; l + 1 < scope.levels.size(); ++l) {
    Warehouse& state = scope.levels[l]->state();
    std::vector<SlotInfo> slots = fluid_->wall_slots();
    slots.push_back({ice::labels().solid_fraction, fluid_->options().place(0), 1, 0});
    for (const SlotInfo& s : slots) {
      const int slot = state.find(s.label, s.material);
      for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) state.clear(slot, b);
    }
  }
}

Verdict CouplingOnLevels::run(CouplingTask task, const StageScope& scope) {
  if (task == CouplingTask::find_cells) {
    if (scope.levels.size() > 1 && !all_on_finest(scope)) return Verdict::reject;
    clear_coarser(scope);
  }
  if (task == CouplingTask::part_solids)
    for (LevelSolver* level : scope.levels) burning_->clear(level->attempted());
  return on_finest(task, scope);
}

}  // namespace sluice::mpmice
