// The forms of <damage_model>.
#include "mpm/material/failure/damage.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/material/base/particle_random.hpp"

namespace sluice::mpm {
namespace {

// The largest principal strain of Almansi, (1 - 1/b)/2 of the largest b of F F^T.
double almansi(const Matrix& F) {
  const double b = principal(left_cauchy_green(F)).values[2];
  return 0.5 * (1 - 1 / b);
}

}  // namespace

double triaxiality(const Symmetric& stress) {
  const double mean = trace(stress) / 3, equivalent = 1.5 * eigenvalue_reach(stress, mean);
  if (equivalent <= 1e-12 * std::abs(mean)) return mean > 0 ? 1.5 : mean < 0 ? -1.5 : 0;
  return std::clamp(mean / equivalent, -1.5, 1.5);
}

double more_damage(const DamageConstants& c, const Symmetric& stress, double more_strain,
                   double rate, double temperature) {
  if (!(more_strain > 0)) return 0;
  const double s = triaxiality(stress);
  if (c.form == DamageForm::hancock_mackenzie) return more_strain * std::exp(1.5 * s) / 1.65;
  const double warm = std::max((temperature - c.room) / (c.melt - c.room), 0.0);
  const double at_failure = (c.D1 + c.D2 * std::exp(c.D3 * s)) *
                            (1 + c.D4 * std::log(std::max(rate, 1.0))) * (1 + c.D5 * warm);
  return more_strain / std::max(at_failure, 1e-6);
}

double damage_at_start(const DamageConstants& c, std::int64_t id) {
  if (c.initial_deviation == 0) return c.initial_mean;
  return std::max(0.0, c.initial_mean + c.initial_deviation * particle_gauss(id, c.seed, 1));
}

double drawn_threshold(const DamageConstants& c, std::int64_t id, double volume) {
  double drawn = c.mean;
  switch (c.distribution) {
    case Distribution::constant:
      break;
    case Distribution::uniform:
      drawn = c.mean + c.deviation * (2 * particle_random(id, c.seed, 0) - 1);
      break;
    case Distribution::gauss:
      drawn = c.mean + c.deviation * particle_gauss(id, c.seed, 0);
      break;
    case Distribution::weibull:
      drawn = c.mean / std::tgamma(1 + 1 / c.deviation) *
              std::pow(-std::log(particle_random(id, c.seed, 0)), 1 / c.deviation);
      break;
  }
  if (c.reference_volume > 0) drawn *= std::pow(c.reference_volume / volume, 1 / c.exponent);
  return drawn;
}

int failed_by_threshold(const DamageConstants& c, double threshold, const Symmetric& stress,
                        const Matrix& F) {
  if (far_from_failing(c, threshold, stress, F)) return 0;
  if (c.criterion == Criterion::principal_strain) return almansi(F) > threshold ? 1 : 0;
  if (c.criterion == Criterion::principal_stress) {
    const double mean = trace(stress) / 3;
    if (mean + eigenvalue_reach(stress, mean) <= threshold) return 0;
  }
  const Principal p = principal(stress);
  const double low = p.values[0], high = p.values[2];
  if (c.criterion == Criterion::principal_stress) return high > threshold ? 1 : 0;
  if (high > c.cutoff * threshold) return 1;
  const double shear = 0.5 * (high - low);
  return shear > threshold * c.cosine - 0.5 * (high + low) * c.sine ? 2 : 0;
}

BrittleState brittle(const DamageConstants& c, const BrittleState& old, const Symmetric& stress,
                     const Matrix& F, double volume) {
  if (!(trace(stress) > 0)) return old;
  const double root = std::sqrt(c.young);
  if (root > 0 && almansi_within(F, old.greatest / root * (1 - 1e-12))) return old;
  const double tau = root * almansi(F);
  if (!(tau > old.greatest)) return old;
  const double d = c.d;
  const double C = c.r_0 * std::cbrt(volume) * (1 + d) * std::log1p(d) / (c.fracture_energy * d);
  const double D = 0.999 / d * ((1 + d) / (1 + d * std::exp(-C * (tau - c.r_0))) - 1);
  return {std::max(old.damage, std::min(D, old.damage + c.max_rise)), tau};
}

}  // namespace sluice::mpm
