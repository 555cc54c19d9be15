// Visiting the cells of a window that a piece fills, without looking at those that it leaves empty.
#pragma once
#include <utility>

#include "framework/geometry/piece.hpp"
#include "framework/geometry/sampling.hpp"

namespace sluice::mpm {

// Calls settled(lower, upper) for blocks of cells that the piece covers with a margin of `reach`
// (m) around their sub-points, and leaf(piece, cell) for each other cell that it may have a part
// in, with a piece that has the same points there. Blocks that it has no part in cost nothing.
template <class Settled, class Leaf>
class LatticeVisit {
 public:
  LatticeVisit(const CellLattice& lattice, IntVec3 res, Vec3 reach, Settled settled, Leaf leaf)
      : lattice_(lattice),
        res_(res),
        reach_(reach),
        settled_(std::move(settled)),
        leaf_(std::move(leaf)) {}

  // Cells of [lower, upper).
  void visit(const GeometryPiece& whole, IntVec3 lower, IntVec3 upper) {
    const IntVec3 n = upper - lower;
    if (n.x <= 0 || n.y <= 0 || n.z <= 0) return;
    const Bounds window = window_of(lower, upper);
    const Cover cover = whole.cover(window);
    if (cover == Cover::none) return;
    if (cover == Cover::all) return settled_(lower, upper);
    const PiecePtr part = whole.restricted(window);
    const GeometryPiece& piece = part ? *part : whole;
    if (n == IntVec3{1, 1, 1}) return leaf_(piece, lower);
    // Halves along the longest direction.
    const int d = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
    IntVec3 middle_up = upper, middle_down = lower;
    middle_up[d] = middle_down[d] = lower[d] + n[d] / 2;
    visit(piece, lower, middle_up);
    visit(piece, middle_down, upper);
  }

 private:
  Bounds window_of(IntVec3 lower, IntVec3 upper) const {
    Bounds b;
    for (int d = 0; d < 3; ++d) {
      b.lower[d] = lattice_.sub_point(d, lower[d], 0, res_[d]) - reach_[d];
      b.upper[d] = lattice_.sub_point(d, upper[d] - 1, res_[d] - 1, res_[d]) + reach_[d];
    }
    return b;
  }

  const CellLattice& lattice_;
  IntVec3 res_;
  Vec3 reach_;
  Settled settled_;
  Leaf leaf_;
};

}  // namespace sluice::mpm
