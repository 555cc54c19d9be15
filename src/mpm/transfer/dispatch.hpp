// The one place where basis and number of directions become template parameters: once a block.
#pragma once
#include <stdexcept>
#include <type_traits>

#include "mpm/deck/mpm_scene.hpp"
#include "mpm/shape/weights.hpp"
#include "mpm/transfer/particle_shape.hpp"

namespace sluice::mpm {

// act.template operator()<directions, Basis>(); `own_widths`: particles of GIMP have half widths of
// their own.
template <class Act>
auto for_basis(Basis basis, bool own_widths, int directions, Act&& act) {
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
      if (own_widths) return with.template operator()<GimpOfOwnWidths>();
      return with.template operator()<Gimp>();
    case Basis::quadratic:
      return with.template operator()<Gimp>();
    case Basis::cubic:
      return with.template operator()<Cubic>();
    default:
      throw std::logic_error("a transfer of this basis has no weights by axis");
  }
}

// The weights of a chunk along an axis; places x by direction, m.
template <class B, bool Offsets>
void weights_of(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
                const ParticleShape& shape, int d, int at, int n, AxisWeights<B::nodes>& to) {
  if constexpr (std::is_same_v<B, GimpOfOwnWidths>) {
    alignas(64) double half[chunk_size];
    own_widths(basis, grid, shape, d, at, n, half);
    B::template weights<Offsets>(grid.axes[d], x[d] + at, half, n, to);
  } else {
    B::template weights<Offsets>(grid.axes[d], x[d] + at, grid.half[d], n, to);
  }
}

}  // namespace sluice::mpm
