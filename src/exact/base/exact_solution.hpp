// What a flow should be: the exact (or reference) solution of a case at any point and time. All
// solutions are in SI units: kg/m^3, m/s, Pa, K, m, s.
#pragma once
#include <optional>

#include "framework/base/vec3.hpp"

namespace sluice::exact {

// State at one point: of an ideal gas, or of the material that is there.
struct State {
  double density = 0;
  Vec3 velocity;
  double pressure = 0;
  double gamma = 1.4;  // ratio of specific heats of the gas that is there
  int material = 0;    // number in the deck of the material that is there

  // Of materials that are no ideal gas.
  std::optional<double> known_energy = std::nullopt;  // internal, J/kg
  std::optional<double> known_temperature = std::nullopt;

  // Specific internal energy p / ((gamma - 1) rho); temperature is this over the specific heat.
  double internal_energy() const {
    return known_energy ? *known_energy : pressure / ((gamma - 1) * density);
  }
  double temperature(double specific_heat) const {
    return known_temperature ? *known_temperature : internal_energy() / specific_heat;
  }
};

class ExactSolution {
 public:
  virtual ~ExactSolution() = default;
  // The state at point x and time t >= 0. Reference solutions march to t on the first call of a
  // time and keep the result, so ask for all points of one time before the next.
  virtual State at(Vec3 x, double t) const = 0;
  // False where the state is the same all along direction d, for means over cells.
  virtual bool varies_along(int /*d*/) const { return true; }
  // How many materials take part. With more than one, density and velocity are those of the
  // mixture of a cell.
  virtual int materials() const { return 1; }
  // Of a motion of a solid: it knows, in place of at(), where the point is that began at X.
  virtual bool has_places() const { return false; }
  virtual Vec3 place(Vec3 X, double /*t*/) const { return X; }
};

}  // namespace sluice::exact
