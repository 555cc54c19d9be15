// Debye's specific heat of a crystal.
//
//   e = 3 N k T D(x),  cv = 3 N k [4 D(x) - 3 x/(exp x - 1)],  x = theta/T,
//   D(x) = 3/x^3 * integral of t^3/(exp t - 1) from 0 to x.
// Units: N atoms per kg, theta and T K, e J/kg, cv J/(kg K); the energy at 0 K is left out; D and x
// have none. Reference: Debye,
// Ann. Phys. 39 (1912) 789; series: Abramowitz and Stegun, 27.1. D by its power series below x = 2
// and by the series of exponentials above: relative error 2e-15. Limits: harmonic lattice, no
// electrons; theta does not follow the density.
#pragma once
#include <cmath>
#include <numbers>

#include "eos/bracketed_root.hpp"

namespace sluice::eos {

// Third Debye function D(x), x >= 0.
inline double debye_function(double x) {
  if (x < 2.0) {
    // 3 B_2k/((2k + 3)(2k)!), k = 1, 2, ..., with the Bernoulli numbers B
    static constexpr double c[16] = {
        0.050000000000000003,    -0.00059523809523809529, 1.1022927689594357e-05,
        -2.2546897546897547e-07, 4.8177131510464845e-09,  -1.0568380277374986e-10,
        2.3616240936502374e-12,  -5.3521267836672358e-14, 1.2265802937539779e-15,
        -2.8367852589887764e-17, 6.6108033940322754e-19,  -1.5504960762013913e-20,
        3.6565934892718629e-22,  -8.6646942842298835e-24, 2.0617749566706209e-25,
        -4.924106287604745e-27};
    double sum = 0.0;
    for (int k = 15; k >= 0; --k) sum = sum * x * x + c[k];
    return 1.0 - 0.375 * x + sum * x * x;
  }
  const double q = std::exp(-x), r = 1.0 / x, pi2 = std::numbers::pi * std::numbers::pi;
  double sum = 0.0, power = q;
  for (int k = 1; k <= 20; ++k, power *= q) {
    const double i = 1.0 / k, ir = i * r;
    sum += power * i * (1.0 + ir * (3.0 + ir * (6.0 + 6.0 * ir)));
  }
  return 3.0 * r * r * r * (pi2 * pi2 / 15.0) - 3.0 * sum;
}

struct DebyeHeat {
  double atoms_per_mass = 1.0;
  double debye_temperature = 300.0;

  static constexpr double boltzmann = 1.380649e-23;  // J/K
  // cv far above the Debye temperature, J/(kg K).
  double limit() const { return 3.0 * atoms_per_mass * boltzmann; }

  double specific_heat(double T) const {
    if (!(T > 0.0)) return 0.0;
    const double x = debye_temperature / T;
    return limit() * (4.0 * debye_function(x) - (x < 700.0 ? 3.0 * x / std::expm1(x) : 0.0));
  }
  double energy(double T) const {
    return T > 0.0 ? limit() * T * debye_function(debye_temperature / T) : 0.0;
  }
  double temperature(double e) const {  // 1 - 3x/8 <= D <= 1 gives the bracket
    if (!(e > 0.0)) return e < 0.0 ? e / limit() : e;
    const double t = e / limit(), high = t + 0.375 * debye_temperature;
    const auto excess = [&](double T) { return ValueAndSlope{energy(T) - e, specific_heat(T)}; };
    return bracketed_root(excess, t, high, high);
  }
};

}  // namespace sluice::eos
