// Limit curve and cap, and the nearest point of both together.
#include "mpm/material/geologic/cap_surface.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/material/base/plastic_root.hpp"

namespace sluice::mpm {

std::optional<LimitCurve> limit_curve(double PEAKI1, double FSLOPE, double STREN, double YSLOPE) {
  LimitCurve c;
  c.peak = PEAKI1;
  if (PEAKI1 < 0 || FSLOPE < 0 || STREN < 0 || YSLOPE < 0) return std::nullopt;
  if (STREN == 0 && YSLOPE == 0 && FSLOPE > 0) {
    c.a1 = FSLOPE * PEAKI1;
    c.a4 = FSLOPE;
    return c;
  }
  if (FSLOPE == 0 && YSLOPE == 0 && STREN > 0) {
    c.a1 = STREN;
    return c;
  }
  const double rise = STREN - YSLOPE * PEAKI1;
  if (!(FSLOPE > YSLOPE) || !(rise > 0)) return std::nullopt;
  c.a1 = STREN;
  c.a2 = (FSLOPE - YSLOPE) / rise;
  c.a3 = rise * std::exp(-c.a2 * PEAKI1);
  c.a4 = YSLOPE;
  return c;
}

namespace {

double cap(double kappa, double X, double I) {
  if (I >= kappa) return 1;
  const double t = (kappa - I) / (kappa - X);
  return std::sqrt(std::max((1 - t) * (1 + t), 1e-30));
}
double exponential_part(const LimitCurve& c, double I) {
  return c.a3 == 0 ? 0 : c.a3 * std::exp(c.a2 * I);
}

}  // namespace

double CapSurface::strength(double I) const {
  const double F = limit.a1 - exponential_part(limit, I) - limit.a4 * I;
  return std::max(F, 0.0) * cap(kappa, X, I);
}

double CapSurface::slope(double I) const {
  const double e = exponential_part(limit, I), F = limit.a1 - e - limit.a4 * I;
  const double f = cap(kappa, X, I);
  const double of_limit = -(limit.a2 * e + limit.a4) * f;
  if (I >= kappa) return of_limit;
  const double width = kappa - X;
  return of_limit + std::max(F, 0.0) * ((kappa - I) / width) / (width * f);
}

// The distance is least where (z - z_tr) + (r - r_tr) dr/dz = 0. The nearest point has r <= r_tr
// and, seen from the highest point of the surface, lies on the trial's side: there the left side
// rises with z, and with the slope of the other side taken as 0 it does so everywhere.
Meridian CapSurface::nearest(const Meridian& trial, double scale) const {
  const double at = std::clamp(trial.I, X, limit.peak);
  const bool left = trial.I < X || (trial.I <= limit.peak && slope(at) > 0);
  const double per_q = std::sqrt(6.0) * scale;  // r = per_q q/3^(1/2)
  const auto side = [&](double I) {
    const double s = slope(I);
    return left ? std::max(s, 0.0) : std::min(s, 0.0);
  };
  const auto excess = [&](double I) {
    return (I - trial.I) + per_q * per_q * (strength(I) - trial.q) * side(I);
  };
  // No farther than a point of the domain that is known.
  const double known = std::min(trial.q, strength(at));
  const double reach = std::hypot(trial.I - at, per_q * (trial.q - known));
  const double low = std::max(X, trial.I - reach), high = std::min(limit.peak, trial.I + reach);
  double I = high;
  if (!(excess(low) < 0)) {
    I = low;
  } else if (excess(high) > 0) {
    const double span = high - low;
    I = low + falling_root([&](double x) { return -excess(low + x); }, -excess(low), span, 0,
                           1e-14 * (reach + std::abs(trial.I)));
  }
  return {I, std::min(trial.q, strength(I))};
}

}  // namespace sluice::mpm
