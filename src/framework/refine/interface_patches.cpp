// Finding the faces where two levels meet, in the indices of the coarser one.
#include "framework/refine/interface_patches.hpp"

#include <stdexcept>

#include "framework/grid/box_list.hpp"
#include "framework/refine/face_table.hpp"

namespace sluice {
namespace {

class PatchFinder {
 public:
  PatchFinder(const Level& coarse, const Level& fine, int rank)
      : coarse_(coarse),
        fine_(fine),
        rank_(rank),
        axes_(active_axes(coarse)),
        covered_(coarsened(fine)),
        held_(cells_of(coarse, -1)),
        held_here_(cells_of(coarse, rank)) {}

  std::vector<InterfacePatch> all() {
    for (const GridBox& b : fine_.boxes)
      for (int axis = 0; axis < axes_.count; ++axis) {
        search_side(b, axis, false);
        search_side(b, axis, true);
      }
    return std::move(patches_);
  }

 private:
  static BoxFinder coarsened(const Level& fine) {
    std::vector<IndexBox> boxes;
    for (const GridBox& b : fine.boxes) {
      boxes.push_back(coarsen(b.cells, fine.ratio));
      if (refine(boxes.back(), fine.ratio) != b.cells)
        throw std::logic_error("a box of a fine level must begin and end at coarse cells");
    }
    return BoxFinder(std::move(boxes));
  }

  static BoxFinder cells_of(const Level& level, int rank) {
    std::vector<IndexBox> boxes;
    for (const GridBox& b : level.boxes)
      if (rank < 0 || b.owner == rank) boxes.push_back(b.cells);
    return BoxFinder(std::move(boxes));
  }

  void search_side(const GridBox& box, int axis, bool plus) {
    const int d = axes_.direction[axis];
    IndexBox outside = covered_.boxes()[static_cast<std::size_t>(box.id)];
    (plus ? outside.lower : outside.upper)[d] = plus ? outside.upper[d] : outside.lower[d];
    (plus ? outside.upper : outside.lower)[d] += plus ? 1 : -1;
    IntVec3 back{};  // from the outside cells, taken into the domain, to the inside ones
    back[d] = plus ? -1 : 1;
    const IndexBox& domain = coarse_.domain;
    if (outside.lower[d] < domain.lower[d] || outside.upper[d] > domain.upper[d]) {
      if (!coarse_.periodic[static_cast<std::size_t>(d)]) return;
      IntVec3 wrap{};
      wrap[d] = plus ? -domain.size()[d] : domain.size()[d];
      outside = outside.shifted(wrap);
      back = back - wrap;
    }
    if (box.owner != rank_ && held_here_.overlapping(outside).empty()) return;
    for (const IndexBox& piece : covered_.uncovered(outside))
      add_piece(box, axis, plus, piece, back);
  }

  void add_piece(const GridBox& box, int axis, bool plus, const IndexBox& piece, IntVec3 back) {
    const int d = axes_.direction[axis];
    std::int64_t held = 0;
    for (const int c : held_.overlapping(piece)) {
      const GridBox& other = coarse_.boxes[static_cast<std::size_t>(c)];
      InterfacePatch p{box.id, other.id, axis, !plus, intersection(piece, other.cells), {}};
      held += p.coarse_cells.volume();
      if (box.owner != rank_ && other.owner != rank_) continue;
      p.fine_cells = refine(p.coarse_cells.shifted(back), fine_.ratio);
      if (plus)
        p.fine_cells.lower[d] = p.fine_cells.upper[d] - 1;
      else
        p.fine_cells.upper[d] = p.fine_cells.lower[d] + 1;
      patches_.push_back(p);
    }
    if (held != piece.volume())
      throw std::logic_error("a level must hold one layer of cells around the next finer level");
  }

  const Level& coarse_;
  const Level& fine_;
  int rank_;
  Axes axes_;
  BoxFinder covered_, held_, held_here_;
  std::vector<InterfacePatch> patches_;
};

}  // namespace

std::vector<InterfacePatch> interface_patches(const Level& coarse, const Level& fine, int rank) {
  if (fine.boxes.empty()) return {};
  return PatchFinder(coarse, fine, rank).all();
}

}  // namespace sluice
