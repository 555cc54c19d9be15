// Artificial viscosity: a pressure q in particles that are compressed, which spreads shocks over a
// few cells. It acts in the forces of the next step.
//
//   tr D < 0:  q = rho (A_1 c_b |tr D| h + A_2 (tr D h)^2),  c_b^2 = K/rho,  h the mean cell width
//
// Its work -q V tr D dt joins the energy of the particle; in materials with plastic flow it is
// heat. Time steps count with it: the speed of sound becomes Q + sqrt(Q^2 + c^2) where
// q = rho Q |tr D| h.
#pragma once
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {

// Particles at, ..., at + n - 1 after their law: q, energy, dT/dt in `heating`, and the speed that
// limits the next time step, m/s.
void add_viscosity(const MpmScene& solids, const Body& body, const BlockWork& work, std::size_t at,
                   int n, double dt, Vec3 spacing, const GridAtParticles& read, double* heating,
                   double* wave_speed);

}  // namespace sluice::mpm
