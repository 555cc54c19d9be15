// The longest stable step of the classic form.
#pragma once
#include <cmath>

namespace sluice::ice::internal_energy_form {

// Largest stable (|u| + c) dt/dx. Face velocity and pressure change are leap-frogged over two
// cells: a sound wave of the shortest length is damped by 1 - 4 axes (c dt/dx)^2, which must stay
// above -1. A Courant number.
inline double sound_share(int axes) {
  // threshold: share of the largest stable step that is taken; unit: 1; test:
  //   ClassicForm.StaysStableUpToItsOwnLimit
  constexpr double margin = 0.98;
  return margin / std::sqrt(2.0 * axes);
}

}  // namespace sluice::ice::internal_energy_form
