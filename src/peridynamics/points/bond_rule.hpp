// The weight of a bond, w = omega(r) beta(r): influence times partial volume, functions of the pair
// that both ends have alike.
//
//   omega: 1, max(0, 1 - r/delta), delta/r
//   beta:  1 for r <= delta;  clamp((delta + dx/2 - r)/dx, 0, 1)
// delta: the smaller horizon of both ends; dx: the mean of both spacings. m.
#pragma once
#include <algorithm>

#include "peridynamics/deck/peri_scene.hpp"

namespace sluice::peridynamics {

struct BondRule {
  Influence influence = Influence::linear;
  PartialVolume partial_volume = PartialVolume::ramp;

  double omega(double r, double delta) const {
    switch (influence) {
      case Influence::one:
        return 1;
      case Influence::linear:
        return std::max(0.0, 1 - r / delta);
      case Influence::inverse:
        return delta / r;
    }
    return 1;
  }
  // A neighbour on the edge of the horizon belongs to the family.
  double beta(double r, double delta, double dx) const {
    if (partial_volume == PartialVolume::none) return r <= delta * (1 + 1e-10) ? 1 : 0;
    if (r <= delta - 0.5 * dx) return 1;
    return std::clamp((delta + 0.5 * dx - r) / dx, 0.0, 1.0);
  }
  // As it is kept.
  float weight(double r, double delta, double dx) const {
    return static_cast<float>(omega(r, delta) * beta(r, delta, dx));
  }
  // Beyond it no bond has any weight.
  double reach(double delta, double dx) const {
    if (influence == Influence::linear || partial_volume == PartialVolume::none)
      return delta * (1 + 1e-10);
    return delta + 0.5 * dx;
  }
};

}  // namespace sluice::peridynamics
