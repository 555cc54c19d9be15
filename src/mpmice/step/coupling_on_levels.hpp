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
  CouplingOnLevels(const Scene& scene, const ice::FluidPart& fluid,
                   const std::shared_ptr<solids::CoupledSolids>& solids,
                   const std::vector<models::SolidBurn>& burns, const BurnReductions& places,
                   const BurningCells& burning);

  Verdict run(CouplingTask task, const StageScope& scope);

 private:
  Verdict on_finest(CouplingTask task, const StageScope& scope);
  // Solids on a coarser level: the step cannot be taken.
  bool all_on_finest(const StageScope& scope) const;
  void clear_coarser(const StageScope& scope) const;

  const ice::FluidPart* fluid_;
  std::shared_ptr<solids::CoupledSolids> solids_;
  const BurningCells* burning_;
  std::vector<std::unique_ptr<Coupling>> levels_;
};

}  // namespace sluice::mpmice
