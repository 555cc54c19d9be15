#include "mpmice/walls/wall_friction.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpmice {

// Whose velocity counts in cell c, and its distance from the plane of the surface there.
template <int D>
typename WallFriction<D>::BeforeSurface WallFriction<D>::before(
    const Frame<D>& frame, const SolidGeometry<D>& solid, const OnSurfaces<D>& surface,
    const Cell<D>& c, std::size_t i, const std::array<double, D>& unit) const {
  constexpr double nearest = 0.25;  // cells
  std::size_t along = 0;
  BeforeSurface at{i, 0};
  for (std::size_t d = 0; d < D; ++d) {
    if (std::fabs(unit[d]) > std::fabs(unit[along])) along = d;
    at.distance += unit[d] * (0.5 - surface.place[d][i]) * frame.spacing[frame.direction[d]];
  }
  const double step = std::fabs(unit[along]) * frame.spacing[frame.direction[along]];
  if (at.distance < nearest * step) {
    Cell<D> beside = c;
    beside[along] += unit[along] > 0 ? 1 : -1;
    const std::size_t j = frame.cells.index(frame.inside(beside));
    if ((frame.in_domain(beside) || frame.periodic[along]) && solid.wet(j)) {
      at.cell = j;
      at.distance += step;
    }
  }
  at.distance = std::max(at.distance, nearest * step);
  return at;
}

template <int D>
void WallFriction<D>::find(const NearCells<D>& near, const SolidGeometry<D>& solid,
                           const OnSurfaces<D>& surface, const FluidStates<D>& fluid,
                           const SmoothNormals<D>& normals, double dt) {
  const Frame<D>& frame = near.frame();
  const Column &rho = fluid.density(), &viscosity = fluid.viscosity();
  for (Column& of : stress_) of.assign(near.size(), 0.0);
  near.for_each_at_once([&](const Cell<D>& c, std::size_t i) {
    if (!solid.wet(i) || !(surface.area[i] > 0) || !(viscosity[i] > 0)) return;
    std::array<double, D> unit, w;
    const double size = normals.length(i);
    double across = 0;
    if (!(size > 0)) return;
    for (std::size_t d = 0; d < D; ++d) unit[d] = normals.along(d, i) / size;
    const BeforeSurface at = before(frame, solid, surface, c, i, unit);
    for (std::size_t d = 0; d < D; ++d) {
      w[d] = fluid.velocity()[d][at.cell] - surface.velocity[d][i];
      across += unit[d] * w[d];
    }
    const double V = 1 - solid.theta[i];
    const double A = surface.area[i] * frame.largest_face() / frame.cell_volume;
    double M = rho[i] * V;
    if (V < 0.5 && at.cell != i) M += rho[at.cell] * (1 - solid.theta[at.cell]);
    const double stress = std::min(viscosity[i] / at.distance, M / (dt * A));
    for (std::size_t d = 0; d < D; ++d) stress_[d][i] = (w[d] - across * unit[d]) * stress;
  });
}

template <int D>
void WallFriction<D>::take(const NearCells<D>& near, const OnSurfaces<D>& surface,
                           const std::array<int, 3>& component, double dt,
                           CellAmounts<D>& amounts) const {
  const Frame<D>& frame = near.frame();
  const double to_impulse = dt * frame.largest_face() / frame.cell_volume;
  near.for_each([&](const Cell<D>&, std::size_t i) {
    for (std::size_t d = 0; d < D; ++d) {
      const double I = stress_[d][i] * surface.area[i] * to_impulse;
      if (I == 0) continue;
      amounts.touched[i] = 1;
      const int c = component[static_cast<std::size_t>(frame.direction[d])];
      amounts.momentum[static_cast<std::size_t>(c)][i] -= I;
      amounts.kinetic[i] -= I * surface.velocity[d][i];
    }
  });
}

template class WallFriction<1>;
template class WallFriction<2>;
template class WallFriction<3>;

}  // namespace sluice::mpmice
