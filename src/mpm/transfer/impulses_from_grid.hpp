// Grid to particles: what impulses on nodes change of the velocity and of the spin of particles.
//
//   dv = sum S (v* - v),  I dw = sum S r x (v* - v),  I_k = sum S (|r|^2 - r_k^2),  r = x_i - x_p
//
// The adjoint of P = sum m S (v + w x r): the work of an impulse on nodes is what particles get.
#pragma once
#include "mpm/transfer/from_grid.hpp"

namespace sluice::mpm {

// Results for the particles of a chunk.
struct ImpulsesAtParticles {
  alignas(64) double u[3][chunk_size];        // sum S v*, m/s, where it is asked for
  alignas(64) double dv[3][chunk_size];       // m/s
  alignas(64) double turn[3][chunk_size];     // sum S r x (v* - v), m^2/s
  alignas(64) double inertia[3][chunk_size];  // I, m^2; of axes that two active directions span
  alignas(64) VelocitiesAtCorners corner;     // with u
};

// Particles at, ..., at + n - 1 (n <= chunk_size) of one block; node lanes v*, - | v* - v, -.
void interpolate_impulses(Basis basis, const TransferGrid& grid,
                          const std::array<const double*, 3>& x, const ParticleShape& shape, int at,
                          int n, bool velocities, const Window& window, ImpulsesAtParticles& to);

}  // namespace sluice::mpm
