// The one place where basis and number of directions become template parameters: once a block.
#pragma once
#include <stdexcept>

#include "mpm/deck/mpm_scene.hpp"
#include "mpm/shape/weights.hpp"

namespace sluice::mpm {

// act.template operator()<directions, Basis>().
template <class Act>
auto for_basis(Basis basis, int directions, Act&& act) {
  const auto with = [&]<class B>() {
    if (directions == 3) return act.template operator()<3, B>();
    if (directions == 2) return act.template operator()<2, B>();
    return act.template operator()<1, B>();
  };
  switch (basis) {
    case Basis::linear:
      return with.template operator()<Linear>();
    case Basis::gimp:
    case Basis::cpgimp:
    case Basis::quadratic:
      return with.template operator()<Gimp>();
    case Basis::cubic:
      return with.template operator()<Cubic>();
    default:
      throw std::logic_error("a transfer of this basis has no weights by axis");
  }
}

}  // namespace sluice::mpm
