// What the sweep left in cells with solids (amounts) and around them (a state).
#pragma once
#include "framework/base/communicator.hpp"
#include "mpmice/fields/cell_amounts.hpp"
#include "mpmice/fields/fluid_cells.hpp"
#include "mpmice/fields/owner_values.hpp"
#include "mpmice/surfaces/solid_geometry.hpp"

namespace sluice::mpmice {

template <int D>
class FluidAmounts {
 public:
  explicit FluidAmounts(const ice::FluidPart& fluid) : fluid_(&fluid) {}

  // Behind the motion of solids, before any of them part: what the sweep was made with.
  void begin(const NearCells<D>& near, const SolidGeometry<D>& solid);
  // 1: cells of which the sweep has left amounts; volume fractions of solid at its end.
  const CellMask& swept_with_solid() const { return swept_with_solid_; }
  const Column& theta_swept() const { return theta_swept_; }
  // From the attempted state of this rank's cells, and those of the ranks that share blocks.
  // Collective among these.
  void gather(const NearCells<D>& near, const SolidGeometry<D>& solid, const Warehouse& state,
              Communicator& ranks);
  // Amounts of cells as those have them whose cells they are. Collective among neighbours.
  void refresh(const NearCells<D>& near, Communicator& ranks);
  CellAmounts<D>& amounts() { return amounts_; }
  const CellAmounts<D>& amounts() const { return amounts_; }
  // Numbers that are kept of a cell.
  static int columns(const ice::FluidPart& fluid);

 private:
  struct Lanes;
  void mark(const NearCells<D>& near, const SolidGeometry<D>& solid);
  void put_cell(const FluidCells& fluid, const FluidBox& cells, const Lanes& lanes, IntVec3 at,
                std::size_t i);

  const ice::FluidPart* fluid_;
  CellMask swept_with_solid_;
  Column theta_swept_;
  OwnerValues<D> known_;
  CellAmounts<D> amounts_;
};

}  // namespace sluice::mpmice
