// The units in which rates are published, and what they are in SI.
#pragma once

namespace sluice::kinetics {

inline constexpr double calorie = 4.184;  // J

// A of an Arrhenius law of this order, from (length^3/mole)^(order - 1)/s to (m^3/mol)^(order - 1)
// /s; `volume` is length^3/mole in m^3/mol.
inline double frequency_factor(double A, int order, double volume) {
  for (; order > 1; --order) A *= volume;
  for (; order < 1; ++order) A /= volume;
  return A;
}

}  // namespace sluice::kinetics
