// Grid to particles: velocities, their change and their gradient at the places of particles.
//
//   u = sum S v*,  dv = sum S (v* - v),  L = sum v* (x) grad S
//   C = [sum S v* (x) (x_i - x_p)] / (second moment of S): APIC alone
// u, dv and v* in m/s, L in 1/s, moments in m^2/s; tensors row after row.
#pragma once
#include "mpm/shape/weights.hpp"
#include "mpm/transfer/to_grid.hpp"

namespace sluice::mpm {

// v* at corners that particles carry.
using VelocitiesAtCorners = double[max_corners][3][chunk_size];

// Results for the particles of a chunk.
struct GridAtParticles {
  alignas(64) double u[3][chunk_size];
  alignas(64) double dv[3][chunk_size];
  alignas(64) double fourth[chunk_size];  // sum S of the fourth lane of nodes: read_velocities()
  alignas(64) double L[9][chunk_size];
  alignas(64) double moment[9][chunk_size];  // sum S v* (x) (x_i - x_p), where it is asked for
  alignas(64) VelocitiesAtCorners corner;
};

// Particles at, ..., at + n - 1 (n <= chunk_size) of one block; node lanes v*, - | v* - v, -.
void read_window(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
                 const ParticleShape& shape, int at, int n, bool moments, const Window& window,
                 GridAtParticles& to);

// u and dv alone; for transfers that find gradients of other velocities.
void read_motion(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
                 const ParticleShape& shape, int at, int n, const Window& window,
                 GridAtParticles& to);

// Without dv, which is not touched, and with what stands beside the velocities in lane 3 of nodes,
// of any unit.
void read_velocities(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
                     const ParticleShape& shape, int at, int n, const Window& window,
                     GridAtParticles& to);

// No gradients along directions that are not active.
void clear_inactive(const TransferGrid& grid, int n, bool moments, GridAtParticles& to);

}  // namespace sluice::mpm
