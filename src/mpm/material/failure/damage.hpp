// The forms of <damage_model>: functions of one particle.
#pragma once
#include <cstdint>
#include <string>

#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {

enum class DamageForm { none, johnson_cook, hancock_mackenzie, threshold, brittle };
enum class Criterion { principal_stress, principal_strain, mohr_coulomb };
enum class Distribution { constant, uniform, gauss, weibull };

struct DamageConstants {
  DamageForm form = DamageForm::none;
  // johnson_cook, hancock_mackenzie
  double initial_mean = 0, initial_deviation = 0;  // of the damage D, without unit
  double D1 = 0, D2 = 0, D3 = 0, D4 = 0, D5 = 0;   // without unit
  double room = 294, melt = 1e300;                 // K
  // threshold
  Criterion criterion = Criterion::principal_stress;
  Distribution distribution = Distribution::constant;
  // The threshold, Pa or a strain; n; V_ref, m^3, 0: no scaling by volume.
  double mean = 0, deviation = 0, exponent = 0, reference_volume = 0;
  std::uint64_t seed = 0;
  double sine = 0, cosine = 1;  // of the angle of friction
  double cutoff = 1e10;         // tension over cohesion
  // brittle
  // Pa^(1/2); G_f, J/m^2; the rest without unit.
  double r_0 = 0, fracture_energy = 0, d = 0, max_rise = 0.1, recovery = 0;
  double young = 0;  // E of the law, Pa
};

// Ratio of mean to equivalent stress, at most 1.5.
double triaxiality(const Symmetric& stress);
// d D, without unit, of a plastic strain at a rate (1/s) and temperature (K):
//   johnson_cook       d eps_p/{[D1 + D2 exp(D3 s)][1 + D4 ln max(rate, 1/s)][1 + D5 T*]}
//   hancock_mackenzie  d eps_p exp(1.5 s)/1.65,   s the triaxiality
double more_damage(const DamageConstants& c, const Symmetric& stress, double more_strain,
                   double rate, double temperature);
double damage_at_start(const DamageConstants& c, std::int64_t id);

// Bounds of eigenvalues without any: none is greater than the mean and its reach, nor than this
// with what rounding adds. Most particles are far from failing: no eigenvalues are asked for.
// T: double of one particle, Eight of eight.
template <class T>
inline T no_less(const T& mean, const T& reach) {
  return mean + reach + 1e-12 * (magnitude(mean) + reach);
}
// Is the strain of Almansi, (1 - 1/b)/2 of the largest b of F F^T, surely at most a limit; of all.
template <class T>
inline bool almansi_within(const std::array<T, 9>& F, const T& limit) {
  const std::array<T, 6> b = left_cauchy_green(F);
  const T mean = trace(b) * (1.0 / 3), one = T{} + 1.0;
  const T most = no_less(mean, eigenvalue_reach(b, mean));
  return sum_of_lanes(0.5 * (1.0 - 1.0 / most) <= limit ? T{} : one) == 0;
}
// Does failed_by_threshold() surely give 0; of all.
template <class T>
inline bool far_from_failing(const DamageConstants& c, const T& threshold,
                             const std::array<T, 6>& stress, const std::array<T, 9>& F) {
  if (c.criterion == Criterion::principal_strain) return almansi_within(F, threshold);
  const T mean = trace(stress) * (1.0 / 3), one = T{} + 1.0;
  const T reach = eigenvalue_reach(stress, mean), most = no_less(mean, reach);
  if (c.criterion == Criterion::principal_stress)
    return sum_of_lanes(most <= threshold ? T{} : one) == 0;
  // (high - low)/2 + (high + low)/2 sin phi <= reach + mean sin phi, 0 <= sin phi.
  const T sheared = no_less(T(mean * c.sine), reach);
  const T near =
      (most <= c.cutoff * threshold ? T{} : one) + (sheared <= c.cosine * threshold ? T{} : one);
  return c.sine >= 0 && sum_of_lanes(near) == 0;
}

// The particle's threshold, Pa or a strain; `volume`: m^3. Of the mean and deviation (weibull: of
// the mean and modulus, by (V_ref/V)^(1/n) where scaled by its volume).
double drawn_threshold(const DamageConstants& c, std::int64_t id, double volume);
// 0 for a sound particle, 1 failed in tension, 2 in shear:
//   principal_stress  sigma_1 > threshold
//   principal_strain  (1 - 1/b_1)/2 > threshold, of Almansi
//   mohr_coulomb      (sigma_1 - sigma_3)/2 > c cos phi - (sigma_1 + sigma_3)/2 sin phi, c the
//                     threshold; sigma_1 > cutoff c
int failed_by_threshold(const DamageConstants& c, double threshold, const Symmetric& stress,
                        const Matrix& F);

// Brittle (MAT159 of LS-DYNA): in tension tau = E^(1/2) eps_max, of Almansi; beyond the greatest
// tau so far,
//   D = (.999/d) [(1 + d)/(1 + d exp(-C (tau - r_0))) - 1],
//   C = r_0 V^(1/3) (1 + d) ln(1 + d)/(G_f d),   D up by no more than <max_damage_increment>.
// `greatest` (tau, Pa^(1/2)) is r_0 at the start; D has no unit; `volume`: m^3.
struct BrittleState {
  double damage, greatest;
};
BrittleState brittle(const DamageConstants& c, const BrittleState& old, const Symmetric& stress,
                     const Matrix& F, double volume);

}  // namespace sluice::mpm
