#include "mpmice/walls/fluid_states.hpp"

#include <algorithm>

namespace sluice::mpmice {

// Cells whose state somebody asks for: around those with solids.
template <int D>
CellMask FluidStates<D>::cells_asked(const NearCells<D>& near) const {
  if (looks_far_) return CellMask(near.size(), 1);
  const Frame<D>& frame = near.frame();
  CellMask mask(near.size(), 0);
  for (const CellBox<D>& box : near.occupied().boxes())
    frame.cells.for_each_part(frame.touched_around(box), [&](const CellBox<D>& part) {
      for_each_cell_of<D>(part, [&](const Cell<D>& c) {
        const std::size_t i = frame.cells.index(frame.wrapped(c));
        if (i >= CellBlocks<D>::block_cells) mask[i] = 1;
      });
    });
  return mask;
}

template <int D>
void FluidStates<D>::gather(const NearCells<D>& near, const Warehouse& state, bool solved) {
  const Frame<D>& frame = near.frame();
  viscous_ = fluid_->options().transport.viscous && !solved;
  known_.begin(frame.cells, viscous_ ? of_viscosity + 1 : of_viscosity);
  const CellMask asked = cells_asked(near);
  const FluidCells fluid(*fluid_, state);
  const WorkPressure of_solve(*fluid_, state, solved);
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const FluidBox cells = fluid.box(b);
    const WorkPressure::Box work = of_solve.box(b);
    frame.for_each_held(state.local_boxes()[static_cast<std::size_t>(b)].cells, [&](IntVec3 at,
                                                                                    std::size_t i) {
      if (asked[i] == 0 || !(cells.fraction(at) < 1)) return;
      const FluidState s = cells.at(at);
      known_.put(of_density, i, s.rho);
      known_.put(of_pressure, i, work.at(at, s.pressure));
      known_.put(of_speed, i, s.sound);
      for (int a = 0; a < D; ++a)
        known_.put(of_velocity + a, i, s.velocity[frame.direction[static_cast<std::size_t>(a)]]);
      if (viscous_) known_.put(of_viscosity, i, cells.viscosity(at));
    });
  }
}

template <int D>
double FluidStates<D>::highest_impedance() const {
  double most = 0;
  const std::size_t count = known_.size();
  for (std::size_t i = 0; i < count; ++i)
    most = std::max(most, known_.value(of_density, i) * known_.value(of_speed, i));
  return most;
}

template <int D>
void FluidStates<D>::take() {
  known_.take(of_density, density_);
  known_.take(of_pressure, pressure_);
  known_.take(of_speed, sound_);
  for (int a = 0; a < D; ++a) known_.take(of_velocity + a, velocity_[static_cast<std::size_t>(a)]);
  if (viscous_) known_.take(of_viscosity, viscosity_);
}

template class FluidStates<1>;
template class FluidStates<2>;
template class FluidStates<3>;

}  // namespace sluice::mpmice
