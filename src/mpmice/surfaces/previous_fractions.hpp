// Volume fractions of solid that the last step left: what this one begins with. They are those of
// the geometry but for pockets that are kept open and gaps that hold no fluid.
#pragma once
#include "framework/field/warehouse.hpp"
#include "mpmice/fields/owner_values.hpp"
#include "mpmice/surfaces/solid_geometry.hpp"

namespace sluice::mpmice {

template <int D>
class PreviousFractions {
 public:
  // Adds the cells that are closed in part, if only as gaps that no fluid has reached. `slot`: of
  // the fractions in the state.
  static void add_cells(const Frame<D>& frame, const Warehouse& state, int slot,
                        OccupiedCells<D>& to);
  // Those of this rank's cells, for those that share their blocks.
  void gather(const Frame<D>& frame, const Warehouse& state, int slot);
  CellSums<D>& sums() { return previous_.sums(); }
  // Once all are known: into the cells of the domain.
  void take(const NearCells<D>& near, Column& theta) const {
    near.for_each([&](const Cell<D>&, std::size_t i) { theta[i] = previous_.value(0, i); });
  }

 private:
  OwnerValues<D> previous_;
};

}  // namespace sluice::mpmice
