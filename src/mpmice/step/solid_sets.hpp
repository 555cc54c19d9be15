// The sets of particles of all solids on a level, with the outer faces of each.
#pragma once
#include <cmath>
#include <vector>

#include "framework/run/particle_cloud.hpp"
#include "mpm/mpm.hpp"
#include "mpmice/geometry/outer_faces.hpp"
#include "mpmice/step/solid_fields.hpp"

namespace sluice::mpmice {

template <int D>
struct SolidSet {
  int kind = 0;
  const mpm::Columns* columns = nullptr;
  int part = -1;  // column of mpm::Carried::filled, of particles that burn
  const ParticleSet* set = nullptr;
  ParticleSet* next = nullptr;  // null: the particles do not move
  OuterFaces<D> faces;
  // Of particles that burn: what is left of each as the present step has it so far, and the faces
  // that are outer since the last one vanished.
  ParticleSet* present = nullptr;  // the set, for what a step leaves behind
  std::vector<double> filled, stays;
  std::vector<std::uint8_t> outer;
};

// Corners of a set in the columns that the geometry takes.
template <int D>
CornerColumns<D> corner_columns(const Frame<D>& frame, const mpm::Columns& c,
                                const ParticleSet& set) {
  CornerColumns<D> to;
  for (std::size_t k = 0; k < to.size(); ++k)
    for (std::size_t a = 0; a < D; ++a)
      to[k][a] = set.column(
          static_cast<std::size_t>(c.corners + 3 * static_cast<int>(k) + frame.direction[a]));
  return to;
}

// Bits of the faces over which surfaces are summed: those that no other particle shares; of
// particles that burn all, since a neighbour may be solid in another part.
template <int D>
std::vector<std::uint8_t> faces_in_sums(const SolidSet<D>& s) {
  std::vector<std::uint8_t> faces(s.set->size(), (1 << faces_of_particle<D>)-1);
  if (s.part >= 0) return faces;
  const double* bits = s.set->column(static_cast<std::size_t>(s.columns->outer));
  for (std::size_t p = 0; p < faces.size(); ++p) faces[p] = static_cast<std::uint8_t>(bits[p]);
  return faces;
}

// Faces count by what is left of their particles.
template <int D>
void weigh_faces(SolidSet<D>& s) {
  if (s.part < 0) return;
  s.faces.weight.resize(s.faces.size());
  for (std::size_t i = 0; i < s.faces.size(); ++i)
    s.faces.weight[i] = s.filled[s.faces.particle[i]];
}

// Finds the outer faces of a set, at both ends of the step where `moved`.
template <int D>
void find_faces(const Frame<D>& frame, SolidSet<D>& s, bool moved) {
  CellUnits<D> units;
  if (!moved && s.part >= 0) {
    const double* filled = s.set->column(static_cast<std::size_t>(s.part));
    s.filled.assign(filled, filled + s.set->size());
  }
  for (std::size_t a = 0; a < D; ++a) {
    units.origin[a] = frame.anchor[frame.direction[a]];
    units.inverse[a] = 1 / frame.spacing[frame.direction[a]];
  }
  const std::vector<std::uint8_t> outer = faces_in_sums(s);
  const CornerColumns<D> from = corner_columns<D>(frame, *s.columns, *s.set);
  s.faces.clear();
  if (moved) {
    const CornerColumns<D> to = corner_columns<D>(frame, *s.columns, *s.next);
    s.faces.add(from, &to, outer.data(), outer.size(), units);
  } else {
    s.faces.add(from, nullptr, outer.data(), outer.size(), units);
  }
  weigh_faces(s);
}

// Sums over parts of particles have room for so many of the heaviest in a cell.
template <int D>
inline constexpr double most_parts = 1024 << D;

// act(place in the arrays): for a 2^D-th of particle p half way between its middle and each corner.
template <int D, class F>
void for_each_part(const Frame<D>& frame, const CornerColumns<D>& corners, const ParticleSet& set,
                   std::size_t p, F&& act) {
  for (const auto& corner : corners) {
    Cell<D> c;
    for (std::size_t a = 0; a < D; ++a) {
      const int d = frame.direction[a];
      const double x = 0.5 * (corner[a][p] + set.coordinate(d)[p]);
      c[a] = static_cast<int>(std::floor((x - frame.anchor[d]) / frame.spacing[d]));
    }
    act(frame.box.index(frame.inside(c)));
  }
}

}  // namespace sluice::mpmice
