// The order of what closes a cell.
#include "ice/closure/cell_closure.hpp"

namespace sluice::ice::mixture {

Equilibration::Result CellClosure::close(const Equilibration::Cell& cell, double density, double dt,
                                         const HeatExchange::Surface& surface) const {
  double before[max_materials];
  const std::uint64_t bubbles = collapse_.possible() ? collapse_.traces_of_gas(cell, density) : 0;
  if (bubbles != 0) collapse_.remember(cell, bubbles, before);
  Equilibration::Result result = equilibration_.equilibrate(cell);
  // A cavity that tension has torn open does not close.
  if (bubbles != 0 && result.failed < 0 && !result.is_cavitating &&
      collapse_.settle(cell, bubbles, before, result.pressure))
    result = equilibration_.equilibrate(cell);
  if (heat_.on() && result.failed < 0 && heat_.exchange(cell, dt, surface))
    result = equilibration_.equilibrate(cell);
  return result;
}

}  // namespace sluice::ice::mixture
