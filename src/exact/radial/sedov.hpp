// Sedov-Taylor point blast in a cold uniform ideal gas: planar, cylindrical or spherical.
//
// The shock stands at R = (E t^2 / (alpha rho0))^(1/(j+2)), j = 1, 2, 3; the profile behind it is
// Sedov's closed form in the similarity variable V, and alpha follows from the energy integral.
// E is the energy released on both sides of the plane (j = 1), per length of the axis (j = 2), in
// all (j = 3): J/m^2, J/m, J; alpha has no unit.
// References: L. I. Sedov, Similarity and Dimensional Methods in Mechanics (Academic Press, 1959),
// ch. IV; J. R. Kamm and F. X. Timmes, On efficient generation of numerically robust Sedov
// solutions, LA-UR-07-2849 (2007), "standard case" of uniform density.
// Limits: 1 < gamma < 7 (spherical); above, a void opens at the centre (not built).
#pragma once
#include <vector>

#include "exact/base/exact_solution.hpp"
#include "exact/base/symmetry.hpp"

namespace sluice::exact {

class SedovProfile {
 public:
  // InputError for a gamma that is none of these, or 2.
  SedovProfile(int dimension, double gamma);

  // alpha of the shock radius, both sides counted when planar.
  double alpha() const { return alpha_; }

  // Density, velocity and pressure relative to their values just behind the shock, at
  // 0 <= lambda = r/R <= 1.
  struct Scaled {
    double density, velocity, pressure;
  };
  Scaled at(double lambda) const;

 private:
  Scaled at_log_x2(double log_x2, double& log_lambda) const;
  double energy_integral() const;

  int dimension_;
  double gamma_;
  // Exponents and factors of Kamm and Timmes, eqs. 33-47, for uniform density.
  double a0_, a1_, a2_, a3_, a4_, a5_;
  double alpha_ = 0;
};

class Sedov final : public ExactSolution {
 public:
  struct Blast {
    int dimension = 3;
    double gamma = 1.4, density = 1, energy = 1;
    double pressure = 0;  // of the gas ahead, only reported, taken as negligible
    Vec3 origin;
    Vec3 axis{0, 0, 1};  // normal of the plane of symmetry when cylindrical, direction when planar
  };
  explicit Sedov(Blast blast);

  double shock_radius(double t) const;  // m
  double shock_speed(double t) const;   // m/s
  State at(Vec3 x, double t) const override;
  bool varies_along(int d) const override {
    return varies_radially(blast_.dimension, blast_.axis, d);
  }

 private:
  Blast blast_;
  SedovProfile profile_;
};

}  // namespace sluice::exact
