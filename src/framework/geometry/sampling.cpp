// How much of a cell a piece fills, by counting sub-points.
#include "framework/geometry/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sluice {

namespace {

std::int32_t points_in_cell(const std::vector<Vec3>& points, const CellLattice& lattice,
                            IntVec3 cell) {
  std::int32_t n = 0;
  for (Vec3 p : points) n += lattice.cell_of(p) == cell;
  return n;
}

// The box from one sub-point to another.
Bounds box_between(const CellLattice& lattice, IntVec3 low_cell, IntVec3 low, IntVec3 high_cell,
                   IntVec3 high, IntVec3 res) {
  Bounds b;
  for (int d = 0; d < 3; ++d) {
    b.lower[d] = lattice.sub_point(d, low_cell[d], low[d], res[d]);
    b.upper[d] = lattice.sub_point(d, high_cell[d], high[d], res[d]);
  }
  return b;
}

// The box of all sub-points of the cells: its ends are sub-points themselves.
Bounds sub_points(const CellLattice& lattice, IntVec3 lower, IntVec3 upper, IntVec3 res) {
  return box_between(lattice, lower, {0, 0, 0}, upper - IntVec3::all(1), res - IntVec3::all(1),
                     res);
}

// A block halved along its longest direction: [lower, middle up) and [middle down, upper).
struct Halves {
  IntVec3 middle_up, middle_down;
  bool one_cell;
};
Halves halves(IntVec3 lower, IntVec3 upper) {
  const IntVec3 n = upper - lower;
  const int d = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  Halves h{upper, lower, n[d] == 1};
  h.middle_up[d] = h.middle_down[d] = lower[d] + n[d] / 2;
  return h;
}

// Of the points [first, end) of one cell; where they are many, by halves, so that only those near
// the surface are asked one by one.
std::int32_t count_in_cell(const GeometryPiece& piece, const CellLattice& lattice, IntVec3 cell,
                           IntVec3 first, IntVec3 end, IntVec3 res) {
  constexpr int few = 32;
  const IntVec3 size = end - first;
  const std::int32_t points = size.x * size.y * size.z;
  if (points > few) {
    const Cover c =
        piece.cover(box_between(lattice, cell, first, cell, end - IntVec3::all(1), res));
    if (c != Cover::some) return c == Cover::all ? points : 0;
    const Halves h = halves(first, end);
    return count_in_cell(piece, lattice, cell, first, h.middle_up, res) +
           count_in_cell(piece, lattice, cell, h.middle_down, end, res);
  }
  std::int32_t n = 0;
  for (int c = first.z; c < end.z; ++c)
    for (int b = first.y; b < end.y; ++b)
      for (int a = first.x; a < end.x; ++a)
        n += piece.inside({lattice.sub_point(0, cell.x, a, res.x),
                           lattice.sub_point(1, cell.y, b, res.y),
                           lattice.sub_point(2, cell.z, c, res.z)});
  return n;
}

// Counts over a range of cells by halving blocks until a block is settled or is one cell.
class Counter {
 public:
  Counter(const CellLattice& lattice, IntVec3 lower, IntVec3 upper, IntVec3 res)
      : lattice_(lattice), lower_(lower), size_(upper - lower), res_(res) {
    counts_.assign(static_cast<std::size_t>(size_.x) * size_.y * size_.z, 0);
  }

  void visit(const GeometryPiece& whole, IntVec3 lower, IntVec3 upper) {
    const Bounds window = sub_points(lattice_, lower, upper, res_);
    const Cover c = whole.cover(window);
    if (c == Cover::none) return;
    if (c == Cover::all) return fill(lower, upper);
    const PiecePtr part = whole.restricted(window);
    const GeometryPiece& piece = part ? *part : whole;
    const Halves h = halves(lower, upper);
    if (h.one_cell) {
      at(lower) = count_inside(piece, lattice_, lower, res_);
      return;
    }
    visit(piece, lower, h.middle_up);
    visit(piece, h.middle_down, upper);
  }

  std::vector<std::int32_t> take() { return std::move(counts_); }

 private:
  std::int32_t& at(IntVec3 c) {
    const IntVec3 o = c - lower_;
    return counts_[o.x + size_.x * (o.y + static_cast<std::size_t>(size_.y) * o.z)];
  }
  void fill(IntVec3 lower, IntVec3 upper) {
    const std::int32_t full = res_.x * res_.y * res_.z;
    for (int k = lower.z; k < upper.z; ++k)
      for (int j = lower.y; j < upper.y; ++j) {
        std::int32_t* row = &at({lower.x, j, k});
        for (int i = 0; i < upper.x - lower.x; ++i) row[i] = full;
      }
  }

  const CellLattice& lattice_;
  IntVec3 lower_, size_, res_;
  std::vector<std::int32_t> counts_;
};

}  // namespace

IntVec3 CellLattice::cell_of(Vec3 p) const {
  IntVec3 c;
  for (int d = 0; d < 3; ++d) c[d] = static_cast<int>(std::floor((p[d] - anchor[d]) / spacing[d]));
  return c;
}

std::int32_t count_inside(const GeometryPiece& piece, const CellLattice& lattice, IntVec3 cell,
                          IntVec3 res) {
  if (const std::vector<Vec3>* points = piece.points())
    return points_in_cell(*points, lattice, cell);
  return count_in_cell(piece, lattice, cell, {0, 0, 0}, res, res);
}

std::vector<std::int32_t> count_inside(const GeometryPiece& piece, const CellLattice& lattice,
                                       IntVec3 lower, IntVec3 upper, IntVec3 res) {
  const IntVec3 n = upper - lower;
  if (n.x <= 0 || n.y <= 0 || n.z <= 0) return {};
  if (const std::vector<Vec3>* points = piece.points()) {
    std::vector<std::int32_t> counts(static_cast<std::size_t>(n.x) * n.y * n.z, 0);
    for (Vec3 p : *points) {
      const IntVec3 c = lattice.cell_of(p) - lower;
      if (c.x < 0 || c.y < 0 || c.z < 0 || c.x >= n.x || c.y >= n.y || c.z >= n.z) continue;
      ++counts[c.x + n.x * (c.y + static_cast<std::size_t>(n.y) * c.z)];
    }
    return counts;
  }
  Counter counter(lattice, lower, upper, res);
  counter.visit(piece, lower, upper);
  return counter.take();
}

bool any_inside(const GeometryPiece& whole, const CellLattice& lattice, IntVec3 lower,
                IntVec3 upper, IntVec3 res) {
  const IntVec3 n = upper - lower;
  if (n.x <= 0 || n.y <= 0 || n.z <= 0) return false;
  if (const std::vector<Vec3>* points = whole.points())
    return std::any_of(points->begin(), points->end(), [&](Vec3 p) {
      const IntVec3 c = lattice.cell_of(p);
      return c.x >= lower.x && c.y >= lower.y && c.z >= lower.z && c.x < upper.x && c.y < upper.y &&
             c.z < upper.z;
    });
  const Bounds window = sub_points(lattice, lower, upper, res);
  const Cover c = whole.cover(window);
  if (c != Cover::some) return c == Cover::all;
  const PiecePtr part = whole.restricted(window);
  const GeometryPiece& piece = part ? *part : whole;
  const Halves h = halves(lower, upper);
  if (h.one_cell) return count_inside(piece, lattice, lower, res) > 0;
  return any_inside(piece, lattice, lower, h.middle_up, res) ||
         any_inside(piece, lattice, h.middle_down, upper, res);
}

}  // namespace sluice
