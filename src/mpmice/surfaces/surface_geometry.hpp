// Where solids lie in the cells near them: at the start of a step, at its end, and between.
#pragma once
#include "mpmice/geometry/moving_surface.hpp"
#include "mpmice/geometry/reference_cells.hpp"
#include "mpmice/surfaces/solid_set.hpp"

namespace sluice::mpmice {

template <int D>
class SurfaceGeometry {
 public:
  // The threads that add to sums, from then on; without, the calling one does. They must live as
  // long.
  void use(const ThreadTeam& team) { team_ = &team; }
  // Of the faces of the sets at the start of a step: what is to be summed over ranks, and what
  // follows from the sums, as summed (clean_... in solid_in_cells.hpp). Collective where blocks
  // begin at their lowest cells, unless `ranks` is null.
  void begin_at_start(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets);
  CellSums<D>& free_cells() { return free_.sums(); }
  CellSums<D>& surfaces() { return sums_.sums(); }
  void finish_at_start(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets,
                       Communicator* ranks, SolidInCells<D>& found);
  // Collective. Of sets that have moved.
  void find_moved(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets, Communicator& ranks,
                  SolidInCells<D>& at_end, SweptVolumes<D>& swept);
  // Collective. The end alone: faces have changed since.
  void find_at_end(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets, Communicator& ranks,
                   SolidInCells<D>& found);

 private:
  void begin(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets, When when, bool moved);
  void finish(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets, Communicator* ranks,
              When when, SolidInCells<D>& found);
  // References where blocks need any; null: none does.
  const std::uint64_t* find_references(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets,
                                       Communicator* ranks, When when);

  const ThreadTeam* team_ = nullptr;
  FreeCells<D> free_;
  SolidSums<D> sums_;
  SweptSums<D> swept_;
  MovingSurface<D> moving_;
  ReferenceCells<D> references_;
};

}  // namespace sluice::mpmice
