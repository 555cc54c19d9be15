#include "exact/riemann/wave_curve.hpp"

#include <fmt/format.h>

#include <cmath>
#include <type_traits>

#include "exact/base/law_text.hpp"
#include "exact/riemann/general_curve.hpp"
#include "exact/riemann/stiffened_curve.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact {

WaveCurve::WaveCurve(const eos::EquationOfState& law, const FluidState& ahead)
    : law_(law), ahead_(ahead), sound_speed_(sound_speed(law, ahead)) {
  const bool good = std::visit(
      [&](const auto& l) { return l.admissible(ahead.density, ahead.density * ahead.energy); },
      law);
  if (!good || !std::isfinite(ahead.velocity) || !(sound_speed_ > 0)) {
    throw InputError(fmt::format(
        "equation of state {}: density {}, pressure {}, energy {}, velocity {} is not an "
        "admissible state",
        eos::name_of(law), ahead.density, ahead.pressure, ahead.energy, ahead.velocity));
  }
}

void WaveCurve::refuse(double pressure, const char* why) const {
  throw InputError(
      fmt::format("equation of state {}: no wave from density {} and pressure {} leads to pressure "
                  "{}: {}; try states that are closer",
                  eos::name_of(law_), ahead_.density, ahead_.pressure, pressure, why));
}

WaveCurve::Speeds WaveCurve::speeds(const FluidState& behind) const {
  if (behind.pressure > ahead_.pressure) {  // mass flux over density; sound where it is 0/0
    const double speed =
        behind.velocity > 1e-8 * sound_speed_
            ? (behind.pressure - ahead_.pressure) / (ahead_.density * behind.velocity)
            : sound_speed_;
    return {speed, speed};
  }
  return {sound_speed_, behind.velocity + sound_speed(law_, behind)};
}

std::unique_ptr<WaveCurve> make_wave_curve(const eos::EquationOfState& law, const FluidState& ahead,
                                           WaveFormulas formulas) {
  return std::visit(
      [&]<class Law>(const Law& own) -> std::unique_ptr<WaveCurve> {
        if (formulas == WaveFormulas::closed_if_any) {
          if constexpr (std::is_same_v<Law, eos::StiffenedGas>)
            return std::make_unique<StiffenedCurve>(own, law, ahead);
          if constexpr (std::is_same_v<Law, eos::IdealGas>) {
            eos::StiffenedGas gas;
            gas.gamma = own.gamma;
            gas.specific_heat = own.specific_heat;
            return std::make_unique<StiffenedCurve>(gas, law, ahead);
          }
        }
        return std::make_unique<GeneralCurve<Law>>(own, law, ahead);
      },
      law);
}

}  // namespace sluice::exact
