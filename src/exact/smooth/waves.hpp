// Smooth plane flows: an advected density wave, a sound wave, a simple wave, uniform flow, a column
// at rest in gravity.
//
// Waves vary as cos(2 pi k.(x - origin) ...) with the wave vector k in periods per unit length, so
// that right- and left-going waves are mirror images about the origin. Amplitudes have no unit, all
// else is in SI units.
// Reference: G. B. Whitham, Linear and Nonlinear Waves (Wiley, 1974), section 6.8 (simple waves).
#pragma once
#include "exact/base/exact_solution.hpp"

namespace sluice::exact {

// Same density, velocity and pressure everywhere, for ever.
class Uniform final : public ExactSolution {
 public:
  explicit Uniform(State state) : state_(state) {}
  State at(Vec3, double) const override { return state_; }
  bool varies_along(int /*d*/) const override { return false; }

 private:
  State state_;
};

// Density rho0 (1 + A cos(2 pi k.(x - origin - u t))) carried at uniform velocity and pressure.
class AdvectedWave final : public ExactSolution {
 public:
  AdvectedWave(State mean, double amplitude, Vec3 wave_vector, Vec3 origin)
      : mean_(mean), amplitude_(amplitude), wave_vector_(wave_vector), origin_(origin) {}
  State at(Vec3 x, double t) const override;
  bool varies_along(int d) const override { return wave_vector_[d] != 0; }

 private:
  State mean_;
  double amplitude_;
  Vec3 wave_vector_, origin_;
};

// Linear sound wave, sense +1 along k, -1 against it; errors of order amplitude squared.
class SoundWave final : public ExactSolution {
 public:
  SoundWave(State mean, double amplitude, Vec3 wave_vector, int sense, Vec3 origin)
      : mean_(mean),
        amplitude_(amplitude),
        wave_vector_(wave_vector),
        sense_(sense),
        origin_(origin) {}
  State at(Vec3 x, double t) const override;
  bool varies_along(int d) const override { return wave_vector_[d] != 0; }

 private:
  State mean_;
  double amplitude_;
  Vec3 wave_vector_;
  int sense_;
  Vec3 origin_;
};

// Nonlinear sound wave of one family in one direction, exact until it breaks: density
// rho0 (1 + A cos(2 pi k.(x - origin))) at t = 0, u - u0 = sense 2 (c - c0)/(g-1), entropy uniform.
class SimpleWave final : public ExactSolution {
 public:
  SimpleWave(State mean, double amplitude, Vec3 wave_vector, int sense, Vec3 origin);
  double breaking_time() const { return breaking_time_; }
  State at(Vec3 x, double t) const override;  // InputError at or after the breaking time
  bool varies_along(int d) const override { return direction_[d] != 0; }

 private:
  struct Foot {
    double density, sound_speed;
  };
  Foot foot(double phase) const;

  State mean_;
  double amplitude_;
  double wave_number_;  // periods per unit length
  Vec3 direction_;
  int sense_;
  Vec3 origin_;
  double breaking_time_;
};

// Ideal gas at rest in gravity g, with state rho0, p0 at the origin. Isothermal:
// rho = rho0 exp(rho0/p0 g.(x - origin)), p = p0 rho/rho0; else of uniform density:
// p = p0 + rho0 g.(x - origin).
class HydrostaticColumn final : public ExactSolution {
 public:
  HydrostaticColumn(State base, Vec3 gravity, bool isothermal, Vec3 origin)
      : base_(base), gravity_(gravity), isothermal_(isothermal), origin_(origin) {}
  State at(Vec3 x, double t) const override;
  bool varies_along(int d) const override { return gravity_[d] != 0; }

 private:
  State base_;
  Vec3 gravity_;
  bool isothermal_;
  Vec3 origin_;
};

}  // namespace sluice::exact
