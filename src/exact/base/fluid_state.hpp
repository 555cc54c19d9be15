// One fluid at one point: a state of any equation of state, and the ways to make one. SI units:
// kg/m^3, m/s, Pa, K.
#pragma once
#include "eos/eos.hpp"

namespace sluice::exact {

// The energy (internal, J/kg) is kept beside the pressure, because some laws cannot tell it.
struct FluidState {
  double density = 0, velocity = 0, pressure = 0, energy = 0;
};

// Each throws InputError, naming law and numbers, where the law has no such state. Laws whose
// pressure depends on density alone have none of density and pressure: use the temperature.
FluidState state_of_pressure(const eos::EquationOfState& law, double density, double velocity,
                             double pressure);
FluidState state_of_temperature(const eos::EquationOfState& law, double density, double velocity,
                                double temperature);
FluidState state_of_pressure_and_temperature(const eos::EquationOfState& law, double pressure,
                                             double temperature, double velocity);

bool pressure_depends_on_energy(const eos::EquationOfState& law);
double temperature(const eos::EquationOfState& law, const FluidState& state);
double sound_speed(const eos::EquationOfState& law, const FluidState& state);

inline FluidState mirrored(FluidState state) {
  state.velocity = -state.velocity;
  return state;
}

}  // namespace sluice::exact
