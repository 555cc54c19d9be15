// The coupling on levels: on the finest that there is, which holds all solids; coarser levels have
// fluid alone, and below the finest one what that makes of it.
#pragma once
#include <memory>
#include <vector>

#include "mpmice/burn/burning_cells.hpp"
#include "mpmice/step/coupling.hpp"

namespace sluice::mpmice {

class CouplingOnLevels {
 public:
  CouplingOnLevels(const Scene& scene, const ice::FluidPart& fluid, const mpm::Mpm& solids,
                   std::shared_ptr<mpm::SolidLevels> step,
                   const std::vector<models::SolidBurn>& burns, const BurnReductions& places,
                   const BurningCells& burning);

  // The stages of Coupling.
  Verdict find_surfaces(const StageScope& scope);
  Verdict press_on_solids(const StageScope& scope);
  Verdict find_swept_volumes(const StageScope& scope);
  Verdict renew_pressures(const StageScope& scope);
  Verdict tell_pressures(const StageScope& scope);
  Verdict finish_cells(const StageScope& scope);
  Verdict keep_work_pressure(const StageScope& scope);
  Verdict limit_step(const StageScope& scope);
  Verdict remove_burned(const StageScope& scope);

 private:
  using Stage = Verdict (Coupling::*)(const StageScope&);
  Verdict on_finest(const StageScope& scope, Stage stage);
  // Solids on a coarser level: the step cannot be taken.
  bool all_on_finest(const StageScope& scope) const;
  void clear_coarser(const StageScope& scope) const;

  const ice::FluidPart* fluid_;
  const mpm::Mpm* solids_;
  const BurningCells* burning_;
  std::vector<std::unique_ptr<Coupling>> levels_;
};

}  // namespace sluice::mpmice
