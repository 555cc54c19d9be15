#include "exact/base/fluid_state.hpp"

#include <fmt/format.h>

#include <cmath>

#include "exact/base/law_text.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

[[noreturn]] void refuse(const eos::EquationOfState& law, const std::string& what) {
  throw InputError(
      fmt::format("equation of state {}: there is no admissible state with {}; allowed are the "
                  "states inside its range of validity",
                  eos::name_of(law), what));
}

}  // namespace

FluidState state_of_pressure(const eos::EquationOfState& law, double density, double velocity,
                             double pressure) {
  return std::visit(
      [&](const auto& l) -> FluidState {
        if constexpr (requires { l.energy_from_pressure(density, pressure); }) {
          const double rho_e = l.energy_from_pressure(density, pressure);
          if (!std::isfinite(velocity) || !l.admissible(density, rho_e))
            refuse(law, fmt::format("density {}, velocity {}, pressure {}", density, velocity,
                                    pressure));
          return {density, velocity, pressure, rho_e / density};
        } else {
          throw InputError(
              fmt::format("equation of state {}: density and pressure do not determine the energy, "
                          "because the pressure depends on density only; give the temperature",
                          eos::name_of(law)));
        }
      },
      law);
}

FluidState state_of_temperature(const eos::EquationOfState& law, double density, double velocity,
                                double temperature) {
  return std::visit(
      [&](const auto& l) -> FluidState {
        const double rho_e = l.energy_from_temperature(density, temperature);
        if (!std::isfinite(velocity) || !l.admissible(density, rho_e))
          refuse(law, fmt::format("density {}, velocity {}, temperature {}", density, velocity,
                                  temperature));
        return {density, velocity, l.pressure(density, rho_e), rho_e / density};
      },
      law);
}

FluidState state_of_pressure_and_temperature(const eos::EquationOfState& law, double pressure,
                                             double temperature, double velocity) {
  return std::visit(
      [&](const auto& l) -> FluidState {
        const double density = l.density(pressure, temperature);
        const double rho_e = l.energy_from_temperature(density, temperature);
        if (!std::isfinite(velocity) || !l.admissible(density, rho_e))
          refuse(law, fmt::format("pressure {}, temperature {}, velocity {}", pressure, temperature,
                                  velocity));
        return {density, velocity, pressure, rho_e / density};
      },
      law);
}

bool pressure_depends_on_energy(const eos::EquationOfState& law) {
  return std::visit([]<class Law>(const Law&) { return static_cast<bool>(Law::depends_on_energy); },
                    law);
}

double temperature(const eos::EquationOfState& law, const FluidState& state) {
  return std::visit(
      [&](const auto& l) { return l.temperature(state.density, state.density * state.energy); },
      law);
}

double sound_speed(const eos::EquationOfState& law, const FluidState& state) {
  return std::visit(
      [&](const auto& l) {
        return std::sqrt(l.sound_speed_squared(state.density, state.density * state.energy));
      },
      law);
}

}  // namespace sluice::exact
