// Geometry that lies between the points at which cells look for it, or outside of the domain.
#include "framework/scene/empty_pieces.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/geometry/sampling.hpp"

namespace sluice {
namespace {

// A level that a regridder will fill may have cells anywhere.
bool covers_a_cell(const GeometryPiece& piece, IntVec3 res, const Level& level) {
  const auto inside = [&](const IndexBox& cells) {
    return any_inside(piece, CellLattice{level.anchor, level.spacing}, cells.lower, cells.upper,
                      res);
  };
  if (level.boxes.empty()) return inside(level.domain);
  return std::any_of(level.boxes.begin(), level.boxes.end(),
                     [&](const GridBox& box) { return inside(box.cells); });
}

}  // namespace

void warn_of_empty_pieces(const DeckNode& node, const GeomObject& object,
                          const GeometryReader& geometry, const Grid& grid,
                          std::vector<Fault>& faults) {
  if (object.piece == nullptr) return;  // told already
  std::vector<const DeckNode*> pieces;
  for (const auto& child : node.children)
    if (GeometryReader::is_piece(child->name)) pieces.push_back(child.get());
  std::vector<Fault> told;
  for (const DeckNode* tag : pieces) {
    const PiecePtr piece = pieces.size() == 1 ? object.piece : geometry.piece(*tag, told);
    const bool covers =
        std::any_of(grid.levels.begin(), grid.levels.end(),
                    [&](const Level& level) { return covers_a_cell(*piece, object.res, level); });
    if (covers) continue;
    add_warning(faults, tag->where, fmt::format("<{}> covers no cell: no effect", tag->name),
                "it must hold centres of cells, or sub-points where <res> asks for several");
  }
}

}  // namespace sluice
