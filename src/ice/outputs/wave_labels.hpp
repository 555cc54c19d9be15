// Li1 to Li5: the waves through open faces, as labels that can be saved.
//
// Vectors: component d holds the waves along direction d, in cells next to a LODI face of it; zero
// elsewhere. With n along the axis and derivatives across the face, to the first ghost:
//   L1 = (u_n - c)(p_n - rho c u_n,n)/2   L2 = u_n (rho_n - p_n/c^2)   L3, L4 = u_n u_t,n
//   L5 = (u_n + c)(p_n + rho c u_n,n)/2       t: the tangents, in cyclic order
#pragma once
#include "ice/outputs/quantity_list.hpp"

namespace sluice::ice {

struct WaveInputs {
  VariableId rho, velocity, pressure, sound_speed;
};

void declare_wave_amplitudes(QuantityList& quantities, const WaveInputs& inputs);

}  // namespace sluice::ice
