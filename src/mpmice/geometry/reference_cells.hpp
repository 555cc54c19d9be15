// The volume fraction of the lowest cell of each block in which no cell is free to begin at: from
// the particles that reach it, each a closed body of its own.
//
//   theta of one particle in a cell = what its faces add to T_x there, and to N_x in the cells
//   above in the row along x
//
// (solid_in_cells.hpp). Ten times dearer a face than surfaces, and rare: foam, debris, bodies that
// burn all through.
#pragma once
#include "mpmice/geometry/free_cells.hpp"

namespace sluice::mpmice {

template <int D>
class ReferenceCells {
 public:
  // For the blocks of these, once they are finished.
  void begin(const FreeCells<D>& free);
  // theta at one end of the step.
  void add(const SolidParticles<D>& particles, When when);
  // The mean of the step, with mixed shapes (mixed_facet.hpp).
  void add_mean(const SolidParticles<D>& particles);
  void sum_over_ranks(Communicator& ranks);
  // By block, in units of 1/sum_unit.
  const std::uint64_t* values() const { return values_.data(); }

 private:
  struct Place {
    Cell<D> cell;  // not wrapped, beside the particle
    std::size_t block;
  };
  void list(const SolidParticles<D>& particles, bool both_ends);
  template <class ForEachPiece>
  void add_faces(const SolidParticles<D>& particles, ForEachPiece&& for_each_piece);
  void add_piece(std::size_t n, const Cell<D>& cell, double N, double T);

  const FreeCells<D>* free_ = nullptr;
  KeptArray<std::uint64_t> values_;
  // Particles that reach such cells, and which; all their faces.
  std::vector<std::uint32_t> reaching_;
  std::vector<std::size_t> first_;  // of `places_`, by particle that reaches any; one more
  std::vector<Place> places_;
  OuterFaces<D> faces_;
};

}  // namespace sluice::mpmice
