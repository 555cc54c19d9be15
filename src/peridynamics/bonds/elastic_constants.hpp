// Constants of bonds from moduli.
//
//   PMB of one constant: c = 2 k d^2/S, S = integral of omega r over the horizon
//   critical energy of a bond over its weight beta: w_c = G0/(sum over lattice offsets with a > 0
//   of a beta V): to cut all bonds that cross a lattice plane costs G0 per area
//   critical stretch: s0^2 = 2 G0/(sum of a V c omega beta r)  (PMB)
//   LPS with omega = 1 (S. A. Silling, F. Bobaru; E. Madenci, E. Oterkus (2014), chapter 6):
//     s0^2 = G0/[(3 mu + (3/4)^4 (k - 5 mu/3)) delta]            (3-D)
//     s0^2 = G0/[(6 mu/pi + 16 (k - 2 mu)/(9 pi^2)) delta]       (2-D)
// delta, dx: m; k, mu: Pa; G0: J/m^2; c: N/m^6.
#pragma once
#include "peridynamics/points/bond_rule.hpp"

namespace sluice::peridynamics {

// S: integral of omega r dV over a ball, disk (times thickness) or line (times area).
double family_integral(const PeriScene& scene, double delta);
// Energy density of a bond at which it breaks, J/m^6; of a point with this spacing.
double critical_bond_energy(const PeriScene& scene, const PeriMaterial& m, double dx);
double critical_stretch(const PeriScene& scene, const PeriMaterial& m, double dx);

}  // namespace sluice::peridynamics
