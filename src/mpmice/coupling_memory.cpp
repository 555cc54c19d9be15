// Counting the numbers that the coupling keeps of a cell, and the cells that it keeps.
#include "mpmice/coupling_memory.hpp"

#include <algorithm>

#include "mpmice/mpmice.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {
namespace {

Bounds bounds_of(const mpm::SeedObject& object) {
  const Bounds piece = object.piece->bounds();
  if (!object.mapped) return piece;
  Bounds image = Bounds::nothing();
  for (int n = 0; n < 8; ++n) {
    const Vec3 x = piece.corner(n);
    Vec3 to = object.shift;
    for (int d = 0; d < 3; ++d)
      for (int e = 0; e < 3; ++e) to[d] += object.map[static_cast<std::size_t>(3 * d + e)] * x[e];
    image = bounding(image, {to, to});
  }
  return image;
}

// The cells of the domain in which solids are at the start.
template <int D>
OccupiedCells<D> cells_of_pieces(const Frame<D>& frame, const mpm::MpmScene& scene) {
  OccupiedCells<D> cells;
  cells.begin(frame.room());
  for (const mpm::SolidMaterial& material : scene.materials)
    for (const mpm::SeedObject& object : material.objects) {
      const Bounds bounds = bounds_of(object);
      CellBox<D> of;
      for (std::size_t a = 0; a < D; ++a) {
        const int d = frame.direction[a];
        const auto cell = [&](double x) {  // pieces may reach to infinity
          const double n = (x - frame.anchor[d]) / frame.spacing[d];
          return std::clamp<double>(n, frame.domain.lower[a], frame.domain.upper[a]);
        };
        of.lower[a] = static_cast<int>(std::floor(cell(bounds.lower[d]))) - Frame<D>::slow_move;
        of.upper[a] = static_cast<int>(std::ceil(cell(bounds.upper[d]))) + Frame<D>::slow_move;
      }
      cells.add(of);
    }
  return cells;
}

// What a step keeps of a cell, as its classes lay it out, and the most that its temporaries hold
// beside.
template <int D>
double bytes_per_cell(const MpmIce& both) {
  const ice::FluidPart& fluid = both.fluid().part();
  const ice::SchemeOptions& o = fluid.options();
  const int fluids = static_cast<int>(o.materials.fluids.size());
  const bool viscous = o.transport.viscous;
  const int solids = SolidGeometry<D>::columns + OnSurfaces<D>::columns + MeanMotion<D>::columns;
  const int walls = FluidStates<D>::columns + SmoothNormals<D>::columns + WallPressure<D>::columns +
                    WallForces<D>::columns + (o.scheme.implicit ? LightWalls<D>::columns : 0) +
                    (viscous ? WallFriction<D>::columns : -D - 1);  // no places, no viscosity
  const int amounts = FluidAmounts<D>::columns(fluid) + 1;       // and the volume
  // Sums: of free cells, at one time, swept (with the numbers of facet groups and theta of both),
  // over surfaces, what the last step left; the fluid's states, its amounts; of solids in cells.
  const int geometry = 2 + 2 * D + 3 * D + (D == 3 ? 16 : 0) + 2;
  const int sums = geometry + SurfaceMeans<D>::lane_count(viscous) + 1 + FluidStates<D>::lanes +
                   amounts + MeanMotion<D>::columns;
  const int products = both.burns().empty() ? 0 : fluids;
  const bool exchanges = exchanges_through_surfaces(fluid, both.solids().material_count());
  const int temporary = exchanges ? SurfaceExchange<D>::columns(fluids) : 2 * D + 3;
  constexpr int flags = 10;  // bytes
  return 8.0 * (solids + walls + sums + 2 * amounts + 1 + products + temporary) + flags;
}

template <int D>
double bytes_of(const MpmIce& both, const Level& level) {
  Frame<D> frame(level);
  frame.look_at(cells_of_pieces<D>(frame, both.solids().scene()));
  if (frame.cells.block_count() == 0) return 0;
  return bytes_per_cell<D>(both) * static_cast<double>(frame.cells.size());
}

}  // namespace

double coupling_bytes(const MpmIce& both, const Level& level) {
  switch (level.active_count()) {
    case 1:
      return bytes_of<1>(both, level);
    case 2:
      return bytes_of<2>(both, level);
    default:
      return bytes_of<3>(both, level);
  }
}

}  // namespace sluice::mpmice
