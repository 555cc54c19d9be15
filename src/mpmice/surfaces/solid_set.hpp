// The sets of particles of all solids on a level, with the outer faces of each.
#pragma once
#include <vector>

#include "framework/run/levels/particle_cloud.hpp"
#include "models/burn/burn_law.hpp"
#include "models/burn/ddt1.hpp"
#include "mpmice/fields/frame.hpp"
#include "mpmice/geometry/pieces.hpp"
#include "mpmice/geometry/solid_particles.hpp"
#include "solids/coupled_solids.hpp"

namespace sluice::mpmice {

template <int D>
struct SolidSet {
  int kind = 0;
  const solids::ParticleColumns* columns = nullptr;
  const ParticleSet* set = nullptr;
  ParticleSet* next = nullptr;  // null: the particles do not move
  OuterFaces<D> faces;
  CutSurface<D> pieces;  // of the faces, at the start of the step
  // Of particles that burn: what is left of each as the present step has it so far, the faces
  // that are outer since the last one vanished, what surfaces remember (empty: nothing).
  ParticleSet* present = nullptr;  // the set, for what a step leaves behind
  KeptArray<double> filled, stays;
  KeptArray<std::uint8_t> outer;
  std::vector<models::SurfaceHistory> surface;
  std::vector<models::Ignition> flame;  // that comes to each; empty: none needs time
  // Faces that are outer since solids parted in this step, bits by particle; empty: none.
  KeptArray<std::uint8_t> parted;
  KeptArray<std::uint8_t> moves;    // cells by which particles may move in the step
  KeptArray<std::uint8_t> dropped;  // 1: leaves the domain in this step; empty: none does

  bool burns() const { return columns->filled >= 0; }
};

// Columns first, first + 1, ... of a set; null: it has none.
template <std::size_t N>
std::array<const double*, N> columns_from(const ParticleSet& set, int first) {
  std::array<const double*, N> to{};
  for (std::size_t n = 0; n < N && first >= 0; ++n)
    to[n] = set.column(static_cast<std::size_t>(first) + n);
  return to;
}

// Corners of a set in the columns that the geometry takes.
template <int D>
CornerColumns<D> corner_columns(const Frame<D>& frame, const solids::ParticleColumns& c,
                                const ParticleSet& set) {
  CornerColumns<D> to;
  for (std::size_t k = 0; k < to.size(); ++k)
    for (std::size_t a = 0; a < D; ++a)
      to[k][a] = set.column(
          static_cast<std::size_t>(c.corners + 3 * static_cast<int>(k) + frame.direction[a]));
  return to;
}

// Cells by which the particles of a set may move in a step, by their velocities as it begins.
template <int D>
KeptArray<std::uint8_t> moves_of(const Frame<D>& frame, const solids::ParticleColumns& c,
                                 const ParticleSet& set, double dt) {
  KeptArray<std::uint8_t> moves(set.size(), Frame<D>::slow_move);
  for (const int d : frame.direction) {
    const double* v = set.column(static_cast<std::size_t>(c.velocity + d));
    const double most = Frame<D>::slow * frame.spacing[d] / dt;
    for (std::size_t p = 0; p < set.size(); ++p)
      moves[p] = std::fabs(v[p]) <= most ? moves[p] : std::uint8_t{Frame<D>::most_move};
  }
  return moves;
}

// Adds the cells in which particles of a set with these corners may lie as they move by so many
// cells; empty: they rest.
template <int D>
void add_cells_of(const Frame<D>& frame, const CornerColumns<D>& corners, std::size_t count,
                  const KeptArray<std::uint8_t>& moves, OccupiedCells<D>& to) {
  constexpr std::size_t chunk = 64;
  int low[D][chunk], high[D][chunk];
  for (std::size_t at = 0; at < count; at += chunk) {
    const std::size_t n = std::min(chunk, count - at);
    for (std::size_t a = 0; a < D; ++a) {
      double least[chunk], most[chunk];
      std::fill_n(least, chunk, 1e300);
      std::fill_n(most, chunk, -1e300);
      for (const auto& corner : corners)
        for (std::size_t q = 0; q < n; ++q) {
          const double x = corner[a][at + q];
          least[q] = std::min(least[q], x);
          most[q] = std::max(most[q], x);
        }
      for (std::size_t q = 0; q < n; ++q) {
        low[a][q] = frame.cell_at(least[q], a);
        high[a][q] = frame.cell_at(most[q], a);
      }
    }
    for (std::size_t q = 0; q < n; ++q) {
      CellBox<D> cells;
      for (std::size_t a = 0; a < D; ++a) {
        cells.lower[a] = low[a][q];
        cells.upper[a] = high[a][q] + 1;
      }
      to.add(cells, moves.empty() ? 0 : moves[at + q]);
    }
  }
}

// Radii of cracks of particles as the step ends, m; null: the law of the solid has none.
template <int D>
const double* crack_radii(const SolidSet<D>& s) {
  const int column = s.columns->crack_radius;
  return column < 0 ? nullptr : s.next->column(static_cast<std::size_t>(column));
}

// Bits of the faces that no other particle shares.
template <int D>
KeptArray<std::uint8_t> outer_faces_of(const SolidSet<D>& s) {
  KeptArray<std::uint8_t> faces(s.set->size());
  const double* bits = s.set->column(static_cast<std::size_t>(s.columns->outer));
  for (std::size_t p = 0; p < faces.size(); ++p) faces[p] = static_cast<std::uint8_t>(bits[p]);
  for (std::size_t p = 0; p < s.parted.size(); ++p) faces[p] |= s.parted[p];
  for (std::size_t p = 0; p < s.dropped.size(); ++p)
    if (s.dropped[p] != 0) faces[p] = 0;
  return faces;
}

// Faces count by what is left of their particles; which of them are inner ones.
template <int D>
void weigh_faces(SolidSet<D>& s) {
  if (!s.burns()) return;
  KeptArray<std::uint8_t> outer = outer_faces_of(s);
  if (s.outer.size() == outer.size())
    for (std::size_t p = 0; p < outer.size(); ++p) outer[p] |= s.outer[p];
  s.faces.weight.resize(s.faces.size());
  s.faces.inner.resize(s.faces.size());
  for (std::size_t i = 0; i < s.faces.size(); ++i) {
    const std::size_t p = s.faces.particle[i];
    s.faces.weight[i] = s.filled[p];
    s.faces.inner[i] = (outer[p] >> s.faces.face[i] & 1) == 0 ? 1 : 0;
  }
}

// From lengths to cells of the level.
template <int D>
CellUnits<D> cell_units(const Frame<D>& frame) {
  CellUnits<D> units;
  for (std::size_t a = 0; a < D; ++a) {
    units.origin[a] = frame.anchor[frame.direction[a]];
    units.inverse[a] = 1 / frame.spacing[frame.direction[a]];
  }
  return units;
}

// Its particles as bodies of their own, at both ends of the step where they have `moved`.
template <int D>
SolidParticles<D> particles_of(const Frame<D>& frame, const SolidSet<D>& s, bool moved) {
  SolidParticles<D> to;
  to.start = corner_columns<D>(frame, *s.columns, *s.set);
  to.end = moved ? corner_columns<D>(frame, *s.columns, *s.next) : to.start;
  to.units = cell_units(frame);
  to.count = s.set->size();
  if (s.burns()) to.filled = s.filled.data();
  if (!s.dropped.empty()) to.dropped = s.dropped.data();
  return to;
}

// What is left of particles that burn, as the step begins.
template <int D>
void read_filled(SolidSet<D>& s) {
  if (!s.burns()) return;
  const double* filled = s.set->column(static_cast<std::size_t>(s.columns->filled));
  s.filled.assign(filled, filled + s.set->size());
}

// What their surfaces remember, as the step begins.
template <int D>
void read_surfaces(SolidSet<D>& s) {
  s.surface.clear();
  if (s.columns->surface < 0) return;
  const double* T = s.set->column(static_cast<std::size_t>(s.columns->surface));
  const double* gradient = s.set->column(static_cast<std::size_t>(s.columns->surface) + 1);
  for (std::size_t p = 0; p < s.set->size(); ++p) s.surface.push_back({T[p], gradient[p]});
}

// What they know of flames, as the step begins.
template <int D>
void read_flames(SolidSet<D>& s) {
  s.flame.clear();
  if (s.columns->flame < 0) return;
  const auto first = static_cast<std::size_t>(s.columns->flame);
  const double *kind = s.set->column(first), *come = s.set->column(first + 1),
               *time = s.set->column(first + 2), *way = s.set->column(first + 3);
  for (std::size_t p = 0; p < s.set->size(); ++p)
    s.flame.push_back(
        {static_cast<models::Ignition::Kind>(static_cast<int>(kind[p])), come[p], time[p], way[p]});
}

// Takes the faces of a set with these bits, at both ends of the step where `moved`.
template <int D>
void find_faces(const Frame<D>& frame, SolidSet<D>& s, bool moved, KeptArray<std::uint8_t> outer) {
  const CornerColumns<D> from = corner_columns<D>(frame, *s.columns, *s.set);
  const CornerColumns<D> to = moved ? corner_columns<D>(frame, *s.columns, *s.next) : from;
  s.faces.clear();
  s.faces.add(from, moved ? &to : nullptr, outer.data(), outer.size(), cell_units(frame));
  weigh_faces(s);
}

// Sums over parts of particles have room for so many of the heaviest in a cell.
template <int D>
inline constexpr double most_parts = 1024 << D;

// act(place in the arrays): for a 2^D-th of particle p half way between its middle and each corner.
template <int D, class F>
void for_each_part(const Frame<D>& frame, const CornerColumns<D>& corners, const ParticleSet& set,
                   std::size_t p, F&& act) {
  Cell<D> cells[corners_of_particle<D>];
  for (std::size_t a = 0; a < D; ++a) {
    const int d = frame.direction[a];
    const double middle = set.coordinate(d)[p], origin = frame.anchor[d], width = frame.spacing[d];
    double place[corners_of_particle<D>];
    for (std::size_t k = 0; k < corners.size(); ++k)
      place[k] = std::floor((0.5 * (corners[k][a][p] + middle) - origin) / width);
    for (std::size_t k = 0; k < corners.size(); ++k) cells[k][a] = static_cast<int>(place[k]);
  }
  for (const Cell<D>& c : cells) act(frame.cells.index(frame.inside(c)));
}

}  // namespace sluice::mpmice
