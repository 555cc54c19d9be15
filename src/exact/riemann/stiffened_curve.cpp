#include "exact/riemann/stiffened_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"

namespace sluice::exact {

StiffenedCurve::StiffenedCurve(const eos::StiffenedGas& gas, const eos::EquationOfState& law,
                               const FluidState& ahead)
    : WaveCurve(law, ahead), gas_(gas), push_(ahead.pressure + gas.pinf) {}

FluidState StiffenedCurve::state(double density, double velocity, double pressure) const {
  return {density, velocity, pressure, gas_.energy_from_pressure(density, pressure) / density};
}

WaveCurve::Point StiffenedCurve::behind(double pressure) {
  const double g = gas_.gamma, rho = ahead_.density, jump = pressure - ahead_.pressure;
  const double push = pressure + gas_.pinf;
  if (!(push > 0)) {
    throw InputError(
        fmt::format("stiffened gas: pressure {} is not above -pinf = {}", pressure, -gas_.pinf));
  }
  if (jump > 0) {
    const double a = 2 / ((g + 1) * rho), k = (g - 1) / (g + 1), b = k * push_;
    const double root = std::sqrt(a / (push + b));
    const double density = rho * (push + b) / (k * push + push_);
    return {state(density, jump * root, pressure), root * (1 - 0.5 * jump / (push + b))};
  }
  // log1p and expm1 keep weak waves accurate
  const double c = sound_speed_, ratio = push / push_;
  const double logarithm = ratio > 0.5 ? std::log1p(jump / push_) : std::log(ratio);
  const double velocity = 2 * c / (g - 1) * std::expm1((g - 1) / (2 * g) * logarithm);
  return {state(rho * std::exp(logarithm / g), velocity, pressure),
          std::exp(-(g + 1) / (2 * g) * logarithm) / (rho * c)};
}

FluidState StiffenedCurve::in_fan(double speed) const {
  const double g = gas_.gamma, c0 = sound_speed_;
  const double c = std::max(0.0, (2 * c0 + (g - 1) * speed) / (g + 1));
  const double velocity = 2 / (g + 1) * (speed - c0), share = c / c0;
  return state(ahead_.density * std::pow(share, 2 / (g - 1)), velocity,
               push_ * std::pow(share, 2 * g / (g - 1)) - gas_.pinf);
}

}  // namespace sluice::exact
