#include "mpmice/surfaces/previous_fractions.hpp"

namespace sluice::mpmice {

template <int D>
void PreviousFractions<D>::add_cells(const Frame<D>& frame, const Warehouse& state, int slot,
                                     OccupiedCells<D>& to) {
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView fraction = state.view(slot, 0, b);
    state.for_each_part_other(slot, b, 0.0, [&](const IndexBox& part) {
      for_each_cell(part, [&](IntVec3 at) {
        if (fraction(at) == 0) return;
        const Cell<D> c = frame.cell(at);
        CellBox<D> one{c, c};
        for (int& upper : one.upper) ++upper;
        to.add(one);
      });
    });
  }
}

template <int D>
void PreviousFractions<D>::gather(const Frame<D>& frame, const Warehouse& state, int slot) {
  previous_.begin(frame.cells, 1);
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView fraction = state.view(slot, 0, b);
    frame.for_each_held(state.local_boxes()[static_cast<std::size_t>(b)].cells,
                        [&](IntVec3 at, std::size_t i) { previous_.put(0, i, fraction(at)); });
  }
}

template class PreviousFractions<1>;
template class PreviousFractions<2>;
template class PreviousFractions<3>;

}  // namespace sluice::mpmice
