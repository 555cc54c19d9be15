// Free cells: those that no facet of a surface meets. There solids are all or nothing, and how many
// bodies overlap is the winding number of one point.
//
// So a row of cells may begin at any free cell: no sum runs through the domain, and a rank needs
// nothing but the particles that reach its own blocks. Points are asked in cells whose coordinates
// are all odd. Blocks of which none of these is free (debris, foam) begin at their lowest cell,
// whose volume fraction is summed over the faces of all particles that reach it
// (reference_cells.hpp).
#pragma once
#include "mpmice/geometry/cell_sums.hpp"
#include "mpmice/geometry/facet.hpp"
#include "mpmice/geometry/solid_particles.hpp"

namespace sluice::mpmice {

template <int D>
class FreeCells {
 public:
  // Keeps a reference to the blocks. `sides`: across which bodies may lie.
  void begin(const CellBlocks<D>& cells, const PeriodicSides<D>& sides);
  // Where facets are counted: their number in each cell.
  std::uint64_t* marks() { return sums_.lane(mark); }
  // All cells that a facet spans, counted from `base`. Throws std::out_of_range where one has no
  // block.
  void mark_spans(const Cell<D>& base, const std::array<CellSpan, D>& spans);
  // Asks where particles lie, each by the part of it that is solid.
  void add(const SolidParticles<D>& particles, When when) {
    add(particles, when, 0, particles.count, sums_);
  }
  // Particles begin to end - 1, to sums over the same cells: of another thread.
  void add(const SolidParticles<D>& particles, When when, std::size_t begin, std::size_t end,
           CellSums<D>& to) const;
  CellSums<D>& sums() { return sums_; }
  // Once all is added, by all ranks.
  void finish();

  const CellBlocks<D>& cells() const { return sums_.cells(); }
  const PeriodicSides<D>& sides() const { return sides_; }
  // The cells of block n that count for themselves: those beyond periodic sides are images.
  CellBox<D> own_cells(std::size_t n) const;
  bool is_free(std::size_t i) const { return sums_.lane(mark)[i] == 0; }
  bool is_whole(std::size_t n) const { return whole_[n] != 0; }  // all its cells are free
  // The cell of block n at which its rows begin, and theta there, in units of 1/sum_unit. Not of
  // blocks that begin at their lowest cell.
  bool begins_free(std::size_t n) const { return starts_[n] != 0; }
  std::size_t start(std::size_t n) const { return starts_[n]; }
  std::uint64_t inside(std::size_t i) const { return sums_.lane(points)[i]; }
  // Has any block no free cell to begin at.
  bool any_without() const { return any_without_; }

 private:
  static constexpr int mark = 0, points = 1;
  void ask(const SolidParticles<D>& particles, When when, std::size_t p, const Cell<D>& first,
           const Cell<D>& last, CellSums<D>& to) const;

  PeriodicSides<D> sides_;
  CellSums<D> sums_;
  KeptArray<std::uint8_t> whole_;
  KeptArray<std::size_t> starts_;  // by block; 0: none
  bool any_without_ = false;
};

// theta of all cells that count for themselves, in units of 1/sum_unit, from what pieces add to
// each (solid_in_cells.hpp):
//
//   theta(next along d) = theta - T_d - N_d' + T_d',   theta(one below) = theta - T_d + N_d + T_d'
//
// (' of the other cell), along x, then y, then z from the cell where the block begins. A free cell
// takes the whole number, if that is within 2^-43. `references`: theta of the lowest cell of each
// block that begins there; null: none does.
template <int D>
using LanesOfDirections = std::array<const std::uint64_t*, D>;
template <int D>
void follow_cells(const FreeCells<D>& free, const LanesOfDirections<D>& N,
                  const LanesOfDirections<D>& T, const std::uint64_t* references,
                  KeptArray<std::uint64_t>& theta);

// What cells beyond periodic sides have: that of their images.
template <int D>
void copy_images(const CellBlocks<D>& cells, const PeriodicSides<D>& sides,
                 KeptArray<double>& values);

}  // namespace sluice::mpmice
