// Moving facets in three dimensions, eight at a time: what each adds to the sums of cells.
//
// A facet that spans at most two cells along every direction over the step meets at most one plane
// of the grid there. A triangle cut by a plane leaves a corner triangle and the rest: with the
// corner's edges cut at fractions t_a, t_b of theirs its share is s = t_a t_b, and its moments are
// linear in them; the rest is the whole less the corner. Several planes follow by the same rule on
// the corner: no polygon is walked. Facets are sorted into groups that are cut along the same
// directions and split along the same ones (mixed_facet.hpp), so that eight of a group take every
// step together.
//
// Places are counted from the lower corner of the facet's own cells, which is exact: a body that
// moves by whole cells keeps its bits, and identities hold as well far from the origin.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "mpmice/geometry/cell_blocks.hpp"
#include "mpmice/geometry/outer_faces.hpp"

namespace sluice::mpmice {

// Of each cell sixteen numbers beside each other, in units of 1/sum_unit: N_d, T_d of the mean, and
// the first two C_d (swept_volumes.hpp); N_d', T_d' of the end of the step (solid_in_cells.hpp),
// the last C_d, and a plain number of the facets that span the cell (free_cells.hpp).
inline constexpr std::size_t numbers_of_cell = 16;
namespace number_of_cell {
inline constexpr std::size_t mean_N = 0, mean_T = 3, end_N = 8, end_T = 11, mark = 15;
inline constexpr std::array<std::size_t, 3> C{6, 7, 14};
}  // namespace number_of_cell

class FacetGroups {
 public:
  // Adds all faces to `sums`, numbers_of_cell for each cell of the blocks. Facets that span more
  // cells, or lie in a plane of the grid, are left to others: 4 face + facet, in rising order.
  void add(const OuterFaces<3>& faces, const CellBlocks<3>& cells, std::uint64_t* sums,
           KeptArray<std::uint32_t>& left);

  static constexpr std::size_t width = 8;

  // Facets of one group, eight numbers beside each other. Directions are turned so that those along
  // which they are cut come first.
  struct Group {
    int turn = 0;                                 // direction d here is d + turn of the grid
    std::size_t count = 0;                        // of facets so far
    alignas(64) double x[2][3][3][width];         // [old, new][node][direction], from `low`
    alignas(64) double weight[width];             // by what is left of the particles
    std::array<std::array<int, 3>, width> low{};  // their lowest cells, of the grid
  };

 private:
  // By number of directions cut, bits of those that are split, turn.
  std::array<std::array<std::array<Group, 3>, 8>, 4> groups_;
};

}  // namespace sluice::mpmice
