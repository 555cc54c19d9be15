// The coupling on one level in D active directions: its tasks, each of the classes that have its
// equations.
#pragma once
#include "mpmice/burn/solid_burning.hpp"
#include "mpmice/step/cells_agreement.hpp"
#include "mpmice/step/coupling.hpp"
#include "mpmice/surfaces/mean_motion.hpp"
#include "mpmice/walls/walls.hpp"

namespace sluice::mpmice {

template <int D>
class LevelCoupling final : public Coupling {
 public:
  LevelCoupling(const Level& level, const ice::FluidPart& fluid,
                std::shared_ptr<solids::CoupledSolids> solids,
                const std::vector<models::SolidBurn>& burns, const BurnReductions& places);

  Verdict run(CouplingTask task, const StageScope& scope) override;

 private:
  Verdict find_cells(const StageScope& scope);
  Verdict find_surfaces(const StageScope& scope);
  Verdict press_on_walls(const StageScope& scope);
  Verdict renew_pressures(const StageScope& scope);
  Verdict push_solids(const StageScope& scope);
  Verdict sweep_volumes(const StageScope& scope);
  Verdict write_fluid_inputs(const StageScope& scope);
  Verdict part_solids(const StageScope& scope);
  Verdict share_small_cells(const StageScope& scope);
  Verdict exchange(const StageScope& scope);
  Verdict burn(const StageScope& scope);
  Verdict settle(const StageScope& scope);
  Verdict keep_work_pressure(const StageScope& scope);
  Verdict end_step(const StageScope& scope);

  int slot_of_fraction(const Warehouse& state) const;
  using Faults = typename CellsAgreement<D>::Faults;
  Faults agree(const StageScope& scope, bool good);

  const ice::FluidPart* fluid_;
  std::shared_ptr<solids::CoupledSolids> solids_;
  NearCells<D> near_;
  SolidSets<D> sets_;
  Surfaces<D> surfaces_;
  Walls<D> walls_;
  MeanMotion<D> motion_;
  FluidInCells<D> cells_;
  SurfaceExchange<D> exchange_;
  SolidBurning<D> burning_;
  CellsAgreement<D> agreement_;
  CouplingBooks books_;
};

}  // namespace sluice::mpmice
