// The end of a step of a gas that gives heat where it mixes (models/gases/mixed_gas.hpp).
//
//   E' = E + rho' (Q(f') - q),  q' = Q(f')
// after the remap and the transport of f and q: q is what the mass has given so far, so that heat
// is counted once however often its mass is mixed anew, and over a closed domain the heat given is
// the change of sum rho' Q(f'). It counts as a source (sources/sources.hpp); other sources act
// before it. Absent where no heat is given: then the update ends the step.
#pragma once
#include "ice/scalars/release_rows.hpp"

namespace sluice::ice::scalars {

struct HeatReleaseInput {
  ReleaseInput release;
  VariableId fraction, released;
  VariableId released_new;  // written

  static HeatReleaseInput of(const SchemeVariables& v) {
    return {.release = ReleaseInput::of(v),
            .fraction = v.scalars.fraction,
            .released = v.scalars.released,
            .released_new = v.scalars.released_new};
  }
};
void add_heat_release(TaskList&, const HeatReleaseInput&, const SchemeOptions&, int effect);

}  // namespace sluice::ice::scalars
