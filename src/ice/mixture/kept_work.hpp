// Whether the work of pressures on a mixture is a field of its own: elsewhere it is E - E*.
#pragma once
#include "ice/conservative/variables.hpp"

namespace sluice::ice::mixture {

inline bool keeps_work(const SchemeOptions& o) {
  return o.mixture && (o.viscous || o.conducting || o.own_velocities);
}

}  // namespace sluice::ice::mixture
