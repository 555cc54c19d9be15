// The classic form of ICE: one stage, internal energy balanced, as a scheme of Ice.
//
// Face velocity from density-weighted means and the pressure gradient, pressure change from the
// divergence of the face velocity, face pressure weighted with the opposite density, volume work,
// advection of mass, momentum and internal energy. Limits: total energy is not conserved and shocks
// have wrong speeds and strengths; it is there for comparison.
// References: B. A. Kashiwa et al., A cell-centered ICE method for multiphase flow simulations,
// LA-UR-93-3922 (1994); J. E. Guilkey, T. B. Harman and B. Banerjee, Comput. Struct. 85 (2007) 660.
#pragma once
#include "framework/task/effect.hpp"
#include "ice/step/variables.hpp"

namespace sluice::ice {

// Tasks of a step, in order.
void declare_classic(TaskList& list, const SchemeOptions& options, const EffectList& effects);

}  // namespace sluice::ice
