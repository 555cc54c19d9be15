// Ideal gas with constant specific heats.
//
//   p = (gamma - 1) rho e,   e = cv T,   c^2 = gamma p / rho.
// Admissible: rho > 0, e > 0. Shock speed against particle speed: slope (gamma + 1)/2 (exact for
// strong shocks; Dukowicz, J. Comput. Phys. 61 (1985) 119).
// Units as in gruneisen_form.hpp, whose functions these are.
#pragma once
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "eos/parameter.hpp"

namespace sluice::eos {

struct IdealGas {
  double gamma = 1.4;          // ratio of specific heats
  double specific_heat = 1.0;  // cv, J/(kg K)

  static constexpr std::string_view name = "ideal_gas";
  static constexpr auto parameters() {
    return std::array{gamma_of_material<IdealGas>(), heat_of_material<IdealGas>()};
  }
  double constant_heat_capacity_ratio() const { return gamma; }
  double heat_capacity_ratio(double /*rho*/, double /*rho_e*/, double /*T*/, double /*cv*/) const {
    return gamma;
  }
  static constexpr bool depends_on_energy = true;
  static constexpr bool takes_any_heat = true;

  // From density (kg/m^3) and internal energy per volume (J/m^3).
  double pressure(double /*rho*/, double rho_e) const { return (gamma - 1.0) * rho_e; }
  double sound_speed(double rho, double p) const { return std::sqrt(gamma * p / rho); }
  double sound_speed_squared(double rho, double rho_e) const {
    return gamma * (gamma - 1.0) * rho_e / rho;
  }
  double bulk_modulus(double /*rho*/, double p) const { return gamma * p; }  // rho c^2
  double dp_drho(double rho, double rho_e) const { return (gamma - 1.0) * rho_e / rho; }
  double dp_de(double rho, double /*rho_e*/) const { return (gamma - 1.0) * rho; }
  double temperature(double rho, double rho_e) const { return rho_e / (rho * specific_heat); }
  double thermal_energy(double rho, double rho_e) const { return rho_e / rho; }
  double cold_energy(double /*rho*/) const { return 0.0; }

  // Internal energy per volume, J/m^3.
  double energy_from_pressure(double /*rho*/, double p) const { return p / (gamma - 1.0); }
  double energy_from_temperature(double rho, double T) const { return rho * specific_heat * T; }
  // Density at pressure (Pa) and temperature (K).
  double density(double p, double T) const { return p / ((gamma - 1.0) * specific_heat * T); }
  double density_at_thermal_energy(double p, double thermal) const {
    return p / ((gamma - 1.0) * thermal);
  }

  double shock_slope() const { return 0.5 * (gamma + 1.0); }
  double lowest_pressure() const { return 0.0; }
  double highest_density() const { return std::numeric_limits<double>::infinity(); }
  bool admissible(double rho, double rho_e) const {
    const double e = rho_e / rho;
    return rho > 0.0 && e > 0.0 && e < std::numeric_limits<double>::infinity();
  }
};

}  // namespace sluice::eos
