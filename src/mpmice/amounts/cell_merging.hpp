// Small cells share what they hold with their neighbours (redistribute.hpp), also those whose rest
// of fluid is no state.
#pragma once
#include <optional>
#include <string>

#include "mpmice/amounts/redistribute.hpp"
#include "mpmice/amounts/settled_fluid.hpp"

namespace sluice::mpmice {

template <int D>
class CellMerging {
 public:
  void begin() { trapped_.reset(); }
  void share(const NearCells<D>& near, const SolidGeometry<D>& solid,
             const SmoothNormals<D>& normals, CellAmounts<D>& amounts) {
    redistribute<D>(near, solid, normals, amounts, trapped_);
  }
  // Does a cell of this rank close with fluid in it that nobody takes; which.
  bool trapped() const { return trapped_.has_value(); }
  std::string fault(const Frame<D>& frame) const;
  // A cell whose rest of fluid is no state gives it to the cells around, through covered faces too,
  // until all are settled. False: some are not, for `reason`. Collective.
  bool share_inadmissible(const NearCells<D>& near, SolidGeometry<D>& solid,
                          const SmoothNormals<D>& normals, FluidAmounts<D>& fluid,
                          SettledFluid<D>& settled, Communicator& ranks, std::string& reason) const;

 private:
  std::optional<Cell<D>> trapped_;
};

}  // namespace sluice::mpmice
