#include "mpmice/amounts/cell_merging.hpp"

#include <fmt/format.h>

#include "mpmice/fields/agreement.hpp"

namespace sluice::mpmice {

template <int D>
std::string CellMerging<D>::fault(const Frame<D>& frame) const {
  if (!trapped_) return {};
  const IntVec3 at = frame.index(*trapped_);
  return fmt::format(
      "solids close cell [{}, {}, {}], and no adjacent cell can take the fluid that it contains",
      at.x, at.y, at.z);
}

template <int D>
bool CellMerging<D>::share_inadmissible(const NearCells<D>& near, SolidGeometry<D>& solid,
                                        const SmoothNormals<D>& normals, FluidAmounts<D>& fluid,
                                        SettledFluid<D>& settled, Communicator& ranks,
                                        std::string& reason) const {
  constexpr int most = 4;  // rounds
  CellAmounts<D>& amounts = fluid.amounts();
  for (int round = 0; round < most; ++round) {
    amounts.inadmissible = settled.inadmissible();
    fluid.refresh(near, ranks);
    std::optional<Cell<D>> trapped;  // then the cell is no state, and says so
    redistribute<D>(near, solid, normals, amounts, trapped);
    amounts.inadmissible.clear();
    if (!on_any(ranks, !settled.settle(near, amounts, solid, reason))) {
      reason.clear();
      return true;
    }
  }
  share_reason(ranks, reason);
  return false;
}

template class CellMerging<1>;
template class CellMerging<2>;
template class CellMerging<3>;

}  // namespace sluice::mpmice
