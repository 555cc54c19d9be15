// Sums over the nodes of a stencil along an axis.
#pragma once
#include "mpm/nodes/node_sums.hpp"

namespace sluice::mpm {

// Outside in: ((first + last) + middle), or (first + last) + (second + third). A mirror image then
// has the mirrored bits.
template <int N>
struct Paired {
  Four outer, inner;
  [[gnu::always_inline]] void add(int i, Four term) {
    if (i == 0)
      outer = term;
    else if (i == N - 1)
      outer += term;
    else if (N == 3)
      inner = term;
    else if (i == 1)
      inner = term;
    else
      inner += term;
  }
  [[gnu::always_inline]] Four sum() const {
    if constexpr (N == 2) return outer;
    return outer + inner;
  }
};

}  // namespace sluice::mpm
