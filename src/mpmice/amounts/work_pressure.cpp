#include "mpmice/amounts/work_pressure.hpp"

#include "ice/fluid/labels.hpp"

namespace sluice::mpmice {

template <int D>
void keep_work_pressure(const NearCells<D>& near, const SolidGeometry<D>& solid,
                        const CellAmounts<D>& amounts, const ice::FluidPart& fluid, Column X,
                        Warehouse& next) {
  const Frame<D>& frame = near.frame();
  const CellMask known = fill_dry(near, solid, X);
  const FluidCells in_cells(fluid, next);
  const int slot = next.find(ice::labels().pressure_offset, fluid.options().place(0));
  for (int b = 0; b < static_cast<int>(next.local_boxes().size()); ++b) {
    const FluidBox cells = in_cells.box(b);
    const RealView offset = next.view(slot, 0, b);
    const IndexBox& own = next.local_boxes()[static_cast<std::size_t>(b)].cells;
    frame.for_each_held(own, [&](IntVec3 at, std::size_t i) {
      if (amounts.touched[i] == 0) return;
      offset(at) = known[i] != 0 ? X[i] - cells.at(at).pressure : 0.0;
    });
    next.forget_where(b, [&](const IndexBox& part) { return frame.holds_any(part); });
  }
}

template void keep_work_pressure(const NearCells<1>&, const SolidGeometry<1>&,
                                 const CellAmounts<1>&, const ice::FluidPart&, Column, Warehouse&);
template void keep_work_pressure(const NearCells<2>&, const SolidGeometry<2>&,
                                 const CellAmounts<2>&, const ice::FluidPart&, Column, Warehouse&);
template void keep_work_pressure(const NearCells<3>&, const SolidGeometry<3>&,
                                 const CellAmounts<3>&, const ice::FluidPart&, Column, Warehouse&);

}  // namespace sluice::mpmice
