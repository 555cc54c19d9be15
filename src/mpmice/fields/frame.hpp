// A level as the coupling counts it: its active directions, its cells near solids.
//
// Arrays are over blocks of cells near solids. A rank has those near its own boxes; what it knows
// of the cells of others there comes as exact sums and as bits of one owner, so that no bit depends
// on boxes or ranks. Directions are the active ones.
#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

#include "framework/grid/level.hpp"
#include "mpmice/geometry/cell_sums.hpp"
#include "mpmice/geometry/occupied_cells.hpp"
#include "mpmice/geometry/periodic_sides.hpp"

namespace sluice::mpmice {

// Active directions of a level, and cells of it as the geometry counts them.
template <int D>
struct Frame {
  // Of cells beyond the sides; beyond periodic ones particles stay a while before they are taken to
  // the other end.
  static constexpr int layers = layers_beyond, periodic_layers = 4;
  // Cells by which solids may move in a step, in a slow one, and by which what they do reaches
  // beyond them.
  static constexpr int most_move = 2, slow_move = 1, reach = 3;
  // Cells in a step from which on a solid is not slow.
  static constexpr double slow = 0.5;
  std::array<int, D> direction{};
  Vec3 spacing{}, anchor{};
  double cell_volume = 1;
  IntVec3 base{};                  // index along directions that are not active
  CellBox<D> domain;               // its cells
  CellBlocks<D> cells;             // those near solids, over which the arrays are
  std::array<bool, D> periodic{};  // sides that solids are near, as far as this rank sees

  explicit Frame(const Level& level) {
    int a = 0;
    for (int d = 0; d < 3; ++d) {
      base[d] = level.domain.lower[d];
      if (!level.active[static_cast<std::size_t>(d)]) continue;
      const auto n = static_cast<std::size_t>(a++);
      direction[n] = d;
      repeats_[n] = level.periodic[static_cast<std::size_t>(d)];
      domain.lower[n] = level.domain.lower[d];
      domain.upper[n] = level.domain.upper[d];
    }
    OccupiedCells<D> none;
    none.begin(room());
    look_at(none);
    spacing = level.spacing;
    anchor = level.anchor;
    cell_volume = level.cell_volume();
  }
  // Cells in which solids may lie: layers beyond the sides too.
  CellBox<D> room() const { return with_layers(repeats_); }
  // To solids that lie in these cells in the step: the arrays are over all that it may touch, of
  // the blocks that this rank has.
  void look_at(const OccupiedCells<D>& solids, const BlockSharers<D>* sharers = nullptr) {
    cells.begin(room(), sharers);
    for (const CellBox<D>& box : solids.boxes()) add_images(touched_around(box), 0);
    cells.finish();
    for (std::size_t a = 0; a < D; ++a) {
      periodic[a] = false;
      for (std::size_t b = 1; b <= cells.block_count() && repeats_[a] && !periodic[a]; ++b) {
        const CellBox<D> block = cells.cells(b);
        periodic[a] = block.lower[a] <= domain.lower[a] || block.upper[a] >= domain.upper[a];
      }
    }
    held_ = with_layers(periodic);
  }
  PeriodicSides<D> sides() const { return {domain, periodic}; }
  // Sides of the level, whether solids are near them or not.
  PeriodicSides<D> all_sides() const { return {domain, repeats_}; }
  Cell<D> cell(IntVec3 c) const {
    Cell<D> to;
    for (std::size_t a = 0; a < D; ++a) to[a] = c[direction[a]];
    return to;
  }
  // The index along the a-th direction of the cell at x.
  int cell_at(double x, std::size_t a) const {
    const int d = direction[a];
    return static_cast<int>(std::floor((x - anchor[d]) / spacing[d]));
  }
  IntVec3 index(const Cell<D>& c) const {
    IntVec3 to = base;
    for (std::size_t a = 0; a < D; ++a) to[direction[a]] = c[a];
    return to;
  }
  // The cell of the domain that one beyond it stands for: its image, or the nearest.
  Cell<D> inside(Cell<D> c) const {
    for (std::size_t a = 0; a < D; ++a) {
      const int n = domain.upper[a] - domain.lower[a];
      if (periodic[a])
        c[a] = domain.lower[a] + ((c[a] - domain.lower[a]) % n + n) % n;
      else
        c[a] = std::min(std::max(c[a], domain.lower[a]), domain.upper[a] - 1);
    }
    return c;
  }
  // Its image in periodic directions.
  Cell<D> wrapped(const Cell<D>& c) const {
    const Cell<D> image = inside(c);
    Cell<D> to = c;
    for (std::size_t a = 0; a < D; ++a)
      if (periodic[a]) to[a] = image[a];
    return to;
  }
  // The same, sides as mirrors.
  Cell<D> mirrored(Cell<D> c) const {
    for (std::size_t a = 0; a < D; ++a) {
      if (periodic[a]) continue;
      if (c[a] < domain.lower[a]) c[a] = 2 * domain.lower[a] - 1 - c[a];
      if (c[a] >= domain.upper[a]) c[a] = 2 * domain.upper[a] - 1 - c[a];
    }
    return inside(c);
  }
  // Of a low face along the d-th direction; `flipped`: it is the image of one inside. Faces on the
  // high side of the domain stay where they are.
  Cell<D> mirrored_face(Cell<D> c, std::size_t d, bool& flipped) const {
    const int f = c[d];
    c = mirrored(c);
    if (periodic[d]) return c;
    c[d] = f;
    if (f < domain.lower[d]) c[d] = 2 * domain.lower[d] - f;
    if (f > domain.upper[d]) c[d] = 2 * domain.upper[d] - f;
    flipped = c[d] != f;
    c[d] = std::min(std::max(c[d], domain.lower[d]), domain.upper[d]);
    return c;
  }
  bool in_domain(const Cell<D>& c) const {
    for (std::size_t a = 0; a < D; ++a)
      if (c[a] < domain.lower[a] || c[a] >= domain.upper[a]) return false;
    return true;
  }
  // Area of a face across the a-th direction.
  double face_area(int a) const {
    return cell_volume / spacing[direction[static_cast<std::size_t>(a)]];
  }
  double largest_face() const {
    double most = 0;
    for (int a = 0; a < D; ++a) most = std::max(most, face_area(a));
    return most;
  }

  // Along the active directions.
  CellBox<D> box(const IndexBox& cells_of) const {
    CellBox<D> to;
    for (std::size_t a = 0; a < D; ++a) {
      to.lower[a] = cells_of.lower[direction[a]];
      to.upper[a] = cells_of.upper[direction[a]];
    }
    return to;
  }
  // Cells that solids in these may touch.
  static CellBox<D> touched_around(CellBox<D> solids) {
    if (solids.empty()) return {};
    for (std::size_t a = 0; a < D; ++a) {
      solids.lower[a] -= reach;
      solids.upper[a] += reach;
    }
    return solids;
  }
  // Around all cells that the arrays hold.
  CellBox<D> held() const { return held_; }
  // act(cell, where it lies in the arrays) for those of `part` that the arrays hold.
  template <class Act>
  void for_each_held(const IndexBox& part, Act&& act) const {
    cells.for_each_part(box(part), [&](const CellBox<D>& held) {
      for_each_cell_of<D>(held, [&](const Cell<D>& c) { act(index(c), cells.index(c)); });
    });
  }
  // A part of a box, of which these are the cells along the active directions.
  IndexBox part_of(IndexBox whole, const CellBox<D>& part) const {
    for (std::size_t a = 0; a < D; ++a) {
      whole.lower[direction[a]] = part.lower[a];
      whole.upper[direction[a]] = part.upper[a];
    }
    return whole;
  }
  // Do the arrays hold any of these cells.
  bool holds_any(const IndexBox& part) const { return cells.holds_any(box(part)); }

 private:
  // The domain with layers beyond its sides, more of them where it repeats.
  CellBox<D> with_layers(const std::array<bool, D>& repeats) const {
    CellBox<D> all = domain;
    for (std::size_t a = 0; a < D; ++a) {
      const int beyond = repeats[a] ? periodic_layers : layers;
      all.lower[a] -= beyond;
      all.upper[a] += beyond;
    }
    return all;
  }
  // Adds a box and its images across periodic sides along directions a, ..., D - 1.
  void add_images(CellBox<D> box, std::size_t a) {
    if (a == D) return cells.add(box);
    const int n = repeats_[a] ? domain.upper[a] - domain.lower[a] : 0;
    for (int image = n > 0 ? -1 : 0; image <= (n > 0 ? 1 : 0); ++image) {
      CellBox<D> moved = box;
      moved.lower[a] += image * n;
      moved.upper[a] += image * n;
      add_images(moved, a + 1);
    }
  }

  CellBox<D> held_;                // the domain and layers beyond its sides
  std::array<bool, D> repeats_{};  // the level's periodic directions
};

// The boxes of a level, of all ranks.
template <int D>
std::vector<RankBox<D>> boxes_of_ranks(const Frame<D>& frame, const Level& level) {
  std::vector<RankBox<D>> boxes;
  for (const GridBox& box : level.boxes) boxes.push_back({frame.box(box.cells), box.owner});
  return boxes;
}

using Column = KeptArray<double>;

}  // namespace sluice::mpmice
