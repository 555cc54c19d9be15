// Model "Unsteady_Burn": the surface of Steady_Burn follows changes of pressure with a delay.
//
// The temperature T_s of the surface and its gradient beta in the solid are remembered. With the
// steady state at the present pressure, index s, and beta_s = (T_ss - T_0) m_s c_p/K_c,
//   d beta/dt = (beta_s - beta)/tau,   d T_s/dt = (T_ss - T_s)/(N_g tau),
//   tau = N_c K_c rho/(c_p m_s^2)
// The reaction in the solid then burns m', the smaller root of
//   Q_c m'^2/2 - K_c beta m' + X = 0,   X = A_c R K_c rho T_s^2 exp(-E_c/(R T_s))/E_c
// which is m_s where nothing changes; what burns is m = m_s (m'/m_s)^B_m. Once T_s has outrun beta
// so far that no root is left, at any length of the step, m' stays at K_c beta/Q_c, where the two
// roots have met.
#pragma once
#include "models/burn/steady_burn.hpp"

namespace sluice::models {

struct UnsteadyBurn : SteadyBurn {
  double rate_power = 1;                  // B_m, without unit
  double solid_delay = 0, gas_delay = 0;  // N_c, N_g, without unit

  // After a step of dt (s), of a solid of this temperature (K) and density (kg/m^3); a surface that
  // has not burned begins with the steady state.
  SurfaceHistory after(double dt, const SurfaceHistory& before, const BurningSurface& steady,
                       double solid_temperature, double density) const;
  // Mass flux m, kg/(m^2 s).
  double flux(const SurfaceHistory& now, double steady_flux, double density) const;
};

TagSpec unsteady_burn_tag();
std::shared_ptr<const BurnLaw> read_unsteady_burn(const DeckNode& parameters,
                                                  const MaterialNames& names);

}  // namespace sluice::models
