// Friction of the fluid on the surfaces of solids, in cells with both.
//
// With nhat out of the solid, w the part of u - u_s along the surface, h the distance of u from it,
// A its area per cell volume, mu the viscosity of the fluid, M the mass that is moved:
//   on the surface: t = mu w/h, at most M w/(dt A);  fluid: P -= dt A t, energy -= dt A t.u_s
// u stands at the centre of its cell, as the stress between cells has it: of the cell itself, or of
// its neighbour along nhat where the surface is nearer than a quarter of a cell to that centre, or
// beyond it. (A cell of which solids take half shares what it holds with that neighbour,
// redistribute.cpp, and then M is that of both.) Between plates the steady velocity of the cells
// is exact where it is linear.
#include <algorithm>
#include <cmath>

#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {

// Whose velocity counts in cell c, and its distance from the plane of the surface there, m.
template <int D>
typename LevelCoupling<D>::BeforeSurface LevelCoupling<D>::before_surface(
    const Cell<D>& c, std::size_t i, const std::array<double, D>& unit) const {
  constexpr double nearest = 0.25;  // cells
  std::size_t along = 0;
  BeforeSurface at{i, 0};
  for (std::size_t d = 0; d < D; ++d) {
    if (std::fabs(unit[d]) > std::fabs(unit[along])) along = d;
    at.distance +=
        unit[d] * (0.5 - fields_.surface_place[d][i]) * frame_.spacing[frame_.direction[d]];
  }
  const double step = std::fabs(unit[along]) * frame_.spacing[frame_.direction[along]];
  if (at.distance < nearest * step) {
    Cell<D> beside = c;
    beside[along] += unit[along] > 0 ? 1 : -1;
    const std::size_t j = frame_.cells.index(frame_.inside(beside));
    if ((frame_.in_domain(beside) || frame_.periodic[along]) && wet(j)) {
      at.cell = j;
      at.distance += step;
    }
  }
  at.distance = std::max(at.distance, nearest * step);
  return at;
}

template <int D>
void LevelCoupling<D>::rub_on_walls(const Column& rho, const Column& viscosity,
                                    const std::array<Column, D>& u, double dt) {
  for (Column& of : fields_.friction) of.assign(frame_.cells.size(), 0.0);
  for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
    if (!wet(i) || !(fields_.area[i] > 0) || !(viscosity[i] > 0)) return;
    std::array<double, D> unit, w;
    double size = 0, across = 0;
    for (std::size_t d = 0; d < D; ++d) size += fields_.smooth[d][i] * fields_.smooth[d][i];
    if (!(size > 0)) return;
    for (std::size_t d = 0; d < D; ++d) unit[d] = fields_.smooth[d][i] / std::sqrt(size);
    const BeforeSurface at = before_surface(c, i, unit);
    for (std::size_t d = 0; d < D; ++d) {
      w[d] = u[d][at.cell] - fields_.surface_velocity[d][i];
      across += unit[d] * w[d];
    }
    const double V = 1 - fields_.theta[i];
    const double A = fields_.area[i] * frame_.largest_face() / frame_.cell_volume;
    double M = rho[i] * V;
    if (V < 0.5 && at.cell != i) M += rho[at.cell] * (1 - fields_.theta[at.cell]);
    const double stress = std::min(viscosity[i] / at.distance, M / (dt * A));
    for (std::size_t d = 0; d < D; ++d) fields_.friction[d][i] = (w[d] - across * unit[d]) * stress;
  });
}

// What the fluid of these cells gives to surfaces.
template <int D>
void LevelCoupling<D>::take_friction(const StageScope& scope) {
  if (!fluid_->options().transport.viscous) return;
  std::array<int, 3> component{-1, -1, -1};
  for (std::size_t k = 0; k < amounts_.momentum.size(); ++k)
    component[static_cast<std::size_t>(fluid_->options().grid.direction[k])] = static_cast<int>(k);
  const double to_impulse = scope.step.dt * frame_.largest_face() / frame_.cell_volume;
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    for (std::size_t d = 0; d < D; ++d) {
      const double I = fields_.friction[d][i] * fields_.area[i] * to_impulse;
      if (I == 0) continue;
      amounts_.touched[i] = 1;
      const int c = component[static_cast<std::size_t>(frame_.direction[d])];
      amounts_.momentum[static_cast<std::size_t>(c)][i] -= I;
      amounts_.kinetic[i] -= I * fields_.surface_velocity[d][i];
    }
  });
}

template void LevelCoupling<1>::rub_on_walls(const Column&, const Column&,
                                             const std::array<Column, 1>&, double);
template void LevelCoupling<2>::rub_on_walls(const Column&, const Column&,
                                             const std::array<Column, 2>&, double);
template void LevelCoupling<3>::rub_on_walls(const Column&, const Column&,
                                             const std::array<Column, 3>&, double);
template void LevelCoupling<1>::take_friction(const StageScope&);
template void LevelCoupling<2>::take_friction(const StageScope&);
template void LevelCoupling<3>::take_friction(const StageScope&);

}  // namespace sluice::mpmice
