#include "mpmice/walls/walls.hpp"

namespace sluice::mpmice {

template <int D>
Walls<D>::Walls(const ice::FluidPart& fluid, const solids::CoupledSolids& solids, bool looks_far)
    : fluid_(&fluid),
      viscous_(fluid.options().transport.viscous),
      states_(fluid, looks_far),
      light_(fluid.options().scheme.implicit),
      pressure_(fluid.options().scheme.implicit,
                fluid.options().materials.fluids.front().shock_slope(),
                solids::reference_pressure(solids.kinds())),
      forces_(solids, pressure_, friction_, viscous_) {}

template <int D>
void Walls<D>::find(const NearCells<D>& near, const SolidSets<D>& sets, const Surfaces<D>& surfaces,
                    double dt, bool solved, Communicator& ranks) {
  const SolidGeometry<D>& solid = surfaces.solid();
  const OnSurfaces<D>& on = surfaces.on();
  states_.take();
  normals_.find(near, solid, on);
  if (light_.may_be_light())
    light_.find(near, sets, on, normals_,
                pressure_.impedance(near, solid, on, states_, normals_, dt), dt, ranks);
  pressure_.find(near, solid, on, states_, normals_, light_, dt);
  if (viscous_ && !solved) friction_.find(near, solid, on, states_, normals_, dt);
}

template <int D>
void Walls<D>::take_friction(const NearCells<D>& near, const Surfaces<D>& surfaces, double dt,
                             CellAmounts<D>& amounts) const {
  if (!viscous_) return;
  std::array<int, 3> component{-1, -1, -1};
  for (std::size_t k = 0; k < amounts.momentum.size(); ++k)
    component[static_cast<std::size_t>(fluid_->options().grid.direction[k])] = static_cast<int>(k);
  friction_.take(near, surfaces.on(), component, dt, amounts);
}

template class Walls<1>;
template class Walls<2>;
template class Walls<3>;

}  // namespace sluice::mpmice
