// Thermally perfect gas: p = rho R T with a specific heat that depends on temperature.
//
//   e = integral of cv(T),   gamma(T) = 1 + R/cv(T),   c^2 = gamma(T) R T.
// Units: R J/(kg K). Reference: Anderson, Hypersonic and High Temperature Gas Dynamics (1989),
// chapter 11. Limits: no dissociation. Admissible: rho > 0, T > 0. Shock slope 1.2: gamma 1.4 when
// strong. With a deck's gamma and cv at some temperature, R = (gamma - 1) cv. Functions and their
// units are those of gruneisen_form.hpp.
#pragma once
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "eos/parameter.hpp"

namespace sluice::eos {

template <class Heat>
struct PerfectGas {
  double gas_constant = 287.0;
  Heat heat;

  // Decks name an ideal gas, and a specific heat beside it.
  static constexpr std::string_view name = "thermally perfect gas";
  static constexpr auto parameters() { return std::array<Parameter<PerfectGas>, 0>{}; }
  double heat_capacity_ratio(double /*rho*/, double /*rho_e*/, double T, double /*cv*/) const {
    return gamma(T);
  }
  static constexpr bool depends_on_energy = true;
  static constexpr bool takes_any_heat = false;
  double pressure(double rho, double rho_e) const {
    return rho * gas_constant * temperature(rho, rho_e);
  }
  double dp_drho(double rho, double rho_e) const { return gas_constant * temperature(rho, rho_e); }
  double dp_de(double rho, double rho_e) const {
    return rho * gas_constant / heat.specific_heat(temperature(rho, rho_e));
  }
  double sound_speed_squared(double rho, double rho_e) const {
    const double T = temperature(rho, rho_e);
    return gamma(T) * gas_constant * T;
  }
  double bulk_modulus(double rho, double p) const { return gamma(p / (rho * gas_constant)) * p; }
  double sound_speed(double rho, double p) const { return std::sqrt(bulk_modulus(rho, p) / rho); }

  double cold_energy(double /*rho*/) const { return 0.0; }
  double thermal_energy(double rho, double rho_e) const { return rho_e / rho; }
  double temperature(double rho, double rho_e) const { return heat.temperature(rho_e / rho); }
  double energy_from_temperature(double rho, double T) const { return rho * heat.energy(T); }
  double energy_from_pressure(double rho, double p) const {
    return rho * heat.energy(p / (rho * gas_constant));
  }
  double density(double p, double T) const { return p / (gas_constant * T); }
  double density_at_thermal_energy(double p, double thermal) const {
    return density(p, heat.temperature(thermal));
  }

  bool admissible(double rho, double rho_e) const {
    const double e = rho_e / rho;
    return rho > 0.0 && e > 0.0 && e < std::numeric_limits<double>::infinity();
  }
  double gamma(double T) const { return 1.0 + gas_constant / heat.specific_heat(T); }
  double shock_slope() const { return 1.2; }
  double lowest_pressure() const { return 0.0; }
  double highest_density() const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace sluice::eos
