// Sums over the nodes of a stencil along an axis.
#pragma once
#include "mpm/nodes/node_sums.hpp"

namespace sluice::mpm {

// Outside in: ((first + last) + middle), or (first + last) + (second + third). A mirror image then
// has the mirrored bits.
template <int N, class Lanes = Four>
struct Paired {
  Lanes outer, inner;
  [[gnu::always_inline]] void add(int i, const Lanes& term) {
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
  [[gnu::always_inline]] void sum(Lanes& to) const {
    if constexpr (N == 2)
      to = outer;
    else
      to = outer + inner;
  }
  [[gnu::always_inline]] Lanes sum() const {
    Lanes to;
    sum(to);
    return to;
  }
};

}  // namespace sluice::mpm
