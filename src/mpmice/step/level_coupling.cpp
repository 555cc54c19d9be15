#include "mpmice/step/level_coupling.hpp"

#include "framework/run/levels/level_solver.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/step/step_bounds.hpp"
#include "mpmice/amounts/work_pressure.hpp"
#include "mpmice/fields/agreement.hpp"
#include "mpmice/surfaces/fluid_inputs.hpp"
#include "mpmice/surfaces/separation.hpp"

namespace sluice::mpmice {
namespace {

// Does somebody ask for what solids do farther from fluid than beside it.
bool looks_far(const ice::FluidPart& fluid) {
  return fluid.options().scheme.implicit || fluid.tracers() != nullptr;
}

}  // namespace

template <int D>
LevelCoupling<D>::LevelCoupling(const Level& level, const ice::FluidPart& fluid,
                                std::shared_ptr<solids::CoupledSolids> solids,
                                const std::vector<models::SolidBurn>& burns,
                                const BurnReductions& places)
    : fluid_(&fluid),
      solids_(std::move(solids)),
      near_(level),
      sets_(solids_->kinds(), !burns.empty()),
      surfaces_(*solids_, fluid.options().transport.viscous),
      walls_(fluid, *solids_, fluid.options().scheme.implicit || !burns.empty()),
      motion_(*solids_, looks_far(fluid)),
      cells_(fluid),
      exchange_(fluid, solids_->kinds()),
      burning_(*solids_, fluid, burns, places),
      agreement_(*solids_, exchange_) {}

template <int D>
Verdict LevelCoupling<D>::run(CouplingTask task, const StageScope& scope) {
  switch (task) {
    case CouplingTask::find_cells:
      return find_cells(scope);
    case CouplingTask::find_surfaces:
      return find_surfaces(scope);
    case CouplingTask::press_on_walls:
      return press_on_walls(scope);
    case CouplingTask::renew_pressures:
      return renew_pressures(scope);
    case CouplingTask::push_solids:
      return push_solids(scope);
    case CouplingTask::sweep_volumes:
      return sweep_volumes(scope);
    case CouplingTask::write_fluid_inputs:
      return write_fluid_inputs(scope);
    case CouplingTask::part_solids:
      return part_solids(scope);
    case CouplingTask::share_small_cells:
      return share_small_cells(scope);
    case CouplingTask::exchange:
      return exchange(scope);
    case CouplingTask::burn:
      return burn(scope);
    case CouplingTask::settle:
      return settle(scope);
    case CouplingTask::keep_work_pressure:
      return keep_work_pressure(scope);
    case CouplingTask::end_step:
      return end_step(scope);
  }
  return Verdict::reject;
}

template <int D>
int LevelCoupling<D>::slot_of_fraction(const Warehouse& state) const {
  return state.find(ice::labels().solid_fraction, fluid_->options().place(0));
}

template <int D>
Verdict LevelCoupling<D>::find_cells(const StageScope& scope) {
  const Level& level = scope.levels.front()->level();
  const Warehouse& state = scope.levels.front()->state();
  sets_.list(*scope.particles, level.index);
  OccupiedCells<D>& solids = near_.begin(scope.levels.front()->team());
  sets_.add_cells(near_.frame(), scope.step.dt, solids);
  PreviousFractions<D>::add_cells(near_.frame(), state, slot_of_fraction(state), solids);
  near_.finish(level, state.local_boxes(), *scope.ranks);
  return Verdict::good;
}

template <int D>
Verdict LevelCoupling<D>::find_surfaces(const StageScope& scope) {
  const Warehouse& state = scope.levels.front()->state();
  FluidStates<D>& states = walls_.states();
  surfaces_.begin(near_, sets_, state, slot_of_fraction(state), *scope.ranks);
  states.gather(near_, state, false);
  const double impedance =
      surfaces_.add_means(near_, sets_, states.highest_impedance(), *scope.ranks);
  walls_.begin(near_.frame(), impedance, scope.step.dt);
  const auto [free_cells, surfaces, kept, means] = surfaces_.sums();
  share_sums<D>({free_cells, surfaces, kept, means, &states.sums()}, *scope.ranks);
  surfaces_.finish(near_, sets_, *scope.ranks);
  return Verdict::good;
}

template <int D>
Verdict LevelCoupling<D>::press_on_walls(const StageScope& scope) {
  walls_.forces().find_overlaps(near_, surfaces_.solid(), sets_.all_rigid());
  walls_.find(near_, sets_, surfaces_, scope.step.dt, false, *scope.ranks);
  return Verdict::good;
}

// X- + d after a solve, in cells with fluid.
template <int D>
Verdict LevelCoupling<D>::renew_pressures(const StageScope& scope) {
  FluidStates<D>& states = walls_.states();
  states.gather(near_, scope.levels.front()->state(), true);
  states.sums().sum_over_ranks(*scope.ranks);
  walls_.find(near_, sets_, surfaces_, scope.step.dt, true, *scope.ranks);
  return Verdict::good;
}

template <int D>
Verdict LevelCoupling<D>::push_solids(const StageScope& scope) {
  const WallForces<D>& forces = walls_.forces();
  solids_->add_corner_forces(scope, forces.on_corners(near_.frame(), sets_, surfaces_.on()));
  forces.book(near_, surfaces_.solid(), sets_, scope.step.dt, books_);
  return Verdict::good;
}

template <int D>
Verdict LevelCoupling<D>::sweep_volumes(const StageScope& scope) {
  surfaces_.find_moved(near_, sets_, *scope.ranks);
  motion_.find(near_, surfaces_.solid(), sets_, scope.step.dt, *scope.ranks);
  return Verdict::good;
}

template <int D>
Verdict LevelCoupling<D>::write_fluid_inputs(const StageScope& scope) {
  FluidInputs<D>(near_, surfaces_.solid(), motion_, walls_.pressure().values())
      .write(scope.levels.front()->state(), fluid_->options().place(0));
  return Verdict::good;
}

// Behind the sweep, before amounts of cells become a state: the fluid of a cell keeps what it has,
// in what the parted solids leave of it.
template <int D>
Verdict LevelCoupling<D>::part_solids(const StageScope& scope) {
  cells_.fluid().begin(near_, surfaces_.solid());
  if (!Separation<D>(*solids_).part(scope, near_, sets_)) return Verdict::good;
  surfaces_.find_at_end(near_, sets_, *scope.ranks);
  surfaces_.keep_open(near_);
  return Verdict::good;
}

template <int D>
Verdict LevelCoupling<D>::share_small_cells(const StageScope& scope) {
  cells_.merging().begin();
  cells_.fluid().gather(near_, surfaces_.solid(), scope.levels.front()->attempted(), *scope.ranks);
  walls_.take_friction(near_, surfaces_, scope.step.dt, cells_.amounts());
  cells_.share(near_, surfaces_.solid(), walls_.normals());
  books_.clear_exchange();
  return Verdict::good;
}

template <int D>
Verdict LevelCoupling<D>::exchange(const StageScope& scope) {
  for (int k = 0; k < static_cast<int>(solids_->kinds().size()); ++k)
    if (exchange_.exchanges(k))
      exchange_.run(scope, k, near_, surfaces_.solid(), sets_.all(), cells_.amounts(), books_);
  return Verdict::good;
}

// Where particles have burned, theta and a are found once more, with what is left of them.
template <int D>
Verdict LevelCoupling<D>::burn(const StageScope& scope) {
  const BurningStep<D> step{
      scope,  near_, surfaces_.solid(), sets_, cells_.amounts(), walls_.states().pressure(),
      *fluid_};
  if (!burning_.burn(step)) return Verdict::good;
  surfaces_.find_at_end(near_, sets_, *scope.ranks);
  burning_.products().fill_opened(step);
  cells_.fluid().refresh(near_, *scope.ranks);
  cells_.share(near_, surfaces_.solid(), walls_.normals());
  return Verdict::good;
}

// Books what surfaces work, and what all ranks have come to.
template <int D>
typename LevelCoupling<D>::Faults LevelCoupling<D>::agree(const StageScope& scope, bool good) {
  const FluidAmounts<D>& fluid = cells_.fluid();
  walls_.forces().book_work(near_, surfaces_.solid(), surfaces_.on(), sets_, fluid.theta_swept(),
                            fluid.swept_with_solid(), scope.step.dt, books_);
  const CellRates own = good ? cells_.settled().rates(near_, fluid.amounts()) : CellRates{};
  const Faults here{cells_.merging().trapped(), !good, sets_.strayed()};
  return agreement_.find(sets_, here, own, books_, *scope.sums, *scope.ranks);
}

template <int D>
Verdict LevelCoupling<D>::settle(const StageScope& scope) {
  SolidGeometry<D>& solid = surfaces_.solid();
  SettledFluid<D>& settled = cells_.settled();
  CellAmounts<D>& amounts = cells_.amounts();
  Faults faults = agree(scope, settled.settle(near_, amounts, solid, *scope.reason));
  if (faults.strayed) {
    *scope.reason = SolidSets<D>::stray_reason();
    return Verdict::reject;
  }
  if (faults.inadmissible && !faults.trapped) {
    if (!cells_.merging().share_inadmissible(near_, solid, walls_.normals(), cells_.fluid(),
                                             settled, *scope.ranks, *scope.reason))
      return Verdict::reject;
    faults = agree(scope, true);
  }
  if (faults.trapped) {
    *scope.reason = cells_.merging().fault(near_.frame());
    share_reason(*scope.ranks, *scope.reason);
    return Verdict::reject;
  }
  settled.fill_dry(near_, amounts);
  settled.store(near_.frame(), amounts, solid.theta_next, scope.levels.front()->state(),
                scope.levels.front()->attempted());
  return Verdict::good;
}

template <int D>
Verdict LevelCoupling<D>::keep_work_pressure(const StageScope& scope) {
  mpmice::keep_work_pressure<D>(near_, surfaces_.solid(), cells_.amounts(), *fluid_,
                                walls_.states().pressure(), scope.levels.front()->attempted());
  return Verdict::good;
}

template <int D>
Verdict LevelCoupling<D>::end_step(const StageScope& scope) {
  const std::span<double> maxima =
      fluid_->options().budgets.places.maxima.of(scope.maxima->front());
  const auto include = [&](int slot, double rate) {
    double& own = maxima[static_cast<std::size_t>(slot)];
    own = std::max(own, rate);
  };
  const CellRates& rates = agreement_.rates();
  include(ice::StepSlots::deck_rate, rates.deck);
  include(ice::StepSlots::flow_rate, rates.flow);
  include(ice::StepSlots::sound_rate, rates.sound);
  burning_.remove_burned(scope);
  return Verdict::good;
}

template class LevelCoupling<1>;
template class LevelCoupling<2>;
template class LevelCoupling<3>;

}  // namespace sluice::mpmice
