// Wave curve of a stiffened gas, or an ideal one (pinf = 0), in closed form. Units as in
// wave_curve.hpp.
#pragma once
#include "exact/riemann/wave_curve.hpp"

namespace sluice::exact {

class StiffenedCurve final : public WaveCurve {
 public:
  StiffenedCurve(const eos::StiffenedGas& gas, const eos::EquationOfState& law,
                 const FluidState& ahead);

  Point behind(double pressure) override;
  FluidState in_fan(double speed) const override;
  double lowest_pressure() const override { return -gas_.pinf; }

 private:
  FluidState state(double density, double velocity, double pressure) const;

  eos::StiffenedGas gas_;
  double push_;  // pressure ahead above the lowest
};

}  // namespace sluice::exact
