// Particles that are listed one by one.
#include <cmath>

#include "framework/geometry/sampling.hpp"
#include "mpm/start/corner_lattice.hpp"
#include "mpm/start/fill_object.hpp"

namespace sluice::mpm {
namespace {

double value(const std::vector<double>& column, std::size_t n, double standard) {
  return column.empty() ? standard : column[n];
}
Vec3 value(const std::vector<Vec3>& column, std::size_t n, Vec3 standard) {
  return column.empty() ? standard : column[n];
}

// Edge vectors in cells: those of the list, or those of the object's res.
Map edges_of(const ObjectOnLevel& what, const PointList& list, std::size_t n) {
  const SeedObject& o = what.object;
  const Vec3 h = what.level.spacing;
  Map edges{};
  for (int c = 0; c < 3; ++c) {
    Vec3 edge{};
    edge[c] = h[c] / o.per_cell[c];
    if (!list.edges.empty()) edge = list.edges[n][c];
    edge = applied(o.map, edge);
    for (int d = 0; d < 3; ++d) edges[3 * d + c] = edge[d] / h[d];
  }
  return edges;
}

// The list's, as the map changes it, or what the edges span: of a tetrahedron a sixth.
double volume_of(const ObjectOnLevel& what, const PointList& list, std::size_t n, Vec3 x,
                 const Map& edges) {
  if (!list.volume.empty()) return list.volume[n] * determinant(what.object.map);
  const Vec3 h = what.level.spacing;
  if (what.axisymmetric)
    return x.x * std::abs(edges[0] * edges[4] - edges[1] * edges[3]) * h.x * h.y;
  const double share = what.tetrahedra && !list.edges.empty() ? 1.0 / 6.0 : 1.0;
  return share * std::abs(determinant(edges)) * what.level.cell_volume();
}

// Nothing says which particles are neighbours: each has corners of its own, which span its volume.
void stand_alone(const CornerLattice& lattice, const Level& level, SeededParticle& row) {
  const double spanned = std::abs(determinant(row.edges)) * level.cell_volume();
  const double scale = std::pow(row.volume / spanned, 1.0 / level.active_count());
  Map edges = row.edges;
  for (std::size_t e = 0; e < 9; ++e)
    if (level.active[e / 3] && level.active[e % 3]) edges[e] *= scale;
  row.corners = lattice.alone(row.x, edges);
  span_corners(level, row);
}

}  // namespace

void seed_list(const ObjectOnLevel& what, const PointList& list, std::int64_t base,
               const IndexBox& target, std::span<const IndexBox> covered,
               SeededParticles& particles) {
  const SeedObject& o = what.object;
  const CellLattice lattice{what.level.anchor, what.level.spacing};
  const CornerLattice lattice_of_corners(o, what.level);
  for (std::size_t n = 0; n < list.place.size(); ++n) {
    SeededParticle row;
    row.x = o.mapped ? applied(o.map, list.place[n]) + o.shift : list.place[n];
    const IntVec3 cell = lattice.cell_of(row.x);
    if (!target.contains(cell) || is_covered(covered, cell)) continue;
    row.edges = edges_of(what, list, n);
    row.volume = volume_of(what, list, n, row.x, row.edges);
    if (what.columns.corners) stand_alone(lattice_of_corners, what.level, row);
    row.mass = what.density * row.volume;
    row.velocity = value(list.velocity, n, o.velocity);
    row.temperature = value(list.temperature, n, o.temperature);
    row.concentration = o.concentration;
    row.colour = value(list.colour, n, o.colour);
    row.id = base + static_cast<std::int64_t>(n);
    row.surface = true;  // nothing says where the body ends: loads ask for the place
    row.external_force = value(list.external_force, n, {});
    row.fibre = value(list.fibre, n, {});
    row.normal = value(list.normal, n, {});
    row.load_curve = value(list.load_curve, n, {});
    append(particles, row, what.columns);
  }
}

}  // namespace sluice::mpm
