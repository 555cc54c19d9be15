// The yield surface of porous rock in the meridian plane: a limit curve for shear that falls with
// tension, closed on the side of compression by an elliptic cap (Fossum and Brannon 2004,
// SAND2004-3226; Homel and Brannon 2015, Int. J. Fracture 194).
//
//   J2^(1/2) = F_f(I) F_c(I),   X <= I <= PEAKI1,   I = tr sigma - zeta, positive in tension
//   F_f = a1 - a3 exp(a2 I) - a4 I
//   F_c^2 = 1 - ((kappa - I)/(kappa - X))^2 for I < kappa, 1 beyond
// Both factors are concave and the elastic domain is convex, so that the nearest point is one.
#pragma once
#include <optional>

namespace sluice::mpm {

struct LimitCurve {
  double a1 = 0, a2 = 0, a3 = 0, a4 = 0;  // Pa, 1/Pa, Pa, 1
  double peak = 0;                        // PEAKI1, Pa
};

// Linear (Drucker and Prager) without STREN and YSLOPE; von Mises without FSLOPE; curved with
// FSLOPE and STREN, towards the slope YSLOPE. Nothing where the numbers are none of these. PEAKI1
// and STREN in Pa, slopes without unit.
std::optional<LimitCurve> limit_curve(double PEAKI1, double FSLOPE, double STREN, double YSLOPE);

// A point of the meridian plane: I and q = J2^(1/2), Pa.
struct Meridian {
  double I = 0, q = 0;
};

struct CapSurface {
  LimitCurve limit;
  double X = 0, kappa = 0;  // Pa; X <= kappa < limit.peak; flat at X where equal

  double strength(double I) const;  // F_f F_c, Pa; I in [X, peak]
  double slope(double I) const;     // its derivative, without unit; great, but finite, at X
  bool contains(const Meridian& m) const {
    return m.I >= X && m.I <= limit.peak && m.q <= strength(m.I);
  }
  // Of a trial outside, in the plane (z, r) = (I/3^(1/2), 2^(1/2) scale q): scale (2 G/(3 K))^(1/2)
  // turns the distance into elastic energy, where the nearest point is the associated return; it
  // has no unit.
  Meridian nearest(const Meridian& trial, double scale) const;
};

}  // namespace sluice::mpm
