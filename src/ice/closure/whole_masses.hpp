// Rounds the mass that passes a face so that both cells can book it to the last digit.
//
// Where M + (F- - F+) is rounded each cell of a material gains or loses half a digit a step, and a
// fragment of a few cells 1e-15 of itself in a thousand steps. So F is a multiple of two units in
// the last place of the larger of the two masses: sums of such numbers are exact. Of the smaller
// one where the other is much larger, or where the donor gives most of what it has: what is left
// there shall not be the round-off of a neighbour.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

#include "ice/fluid/limiters.hpp"

namespace sluice::ice::mixture {

inline double power_of_two_below(double x) {
  constexpr std::uint64_t exponent = 0x7ff0000000000000;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & exponent);
}

// F, `low`, `high`: what passes and the masses of the two cells, all per volume of a cell (kg/m^3);
// `drains`: the donor gives most of what it has.
inline double whole_mass(double F, double low, double high, bool drains) {
  // threshold: ratio of the masses of two cells above which the mass that passes is rounded to the
  //   digits of the larger one; unit: 1; test: CompactSupport.FragmentsStayTogether
  constexpr double alike = 1.0 / 32;
  const double most = larger(low, high), least = smaller(low, high);
  const bool coarse = (int{least >= alike * most} & int{!drains}) != 0;
  const double unit = 2.0 * power_of_two_below(coarse ? most : least);
  return std::copysign((std::fabs(F) + unit) - unit, F);
}

}  // namespace sluice::ice::mixture
