// The states that one wave can reach: shocks of higher, rarefactions of lower pressure.
//
// The wave runs to the right into fluid at rest; velocities are relative to that fluid. Shocks obey
// Rankine and Hugoniot, e - e0 = (p + p0)(v0 - v)/2 and (u - u0)^2 = (p - p0)(v0 - v); rarefactions
// are isentropic with du = dp/(rho c).
// Ideal and stiffened gases have closed formulas (Toro, 3rd ed., eqs. 4.6, 4.63, with p + pinf for
// p); any other law finds the density of a shock by a bracketed search and integrates its
// isentrope.
// References: E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed.
// (Springer, 2009), ch. 4; R. Menikoff and B. J. Plohr, Rev. Mod. Phys. 61 (1989) 75.
// Limit: laws that are convex along the curve (no phase changes, no split waves). Pressures in Pa,
// speeds in m/s.
#pragma once
#include <memory>

#include "exact/base/fluid_state.hpp"

namespace sluice::exact {

class WaveCurve {
 public:
  virtual ~WaveCurve() = default;

  struct Point {
    FluidState state;
    double slope = 0;  // du/dp along the curve, m^2 s/kg
  };
  // The state behind the wave to this pressure. Throws InputError where the curve does not reach.
  // Not const: a curve without formula keeps what it integrated.
  virtual Point behind(double pressure) = 0;

  // The state in the fan where velocity plus speed of sound is `speed`; behind() must have been
  // asked for a pressure as low.
  virtual FluidState in_fan(double speed) const = 0;

  // Pressures of the curve lie above this one (it may end earlier).
  virtual double lowest_pressure() const = 0;

  const FluidState& ahead() const { return ahead_; }  // as given, with its velocity
  double sound_speed_ahead() const { return sound_speed_; }

  // Slowest and fastest signal of the wave to a state behind: equal for a shock.
  struct Speeds {
    double head, tail;
  };
  Speeds speeds(const FluidState& behind) const;

 protected:
  WaveCurve(const eos::EquationOfState& law, const FluidState& ahead);

  // Throws the InputError that this curve does not reach the pressure.
  [[noreturn]] void refuse(double pressure, const char* why) const;

  eos::EquationOfState law_;
  FluidState ahead_;
  double sound_speed_;
};

enum class WaveFormulas { closed_if_any, general };

// Throws InputError when the state is none of the law.
std::unique_ptr<WaveCurve> make_wave_curve(const eos::EquationOfState& law, const FluidState& ahead,
                                           WaveFormulas formulas = WaveFormulas::closed_if_any);

}  // namespace sluice::exact
