// Exact solution of the Riemann problem of two materials with any equations of state.
//
// The pressure p* of the contact is the root of g_L(p) + g_R(p) + u_R - u_L = 0, where g is the
// velocity that a side's wave to p gives it (wave_curve.hpp); Newton's iteration in a bracket.
// References: E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed.
// (Springer, 2009), ch. 4; R. Menikoff and B. J. Plohr, Rev. Mod. Phys. 61 (1989) 75, section V.
// Limits: no void between the materials (for ideal gases see riemann.hpp); convex laws. SI units:
// Pa, m/s, K.
#pragma once
#include <memory>

#include "exact/riemann/wave_curve.hpp"

namespace sluice::exact {

struct MaterialSide {
  eos::EquationOfState law;
  FluidState state;
};

class MaterialRiemann {
 public:
  // Throws InputError when a state is none of its law, or the sides part so fast that a void opens.
  MaterialRiemann(const MaterialSide& left, const MaterialSide& right,
                  WaveFormulas formulas = WaveFormulas::closed_if_any);

  double star_pressure() const { return star_left_.pressure; }
  double star_velocity() const { return star_left_.velocity; }  // of the contact
  const FluidState& star_left() const { return star_left_; }
  const FluidState& star_right() const { return star_right_; }

  // Signals of a side's wave: equal for a shock, head and tail of a fan.
  WaveCurve::Speeds left_wave() const { return left_wave_; }
  WaveCurve::Speeds right_wave() const { return right_wave_; }

  // State on the ray x/t = speed, and whose it is: 0 the left material, 1 the right one.
  struct Sample {
    FluidState state;
    int side = 0;
  };
  Sample sample(double speed) const;
  double temperature(const Sample& sample) const;

 private:
  void solve(WaveCurve& left, WaveCurve& right);

  MaterialSide left_, right_;  // the curves of the left side are those of its mirror image
  std::shared_ptr<const WaveCurve> left_curve_, right_curve_;
  FluidState star_left_, star_right_;
  WaveCurve::Speeds left_wave_{}, right_wave_{};
};

}  // namespace sluice::exact
