// Plane vortices in the x-y plane: the isentropic one, carried by a uniform stream, and Gresho's.
//
// References: C.-W. Shu, Essentially non-oscillatory and weighted ENO schemes, ICASE Report 97-65
// (1997), section 5.1 (isentropic vortex); R. Liska and B. Wendroff, Comparison of several
// difference schemes on 1D and 2D test problems for the Euler equations, SIAM J. Sci. Comput. 25
// (2003) 995-1017, section 4.5 (Gresho vortex).
#pragma once
#include "exact/base/exact_solution.hpp"

namespace sluice::exact {

// u = u0 + b/(2 pi) exp((1-r^2)/2) (-y, x), T = 1 - (g-1) b^2/(8 g pi^2) exp(1-r^2), in units of
// the stream's density and pressure 1 and r in units of the core radius. With a period the vortex
// re-enters on the other side; its nearest image counts.
class IsentropicVortex final : public ExactSolution {
 public:
  struct Stream {
    double strength = 5, gamma = 1.4;  // b and the ratio of specific heats, without unit
    Vec3 velocity, centre;             // in those units
    double period = 0;                 // of the square domain, in core radii; 0 without
  };
  explicit IsentropicVortex(Stream stream) : stream_(stream) {}
  State at(Vec3 x, double t) const override;
  bool varies_along(int d) const override { return d != 2; }

 private:
  Stream stream_;
};

// Steady triangular vortex: swirl 5 r (r < 0.2), 2 - 5 r (r < 0.4), 0 beyond, times the peak speed,
// with the pressure that balances it about the mean that gives the peak's Mach number.
class GreshoVortex final : public ExactSolution {
 public:
  GreshoVortex(double mach, double gamma, Vec3 centre)
      : mach_(mach), gamma_(gamma), centre_(centre) {}
  State at(Vec3 x, double t) const override;
  bool varies_along(int d) const override { return d != 2; }

 private:
  double mach_, gamma_;
  Vec3 centre_;
};

}  // namespace sluice::exact
