// Finding the faces where two levels meet, in the indices of the coarser one.
#include "framework/refine/interface_patches.hpp"

#include <algorithm>
#include <stdexcept>

#include "framework/grid/box_list.hpp"
#include "framework/refine/face_table.hpp"
#include "framework/refine/region_exchange.hpp"

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
        held_(cells_of(coarse.boxes)) {}

  std::vector<InterfacePatch> all() {
    patches_.reserve(4 * fine_.boxes.size());
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
    boxes.reserve(fine.boxes.size());
    for (const GridBox& b : fine.boxes) {
      boxes.push_back(coarsen(b.cells, fine.ratio));
      if (refine(boxes.back(), fine.ratio) != b.cells)
        throw std::logic_error("a box of a fine level must begin and end at coarse cells");
    }
    return BoxFinder(std::move(boxes));
  }

  void search_side(const GridBox& box, int axis, bool plus) {
    const int d = axes_.direction[axis];
    IndexBox outside = covered_.boxes()[box.id];
    (plus ? outside.lower : outside.upper)[d] = plus ? outside.upper[d] : outside.lower[d];
    (plus ? outside.upper : outside.lower)[d] += plus ? 1 : -1;
    IntVec3 back{};  // from the outside cells, taken into the domain, to the inside ones
    back[d] = plus ? -1 : 1;
    const IndexBox& domain = coarse_.domain;
    if (outside.lower[d] < domain.lower[d] || outside.upper[d] > domain.upper[d]) {
      if (!coarse_.periodic[d]) return;
      IntVec3 wrap{};
      wrap[d] = plus ? -domain.size()[d] : domain.size()[d];
      outside = outside.shifted(wrap);
      back = back - wrap;
    }
    if (box.owner != rank_ && !any_here(outside)) return;
    for (const IndexBox& piece : covered_.uncovered(outside))
      add_piece(box, axis, plus, piece, back);
  }

  // Is any of these cells of the coarse level on this rank.
  bool any_here(const IndexBox& cells) {
    held_.find(cells, holders_);
    return std::any_of(holders_.begin(), holders_.end(),
                       [&](int c) { return coarse_.boxes[c].owner == rank_; });
  }

  void add_piece(const GridBox& box, int axis, bool plus, const IndexBox& piece, IntVec3 back) {
    const int d = axes_.direction[axis];
    std::int64_t held = 0;
    held_.find(piece, holders_);
    for (const int c : holders_) {
      const GridBox& other = coarse_.boxes[c];
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
  BoxFinder covered_, held_;
  std::vector<int> holders_;
  std::vector<InterfacePatch> patches_;
};

}  // namespace

std::vector<InterfacePatch> interface_patches(const Level& coarse, const Level& fine, int rank) {
  if (fine.boxes.empty()) return {};
  return PatchFinder(coarse, fine, rank).all();
}

}  // namespace sluice
