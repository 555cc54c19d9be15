// The end of a step of a gas whose species react (models/gases/combustion.hpp).
//
//   Y'', q = reactor(rho', e', Y'; dt),   E'' = E' + q,   q = -rho' sum (Y_k'' - Y_k') e0_k
// after the remap and the transport of the fractions: each cell reacts over the step at constant
// volume without exchange (splitting of first order in the step; between two steps it is Strang's,
// shifted by half a step). q counts as a source, as heat of mixing does; E + rho sum Y_k e0_k is
// kept to round-off. A cell whose rates are as good as nothing costs one look at its rates. Absent
// without reactions.
#pragma once
#include "ice/scalars/release_rows.hpp"

namespace sluice::ice::scalars {

struct ReactionsInput {
  ReleaseInput release;
  std::vector<ScalarVariables::Each> each;  // now: read; after_reactions: written

  static ReactionsInput of(const SchemeVariables& v) {
    return {.release = ReleaseInput::of(v), .each = v.scalars.each};
  }
};
void add_reactions(TaskList&, const ReactionsInput&, const SchemeOptions&, int effect);

}  // namespace sluice::ice::scalars
