#include "mpmice/walls/wall_pressure.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpmice {
namespace {

constexpr double least_share = 0.1;  // of the fluid's pressure that is left on a wall

}  // namespace

// What the pressure on a wall rests on, of a step of dt.
template <int D>
struct WallPressure<D>::Wall {
  const Frame<D>& frame;
  const SolidGeometry<D>& solid;
  const FluidStates<D>& fluid;
  const SmoothNormals<D>& normals;
  double dt;
};

template <int D>
Column WallPressure<D>::impedance(const NearCells<D>& near, const SolidGeometry<D>& solid,
                                  const OnSurfaces<D>& surface, const FluidStates<D>& fluid,
                                  const SmoothNormals<D>& normals, double dt) const {
  const Wall wall{near.frame(), solid, fluid, normals, dt};
  Column z(near.size(), 0.0);
  near.for_each([&](const Cell<D>&, std::size_t i) {
    if (!solid.wet(i) || !(surface.area[i] > 0)) return;
    const double size = normals.length(i);
    if (!(size > 0)) return;
    z[i] = std::min(fluid.density()[i] * fluid.sound()[i], most_impedance(wall, i, size));
  });
  return z;
}

template <int D>
void WallPressure<D>::find(const NearCells<D>& near, const SolidGeometry<D>& solid,
                           const OnSurfaces<D>& surface, const FluidStates<D>& fluid,
                           const SmoothNormals<D>& normals, const LightWalls<D>& light, double dt) {
  const Wall wall{near.frame(), solid, fluid, normals, dt};
  values_ = fluid.pressure();
  near.for_each_at_once([&](const Cell<D>& c, std::size_t i) {
    if (!near.within(i, NearCells<D>::pressure_reach)) return;
    if (!solid.wet(i) || !(surface.area[i] > 0)) return;
    double squares = 0;
    for (const Column& n : solid.normal) squares += n[i] * n[i];
    if (!(normals.length(i) > 0) || !(squares > 0)) return;
    values_[i] = press(wall, surface, light, c, i);
  });
  fill_dry(near, solid, values_);
}

// p_w of a cell with a wall.
template <int D>
double WallPressure<D>::press(const Wall& wall, const OnSurfaces<D>& surface,
                              const LightWalls<D>& light, const Cell<D>& c, std::size_t i) const {
  const double rho = wall.fluid.density()[i], sound = wall.fluid.sound()[i];
  const double size = wall.normals.length(i);
  double whole = 0, du = 0;
  for (std::size_t d = 0; d < D; ++d) whole += wall.solid.normal[d][i] * wall.solid.normal[d][i];
  for (std::size_t d = 0; d < D; ++d)
    du +=
        (surface.velocity[d][i] - wall.fluid.velocity()[d][i]) * (wall.normals.along(d, i) / size);
  if (implicit_) du = approach_at_surface(wall, c, i, size, du);
  const double p = pressure_beside_wall(wall, c, i, size);
  const double z =
      std::min(rho * (sound + slope_ * std::max(0.0, du)), most_impedance(wall, i, size));
  const double w = 1 / (1 + z * surface.compliance[i]);
  const double faced = std::min(1.0, std::sqrt(whole));
  if (D == 1) du *= faced;
  const double b = light.lightness(i);
  double share = faced, ps = surface.pressure[i];
  if (b > 0) {
    share += (1 - faced) * b;
    ps += b * (light.pressure_behind(i) - ps);
  }
  const double pw = p + z * w * du + (1 - w) * share * (ps + reference_ - p);
  const bool bears_tension = b > 0 && p < least_share * rho * sound * sound;
  return p > 0 && !bears_tension ? std::max(pw, least_share * p) : pw;
}

// What the fluid of a cell can resist with in a semi-implicit step, rho dx/(2 dt): of longer ones
// sound crosses it, and what remains of z du is in the pressure that was solved for
// (ice/pressure/predictions.cpp, j).
template <int D>
double WallPressure<D>::most_impedance(const Wall& wall, std::size_t i, double size) const {
  if (!implicit_) return 1e300;
  const double rho = wall.fluid.density()[i];
  return 0.5 * std::max(0.5, 1 - wall.solid.theta[i]) * rho /
         (wall.dt * wall.normals.cells_along(wall.frame, i, size));
}

// (u_s - u).nhat with the velocity of the fluid carried on to the surface, of a semi-implicit step:
// that of the middle of what the cell holds differs from the wall's by (h/2) du/dn in a flow that
// follows the wall, and z times that is no wave, but a drag that grows with the sound speed. The
// slope is that to the next cell along the largest component of nhat; a small cell has one state
// with that one. Taken where it makes du smaller, at most to 0.
template <int D>
double WallPressure<D>::approach_at_surface(const Wall& wall, const Cell<D>& c, std::size_t i,
                                            double size, double du) const {
  constexpr double small_volume = 0.5;
  const Frame<D>& frame = wall.frame;
  const std::array<Column, D>& u = wall.fluid.velocity();
  const std::size_t along = wall.normals.largest(i);
  const int away = wall.normals.along(along, i) > 0 ? 1 : -1;
  const double V = 1 - wall.solid.theta[i];
  const bool shares = V < small_volume;
  Cell<D> from = c, to = c;
  if (shares) from[along] += away;
  to[along] = from[along] + away;
  for (const Cell<D>& other : {from, to})
    if (!frame.periodic[along] && !frame.in_domain(other)) return du;
  const std::size_t a = frame.cells.index(frame.inside(from)),
                    b = frame.cells.index(frame.inside(to));
  if (!wall.solid.wet(a) || !wall.solid.wet(b)) return du;
  double slope = 0;
  for (std::size_t d = 0; d < D; ++d)
    slope += (u[d][b] - u[d][a]) * (wall.normals.along(d, i) / size);
  const double distance = 0.5 * (shares ? 1 + V : V), at_surface = du + slope * distance;
  if (!(at_surface * du > 0)) return 0;
  return std::fabs(at_surface) < std::fabs(du) ? at_surface : du;
}

// The fluid's pressure half a cell from the wall along nhat. That of a cell is of its centre, which
// the wall may have passed: of a semi-implicit step
//   p = X + V_s sum_d nhat_d^2 (X_d - X),  V_s = 1 - V, X_d of the cell beside along nhat_d
// Without it the wall stops what a cell of little fluid shares with its neighbour twice over, and
// that swings with a growing amplitude. In an explicit step the two share one state.
template <int D>
double WallPressure<D>::pressure_beside_wall(const Wall& wall, const Cell<D>& c, std::size_t i,
                                             double size) const {
  const Column& pressure = wall.fluid.pressure();
  const double X = pressure[i];
  if (!implicit_) return X;
  const Frame<D>& frame = wall.frame;
  double change = 0;
  for (std::size_t d = 0; d < D; ++d) {
    const double n = wall.normals.along(d, i) / size;
    Cell<D> beside = c, face = c;
    beside[d] += n > 0 ? 1 : -1;
    face[d] += n > 0 ? 1 : 0;
    if (!frame.in_domain(beside) && !frame.periodic[d]) continue;
    const std::size_t j = frame.cells.index(frame.inside(beside));
    if (!wall.solid.wet(j) || !(wall.solid.covered[d][frame.cells.index(face)] < 0.5)) continue;
    change += n * n * (pressure[j] - X);
  }
  return X + wall.solid.theta[i] * change;
}

template <int D>
CellMask fill_dry(const NearCells<D>& near, const SolidGeometry<D>& solid, Column& values) {
  CellMask known(near.size(), 0);
  near.for_each([&](const Cell<D>&, std::size_t i) { known[i] = solid.wet(i) ? 1 : 0; });
  constexpr int layers = 2;
  CellMask within = known;
  dilate(near.frame(), layers, within);
  for (int layer = 0; layer < layers; ++layer) {
    KeptArray<std::pair<std::size_t, double>> found;
    near.for_each([&](const Cell<D>& c, std::size_t i) {
      if (known[i] != 0 || within[i] == 0) return;
      double sum = 0;
      int count = 0;
      near.for_each_neighbour(c, [&](std::size_t j) {
        if (known[j] == 0) return;
        sum += values[j];
        ++count;
      });
      if (count > 0) found.emplace_back(i, sum / count);
    });
    for (const auto& [i, p] : found) {
      values[i] = p;
      known[i] = 1;
    }
  }
  return known;
}

template class WallPressure<1>;
template class WallPressure<2>;
template class WallPressure<3>;
template CellMask fill_dry(const NearCells<1>&, const SolidGeometry<1>&, Column&);
template CellMask fill_dry(const NearCells<2>&, const SolidGeometry<2>&, Column&);
template CellMask fill_dry(const NearCells<3>&, const SolidGeometry<3>&, Column&);

}  // namespace sluice::mpmice
