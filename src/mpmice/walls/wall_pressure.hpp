// The pressure between the fluid of a cell and the solid in it.
//
//   du = (u_s - u).nhat,  z = rho (c + A max(0, du)),  w = 1/(1 + z y)   (A shock slope dUs/du)
//   p_w = p + z w du + (1 - w) |n| (p_s - p),  at least p/10
// with nhat out of the solid, y = 1/(rho_s c_s) (0 where rigid) and p_s the pressure of the solid
// behind the surface: the Riemann problem of fluid and solid along the normal (mpmice_scheme, step
// 3). nhat is smoothed over the cells around, which stairs need; forces take n itself. Of solids
// that are light beside the fluid |n| and p_s are others (light_walls.cpp), and a fluid that bears
// tension has no least p_w there.
#pragma once
#include "mpmice/walls/fluid_states.hpp"
#include "mpmice/walls/light_walls.hpp"

namespace sluice::mpmice {

template <int D>
class WallPressure {
 public:
  // `slope`: A of the fluid; `reference`: the pressure at which solids are free of stress, Pa.
  WallPressure(bool implicit, double slope, double reference)
      : implicit_(implicit), slope_(slope), reference_(reference) {}

  // What the fluid of a cell resists a wall in it with at rest, kg/(m^2 s); 0 where no wall is.
  Column impedance(const NearCells<D>& near, const SolidGeometry<D>& solid,
                   const OnSurfaces<D>& surface, const FluidStates<D>& fluid,
                   const SmoothNormals<D>& normals, double dt) const;
  // p_w, in cells without fluid of two layers the mean of their neighbours.
  void find(const NearCells<D>& near, const SolidGeometry<D>& solid, const OnSurfaces<D>& surface,
            const FluidStates<D>& fluid, const SmoothNormals<D>& normals,
            const LightWalls<D>& light, double dt);
  // By cell, Pa.
  const Column& values() const { return values_; }

  static constexpr int columns = 1;

 private:
  struct Wall;
  double most_impedance(const Wall& wall, std::size_t i, double size) const;
  double approach_at_surface(const Wall& wall, const Cell<D>& c, std::size_t i, double size,
                             double du) const;
  double pressure_beside_wall(const Wall& wall, const Cell<D>& c, std::size_t i, double size) const;
  double press(const Wall& wall, const OnSurfaces<D>& surface, const LightWalls<D>& light,
               const Cell<D>& c, std::size_t i) const;

  bool implicit_;
  double slope_, reference_;
  Column values_;
};

// Cells without fluid, two layers deep: the mean of what their neighbours have. Beyond the domain
// as inside. Which are known then.
template <int D>
CellMask fill_dry(const NearCells<D>& near, const SolidGeometry<D>& solid, Column& values);

}  // namespace sluice::mpmice
