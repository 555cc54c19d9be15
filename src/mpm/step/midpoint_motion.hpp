// The midpoint transfer: new velocities and spins of particles at the places of the middle of a
// step, from which these go to the nodes once more (SolidLevels::map_back); mpm_transfers.md.
//
//   v+ = v + sum S dv_i,   w+ = w + I^-1 sum S r x dv_i,   x' = x + dt v+/2
//   vh_i = sum m S' (v+ + w+ x (x_i - x'))/sum m S',   L = sum vh_i (x) grad S'
//   F+ = (I - dt L/2)^-1 (I + dt L/2) F,   x+ = x + dt sum S' vh_i
//
// Forces on nodes and velocities of nodes are adjoint in both maps, so that stress neither loses
// nor gains energy by them, and what turns is mapped as it turns.
#pragma once
#include "mpm/step/particle_motion.hpp"

namespace sluice::mpm {

class OutsideForces;

// A spin about the axis k is one of two active directions.
inline bool turns(const Level& level, int k) {
  return level.active[static_cast<std::size_t>((k + 1) % 3)] &&
         level.active[static_cast<std::size_t>((k + 2) % 3)];
}

// About the axis k, of the velocities that were read: half their curl.
inline double spin_of(const GridAtParticles& read, int k, int q) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  return 0.5 * (read.L[3 * j + i][q] - read.L[3 * i + j][q]);
}

// L <- L (I - dt L/2)^-1 of n particles: with it F+ = (I + dt L) F is F+ = (I - dt L/2)^-1
// (I + dt L/2) F of what was read, which turns without strain (T. J. R. Hughes, J. Winget, IJNME 15
// (1980) 1862).
void to_end_of_step(double dt, int n, GridAtParticles& read);

class MidpointMotion final : public ParticleMotion {
 public:
  // Keeps references. `outside`: loads that ask for velocities where they act.
  MidpointMotion(const MpmScene& solids, const LevelNodes& nodes, const OutsideForces& outside,
                 const MappedBack& mapped)
      : solids_(&solids), nodes_(&nodes), outside_(&outside), mapped_(&mapped) {}

  void load_first(const BlockWork& work, const Body& body, ChunkBuffers& buffers) const override;
  // Velocities and spins after the kick, places of the middle of the step.
  void first(const Chunk& chunk) const override;
  void end_first(BlockWork& work, const Chunk& block) const override;
  void load(const BlockWork& work, const Body& body, ChunkBuffers& buffers) const override;
  void read_gradient(const Chunk& chunk) const override;
  // What was read at the middle of the step makes its end.
  void last(const Chunk& chunk) const override;

  // Of the start of a run: particles as they are, with their spins or without, where new ones will
  // stand (bounds of them in the report); spins from the velocities that they mapped.
  void hold_start(BlockWork& work, const Chunk& block, bool spins) const;
  void take_spins(const Chunk& chunk, ParticleSet& to) const;

 private:
  void kick_along(const Chunk& chunk, int d, double& way) const;
  void stay(const Chunk& chunk) const;
  double halve_corners(const Chunk& chunk) const;
  void add_bounds(const Chunk& chunk) const;
  void read(const Chunk& chunk) const;

  const MpmScene* solids_;
  const LevelNodes* nodes_;
  const OutsideForces* outside_;
  const MappedBack* mapped_;
};

}  // namespace sluice::mpm
