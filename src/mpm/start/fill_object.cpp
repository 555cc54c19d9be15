// Filling a piece with particles at places of its cells.
#include "mpm/start/fill_object.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "mpm/start/corner_lattice.hpp"
#include "mpm/start/cut_cell.hpp"
#include "mpm/start/lattice_visit.hpp"

namespace sluice::mpm {

// Directions of more than one cell: those in which particles are halved or cut.
std::array<bool, 3> wide_directions(const Level& level) {
  const IntVec3 n = level.domain.size();
  return {n.x > 1, n.y > 1, n.z > 1};
}

IntVec3 res_of_size(IntVec3 res, int size, const std::array<bool, 3>& wide) {
  for (int d = 0; d < 3; ++d)
    if (wide[d]) res[d] <<= size;
  return res;
}

bool is_covered(std::span<const IndexBox> covered, IntVec3 cell) {
  return std::any_of(covered.begin(), covered.end(),
                     [&](const IndexBox& box) { return box.contains(cell); });
}

namespace {

constexpr double min_share = 1e-6;  // of a cut cell

// The distance of a neighbouring place, or, for cut parts, of a part's faces.
Vec3 reach_of(const SeedObject& object, const Level& level, const OptionalColumns& columns) {
  const IntVec3 n = object.per_cell;
  // Corners may be moved by what lies further away.
  const double parts = columns.corners ? CornerLattice::reach : 1.0;
  return parts * Vec3{level.spacing.x / n.x, level.spacing.y / n.y, level.spacing.z / n.z};
}

// Makes the particles of one object in one window.
class Filler {
 public:
  Filler(const ObjectOnLevel& what, const PlaceNumbers& numbers, const IndexBox& target,
         std::span<const IndexBox> covered, SeededParticles& particles)
      : what_(what),
        object_(what.object),
        level_(what.level),
        lattice_{level_.anchor, level_.spacing},
        wide_(wide_directions(level_)),
        numbers_(numbers),
        corners_(what.object, what.level),
        target_(target),
        covered_(covered),
        out_(particles) {}

  void fill(const IndexBox& cells) {
    const auto settled = [&](IntVec3 lower, IntVec3 upper) {
      for_each_cell({lower, upper}, [&](IntVec3 c) {
        for_parts(c, [&](IntVec3 part) {
          around_ = nullptr;
          emit_whole(c, part, 0, false);
        });
      });
    };
    const auto leaf = [&](const GeometryPiece& piece, IntVec3 c) {
      around_ = &piece;
      for_parts(c, [&](IntVec3 part) {
        if (object_.cut_cells && !what_.columns.corners)
          fill_cut(piece, c, part);
        else
          fill_part(piece, c, part, 0);
      });
    };
    LatticeVisit visit(lattice_, object_.per_cell, reach_of(object_, level_, what_.columns),
                       settled, leaf);
    visit.visit(*object_.piece, cells.lower, cells.upper);
  }

 private:
  template <class F>
  void for_parts(IntVec3 cell, F&& f) {
    if (!object_.mapped && is_covered(covered_, cell)) return;
    const IntVec3 n = object_.per_cell;
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) f(IntVec3{i, j, k});
  }

  Vec3 place(IntVec3 cell, IntVec3 part, IntVec3 res) const {
    return {lattice_.sub_point(0, cell.x, part.x, res.x),
            lattice_.sub_point(1, cell.y, part.y, res.y),
            lattice_.sub_point(2, cell.z, part.z, res.z)};
  }

  // The middle inside; N < 0: and the points halfway to the corners.
  bool holds_particle(const GeometryPiece& piece, Vec3 x, IntVec3 res) const {
    if (!piece.inside(x)) return false;
    if (object_.filling_levels >= 0 || what_.columns.corners) return true;
    for (int corner = 0; corner < 8; ++corner) {
      Vec3 p = x;
      for (int d = 0; d < 3; ++d) {
        const double quarter = wide_[d] ? 0.25 * level_.spacing[d] / res[d] : 0.0;
        p[d] += ((corner >> d) & 1) != 0 ? quarter : -quarter;
      }
      if (!piece.inside(p)) return false;
    }
    return true;
  }

  // Neighbouring places at one edge's distance.
  bool at_surface(const GeometryPiece& piece, Vec3 x, IntVec3 res) const {
    for (int d = 0; d < 3; ++d) {
      if (!wide_[d]) continue;
      const double step = level_.spacing[d] / res[d];
      for (const double to : {-step, step}) {
        Vec3 p = x;
        p[d] += to;
        if (!piece.inside(p)) return true;
      }
    }
    return false;
  }

  void fill_part(const GeometryPiece& piece, IntVec3 cell, IntVec3 part, int size) {
    const IntVec3 res = res_of_size(object_.per_cell, size, wide_);
    const Vec3 x = place(cell, part, res);
    if (holds_particle(piece, x, res)) {
      emit_whole(cell, part, size, at_surface(piece, x, res));
      return;
    }
    if (size + 1 >= std::abs(object_.filling_levels) || what_.columns.corners) return;
    IntVec3 children{1, 1, 1};
    for (int d = 0; d < 3; ++d)
      if (wide_[d]) children[d] = 2;
    for (int k = 0; k < children.z; ++k)
      for (int j = 0; j < children.y; ++j)
        for (int i = 0; i < children.x; ++i)
          fill_part(piece, cell, part * children + IntVec3{i, j, k}, size + 1);
  }

  void fill_cut(const GeometryPiece& piece, IntVec3 cell, IntVec3 part) {
    const IntVec3 res = object_.per_cell;
    const Vec3 x = place(cell, part, res);
    const Vec3 half = 0.5 * reach_of(object_, level_, what_.columns);
    const CutPart cut = part_inside(piece, {x - half, x + half}, wide_);
    if (cut.share < min_share) return;
    if (cut.share >= 1)
      emit_whole(cell, part, 0, at_surface(piece, x, res));
    else
      emit(cell, part, 0, cut.centroid, cut.share, true);
  }

  void emit_whole(IntVec3 cell, IntVec3 part, int size, bool surface) {
    emit(cell, part, size, place(cell, part, res_of_size(object_.per_cell, size, wide_)), 1.0,
         surface);
  }

  std::int64_t id_of(IntVec3 cell, IntVec3 part, int size, IntVec3 res) const {
    const IndexBox& own = numbers_.window;
    const auto number = [&](int d) {
      return static_cast<std::int64_t>(cell[d] - own.lower[d]) * res[d] + part[d];
    };
    const std::int64_t row = static_cast<std::int64_t>(own.size().x) * res.x;
    const std::int64_t plane = row * own.size().y * res.y;
    return numbers_.bases[size] + number(2) * plane + number(1) * row + number(0);
  }

  double volume_of(Vec3 x, IntVec3 res) const {
    const Map& a = object_.map;
    const Vec3 h = level_.spacing;
    if (what_.axisymmetric)
      return x.x * (a[0] * a[4] - a[1] * a[3]) * (h.x * h.y) / (res.x * res.y);
    return determinant(a) * level_.cell_volume() / (static_cast<double>(res.x) * res.y * res.z);
  }

  // Edges of a cut part are shortened so that they span its volume.
  Map edges_of(IntVec3 res, double share) const {
    const auto wide = static_cast<double>(std::count(wide_.begin(), wide_.end(), true));
    const double shortened = share < 1 ? std::pow(share, 1 / wide) : 1.0;
    Map edges = object_.map;
    for (std::size_t n = 0; n < 9; ++n)
      edges[n] *= (wide_[n % 3] ? shortened : 1.0) / res[static_cast<int>(n % 3)];
    return edges;
  }

  void emit(IntVec3 cell, IntVec3 part, int size, Vec3 x, double share, bool surface) {
    if (object_.mapped) {
      x = applied(object_.map, x) + object_.shift;
      const IntVec3 to = lattice_.cell_of(x);
      if (!target_.contains(to) || is_covered(covered_, to)) return;
    }
    const IntVec3 res = res_of_size(object_.per_cell, size, wide_);
    SeededParticle row;
    row.x = x;
    row.velocity = object_.velocity;
    row.volume = volume_of(x, res) * share;
    row.edges = edges_of(res, share);
    if (what_.columns.corners) {
      row.corners = corners_.corners_of(around_, cell, part);
      span_corners(level_, row);
    }
    row.mass = what_.density * row.volume;
    row.temperature = object_.temperature;
    row.concentration = object_.concentration;
    row.colour = object_.colour;
    row.id = id_of(cell, part, size, res);
    row.surface = surface;
    append(out_, row, what_.columns);
  }

  const ObjectOnLevel& what_;
  const SeedObject& object_;
  const Level& level_;
  CellLattice lattice_;
  std::array<bool, 3> wide_;
  const PlaceNumbers& numbers_;
  CornerLattice corners_;
  const GeometryPiece* around_ = nullptr;  // what the piece is around the part in hand; null: all
  IndexBox target_;
  std::span<const IndexBox> covered_;
  SeededParticles& out_;
};

}  // namespace

void fill_object(const ObjectOnLevel& object, const PlaceNumbers& numbers, const IndexBox& cells,
                 const IndexBox& target, std::span<const IndexBox> covered,
                 SeededParticles& particles) {
  Filler(object, numbers, target, covered, particles).fill(cells);
}

}  // namespace sluice::mpm
