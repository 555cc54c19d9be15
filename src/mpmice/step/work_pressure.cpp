// The work pressure X of a semi-implicit step in the cells of solids (docs/theory/ice_pressure.md):
// the pressure that acts on their surfaces, and what the next step is told of it.
#include "ice/fluid/labels.hpp"
#include "mpmice/step/fluid_cells.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {

// X- + d after a solve, in cells with fluid.
template <int D>
Verdict LevelCoupling<D>::renew_pressures(const StageScope& scope) {
  tell_fluid_states(scope, true);
  known_.tell_all(*scope.ranks);
  find_pressures(scope, true);
  return Verdict::good;
}

template <int D>
Verdict LevelCoupling<D>::tell_pressures(const StageScope& scope) {
  tell_fluid(scope);
  return Verdict::good;
}

// Y' = X - p' where the state was settled behind the sweep. Where there was no fluid, X is the mean
// of what is around.
template <int D>
Verdict LevelCoupling<D>::keep_work_pressure(const StageScope& scope) {
  Column& X = fields_.pressure;
  KeptArray<std::uint8_t> known = fill_dry(X);
  Warehouse& next = scope.levels.front()->attempted();
  const FluidCells fluid(*fluid_, next);
  const int slot = next.find(ice::labels().pressure_offset, fluid_->options().place(0));
  for (int b = 0; b < static_cast<int>(next.local_boxes().size()); ++b) {
    const FluidBox cells = fluid.box(b);
    const RealView offset = next.view(slot, 0, b);
    const IndexBox& own = next.local_boxes()[static_cast<std::size_t>(b)].cells;
    frame_.for_each_held(own, [&](IntVec3 at, std::size_t i) {
      if (amounts_.touched[i] == 0) return;
      offset(at) = known[i] != 0 ? X[i] - cells.at(at).pressure : 0.0;
    });
    next.forget_where(b, [&](const IndexBox& part) { return frame_.holds_any(part); });
  }
  return Verdict::good;
}

template Verdict LevelCoupling<1>::renew_pressures(const StageScope&);
template Verdict LevelCoupling<2>::renew_pressures(const StageScope&);
template Verdict LevelCoupling<3>::renew_pressures(const StageScope&);
template Verdict LevelCoupling<1>::tell_pressures(const StageScope&);
template Verdict LevelCoupling<2>::tell_pressures(const StageScope&);
template Verdict LevelCoupling<3>::tell_pressures(const StageScope&);
template Verdict LevelCoupling<1>::keep_work_pressure(const StageScope&);
template Verdict LevelCoupling<2>::keep_work_pressure(const StageScope&);
template Verdict LevelCoupling<3>::keep_work_pressure(const StageScope&);

}  // namespace sluice::mpmice
