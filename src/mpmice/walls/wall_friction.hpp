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
#pragma once
#include "mpmice/fields/cell_amounts.hpp"
#include "mpmice/walls/fluid_states.hpp"
#include "mpmice/walls/smooth_normals.hpp"

namespace sluice::mpmice {

template <int D>
class WallFriction {
 public:
  // t in each cell with a wall, of a step of dt.
  void find(const NearCells<D>& near, const SolidGeometry<D>& solid, const OnSurfaces<D>& surface,
            const FluidStates<D>& fluid, const SmoothNormals<D>& normals, double dt);
  // Pa, along the d-th direction.
  const Column& along(std::size_t d) const { return stress_[d]; }
  // What the fluid gives to surfaces leaves the amounts of its cells. `component`: of their
  // momentum, by direction of the grid; -1: none is carried.
  void take(const NearCells<D>& near, const OnSurfaces<D>& surface,
            const std::array<int, 3>& component, double dt, CellAmounts<D>& amounts) const;

  static constexpr int columns = D;

 private:
  struct BeforeSurface {
    std::size_t cell;
    double distance;  // m
  };
  BeforeSurface before(const Frame<D>& frame, const SolidGeometry<D>& solid,
                       const OnSurfaces<D>& surface, const Cell<D>& c, std::size_t i,
                       const std::array<double, D>& unit) const;

  std::array<Column, D> stress_;
};

}  // namespace sluice::mpmice
