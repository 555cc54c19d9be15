// Equations of state over rows of cells: the law is chosen once a row, loops are plain.
//
// Rows must not overlap, except where said. Cells without the material may hold anything: what is
// computed there is not used (no trap, no exception).
#pragma once
#include "ice/fluid/fluid.hpp"

namespace sluice::ice {

// p (Pa) and modulus K = rho c^2 (Pa) from density and internal energy per volume.
void pressure_and_modulus_row(const Fluid& fluid, int n, const double* rho, const double* rho_e,
                              double* p, double* K);
void pressure_row(const Fluid& fluid, int n, const double* rho, const double* rho_e, double* p);
// K (Pa) from density and pressure.
void modulus_row(const Fluid& fluid, int n, const double* rho, const double* p, double* K);
// c (m/s) from density and pressure.
void sound_speed_row(const Fluid& fluid, int n, const double* rho, const double* p, double* c);
// Internal energy per volume from density and pressure, of laws whose pressure depends on it.
void energy_from_pressure_row(const Fluid& fluid, int n, const double* rho, const double* p,
                              double* rho_e);
// How far the energy is from where the law ends, in units of energy per volume:
// (p + pi)/G with G = dp/d(rho e) at constant density and -pi the lowest pressure of the law. The
// energy itself for an ideal gas; its heat where the pressure does not always rise with the energy.
void energy_scale_row(const Fluid& fluid, int n, const double* rho, const double* rho_e,
                      double* scale);
// T (K), and the heat capacity at constant volume cv (J/(kg K)).
void temperature_row(const Fluid& fluid, int n, const double* rho, const double* rho_e, double* T);
void heat_capacity_row(const Fluid& fluid, int n, const double* rho, const double* rho_e,
                       double* cv);
// cp/cv of each state.
void heat_capacity_ratio_row(const Fluid& fluid, int n, const double* rho, const double* rho_e,
                             double* ratio);
// 1 where density and energy are a state of the law, 0 elsewhere.
void admissible_row(const Fluid& fluid, int n, const double* rho, const double* rho_e,
                    double* admissible);

}  // namespace sluice::ice
