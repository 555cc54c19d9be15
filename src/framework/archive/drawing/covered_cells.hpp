// Cells of a level that lie below the next finer one, as programs that draw are told of them.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "framework/grid/box_list.hpp"
#include "framework/grid/level.hpp"

namespace sluice {

class CoveredCells {
 public:
  CoveredCells(const Grid& grid, std::size_t level);

  // Whether some of these cells are covered.
  bool any(const IndexBox& cells) const;
  // VTK's vtkGhostType, one byte per cell, x fastest: covered cells are not drawn because they are
  // refined (8), and not integrated because they are duplicates (1).
  std::vector<std::uint8_t> ghost_types(const IndexBox& cells) const;

 private:
  std::optional<BoxFinder> finer_;  // in cells of this level; none on the finest
};

}  // namespace sluice
