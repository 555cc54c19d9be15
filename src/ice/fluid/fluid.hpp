// The thermodynamics of one material of ICE: its equation of state and specific heat.
//
// Functions of one state are for set-up, boundaries and outputs; rows of cells go through
// closure_rows.hpp, which chooses the law once a row.
#pragma once
#include <optional>

#include "eos/eos.hpp"

namespace sluice::ice {

struct Fluid {
  eos::EquationOfState law;
  std::optional<eos::SpecificHeat> heat;  // in place of the law's own constant one
  double gamma = 1.4;                     // cp/cv as the deck says; an ideal gas uses it
  double specific_heat = 1.0;             // cv as the deck says, J/(kg K)

  // The fast path of kernels: p = (gamma - 1) rho e. Nothing for other laws.
  const eos::IdealGas* gamma_law() const { return eos::as_gamma_law(law); }
  // Can a pressure be given beside a density: does the pressure depend on energy.
  bool depends_on_energy() const;

  // rho: kg/m^3, rho_e: internal energy per volume J/m^3, p: Pa, T: K.
  double pressure(double rho, double rho_e) const;
  double temperature(double rho, double rho_e) const;
  double bulk_modulus(double rho, double p) const;             // rho c^2, Pa
  double modulus_of_state(double rho, double rho_e) const;     // the same
  double sound_speed(double rho, double p) const;              // m/s
  double energy_from_temperature(double rho, double T) const;  // per volume
  // The energy per volume at which density and pressure are these; where there are two, the one on
  // the side of temperature T. Laws whose pressure knows the density alone take that of T.
  double energy_from_pressure(double rho, double p, double T) const;
  // Density at pressure and temperature; not a number where the law has no such state.
  double density(double p, double T) const;
  double heat_capacity(double rho, double rho_e) const;        // cv, J/(kg K)
  double heat_capacity_ratio(double rho, double rho_e) const;  // cp/cv of the state
  // Where all states have one.
  std::optional<double> constant_heat_capacity_ratio() const;
  double shock_slope() const;      // s of the shock speed c + s u, without unit
  double lowest_pressure() const;  // Pa; -pinf of a stiffened gas
  bool admissible(double rho, double rho_e) const;
};

// An ideal gas with constant specific heats: cp/cv and cv (J/(kg K)).
Fluid ideal_gas(double gamma, double specific_heat);

}  // namespace sluice::ice
