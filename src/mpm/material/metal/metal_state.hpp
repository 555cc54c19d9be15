// What the parts of a metal's law may depend on; pressures are positive in compression.
#pragma once

namespace sluice::mpm {

struct MetalState {
  double temperature = 0;  // T, K
  double pressure = 0;     // p, Pa
  double compression = 1;  // eta = rho/rho_0
  double density = 0;      // rho, kg/m^3
  double shear = 0;        // mu at this state, Pa
  double melt = 0;         // T_m at this state, K
};

// No law of rates is asked for less: logarithms end.
inline constexpr double min_rate = 1e-8;  // 1/s

}  // namespace sluice::mpm
