// What follows from an equation of state that is linear in energy: p = F(rho) + G(rho) rho e.
//
// `Curves` gives the functions of density alone; this form adds all that a flow needs.
//   offset F (Pa), offset_slope F' (m^2/s^2), gruneisen G, exponent h = d ln(rho G) / d ln rho,
//   cold_energy e_c (J/kg): energy at 0 K, so that T = (e - e_c) / cv
// From these, with e the internal energy per mass and s the entropy:
//   dp/drho|e = F' + h G e,   dp/de|rho = rho G,   c^2 = dp/drho|s = F' + h G e + G p / rho
//   K = rho c^2 = rho F' + h (p - F) + G p
// Where e_c' = (F + G rho e_c) / rho^2 (pressure on the cold curve), temperature and energy obey
// (de/dv)_T = T (dp/dT)_v - p and one entropy exists.
// `Curves` also gives the slope of the shock speed (shock_slope, no unit), the lowest pressure of
// the law (Pa), the highest density (kg/m^3) and where a search for a density begins; in
// closed_density p is in Pa and `thermal` the energy above the cold curve, J/kg.
// References: Menikoff and Plohr, Rev. Mod. Phys. 61 (1989) 75, sections II and III.
#pragma once
#include <cmath>
#include <limits>

#include "eos/density_search.hpp"
#include "eos/heat_ratio.hpp"

namespace sluice::eos {

template <class Curves>
struct GruneisenForm : Curves {
  // --- pressure, from density (kg/m^3) and internal energy per volume (J/m^3) ---
  double pressure(double rho, double rho_e) const {
    return this->offset(rho) + this->gruneisen(rho) * rho_e;
  }
  double dp_drho(double rho, double rho_e) const {  // at constant energy per mass, m^2/s^2
    return this->offset_slope(rho) + this->exponent(rho) * this->gruneisen(rho) * rho_e / rho;
  }
  double dp_de(double rho, double /*rho_e*/) const {  // at constant density, kg/m^3
    return rho * this->gruneisen(rho);
  }
  double sound_speed_squared(double rho, double rho_e) const {
    return bulk_modulus(rho, pressure(rho, rho_e)) / rho;
  }
  // rho c^2 (Pa) from density and pressure, which is how the cells of a mixture know it.
  double bulk_modulus(double rho, double p) const {
    return rho * this->offset_slope(rho) + this->exponent(rho) * (p - this->offset(rho)) +
           this->gruneisen(rho) * p;
  }
  double sound_speed(double rho, double p) const { return std::sqrt(bulk_modulus(rho, p) / rho); }

  // --- temperature (K), and energy per volume (J/m^3) ---
  double thermal_energy(double rho, double rho_e) const {  // J/kg above the cold curve
    return rho_e / rho - this->cold_energy(rho);
  }
  double temperature(double rho, double rho_e) const {
    return thermal_energy(rho, rho_e) / this->specific_heat;
  }
  double energy_from_temperature(double rho, double T) const {
    return rho * (this->cold_energy(rho) + this->specific_heat * T);
  }
  // At a state of this temperature and specific heat (J/(kg K)).
  double heat_capacity_ratio(double rho, double rho_e, double T, double cv) const {
    if constexpr (requires(const Curves& c) { c.constant_heat_capacity_ratio(); })
      return this->constant_heat_capacity_ratio();
    else
      return ratio_of_heats(*this, rho, rho_e, T, cv);
  }
  // Laws whose pressure knows density alone have no such inverse.
  double energy_from_pressure(double rho, double p) const
    requires(Curves::depends_on_energy)
  {
    return (p - this->offset(rho)) / this->gruneisen(rho);
  }

  // --- density at pressure and temperature; not a number where the law has no such state ---
  double density(double p, double T) const {
    return density_at_thermal_energy(p, this->specific_heat * T);
  }
  double density_at_thermal_energy(double p, double thermal) const {
    if constexpr (requires(const Curves& c) { c.closed_density(p, thermal); })
      return this->closed_density(p, thermal);
    else
      return search_density(p, this->start_density(), this->highest_density(),
                            [&](double rho) { return isotherm(rho, thermal); });
  }

  bool admissible(double rho, double rho_e) const {  // without branches: rows of it vectorise
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double p = pressure(rho, rho_e), modulus = bulk_modulus(rho, p);
    const double thermal = thermal_energy(rho, rho_e);
    const int state = int(rho > 0.0) & int(rho < this->highest_density());
    const int heat = int(thermal > 0.0) & int(thermal < infinity);
    const int force =
        int(p > this->lowest_pressure()) & int(modulus > 0.0) & int(modulus < infinity);
    return (state & heat & force) != 0;
  }

 private:
  ValueAndSlope isotherm(double rho, double thermal) const {
    const double cold = this->cold_energy(rho), G = this->gruneisen(rho);
    const double rho_e = rho * (cold + thermal);
    const double cold_pressure = this->offset(rho) + G * rho * cold;
    return {pressure(rho, rho_e), dp_drho(rho, rho_e) + G * cold_pressure / rho};
  }
};

}  // namespace sluice::eos
