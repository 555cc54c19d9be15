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

void check_object(const DeckNode& node, const GeometryReader& geometry, const Grid& grid,
                  std::vector<Fault>& faults) {
  std::vector<Fault> told;  // already, by the reader of the object
  const IntVec3 res = geometry.object(node, told).res;
  for (const auto& tag : node.children) {
    if (!GeometryReader::is_piece(tag->name)) continue;
    const PiecePtr piece = geometry.piece(*tag, told);
    if (piece == nullptr) continue;
    const bool covers =
        std::any_of(grid.levels.begin(), grid.levels.end(),
                    [&](const Level& level) { return covers_a_cell(*piece, res, level); });
    if (covers) continue;
    add_warning(faults, tag->where, fmt::format("<{}> covers no cell: no effect", tag->name),
                "it must contain centres of cells, or sub-points if <res> is above 1");
  }
}

}  // namespace

void warn_of_empty_pieces(const DeckNode& block, const GeometryReader& geometry, const Grid& grid,
                          std::vector<Fault>& faults) {
  if (block.name == "TracerParticles") return;  // they start at points of their own
  for (const auto& child : block.children)
    if (child->name == "geom_object")
      check_object(*child, geometry, grid, faults);
    else
      warn_of_empty_pieces(*child, geometry, grid, faults);
}

}  // namespace sluice
