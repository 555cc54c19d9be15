// Transfers of particles with corners (CPDI, CPTI), corner by corner: exact sums do not care that
// corners share nodes. Places in m.
#pragma once
#include "mpm/transfer/from_grid.hpp"
#include "mpm/transfer/impulses_from_grid.hpp"
#include "mpm/transfer/to_grid.hpp"
#include "mpm/transfer/values_to_grid.hpp"

namespace sluice::mpm {

// What goes to particles: as read_window() without moments, read_motion(), read_velocities().
enum class Reading { all, motion, velocities };

// As add_to_window, add_values_to_window, those three, and interpolate_impulses. The window must
// reach the corners' nodes.
void add_corners(Basis basis, const TransferGrid& grid, const ParticlesToGrid& p, int begin,
                 int end, const SumUnits& units, Window& window);
void add_values_of_corners(Basis basis, const TransferGrid& grid,
                           const std::array<const double*, 3>& x, const ParticleShape& shape,
                           std::span<const ValueLane> lanes_of, int begin, int end, Window& window);
void read_corners(Basis basis, const TransferGrid& grid, const std::array<const double*, 3>& x,
                  const ParticleShape& shape, int at, int n, Reading reading, const Window& window,
                  GridAtParticles& to);
void read_impulses_of_corners(Basis basis, const TransferGrid& grid,
                              const std::array<const double*, 3>& x, const ParticleShape& shape,
                              int at, int n, bool velocities, const Window& window,
                              ImpulsesAtParticles& to);

}  // namespace sluice::mpm
