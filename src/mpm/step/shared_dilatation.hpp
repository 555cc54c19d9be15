// One dilatation for all particles of a material in a cell, against locking: J <- sum V/sum V_0 of
// them, F and L scaled to it. (As F-bar: E. A. de Souza Neto and others, Int. J. Solids Struct. 33
// (1996) 3277, with particles in place of quadrature points.)
#pragma once
#include <vector>

#include "mpm/step/particle_motion.hpp"

namespace sluice::mpm {

class SharedDilatation {
 public:
  // Keeps references.
  SharedDilatation(const MpmScene& solids, const LevelNodes& nodes)
      : solids_(&solids), nodes_(&nodes) {}

  // J' of each particle of a block, which has the particles of its cells all; `chunk`: any of the
  // block, whose buffers hold the nodes around.
  void find(const ParticleMotion& motion, const Chunk& chunk, std::vector<double>& shared) const;
  // F <- (J'/J)^(1/d) F, L <- L + I ln(J'/J)/(d dt) in the d directions that move.
  void take(const Chunk& chunk, const Batch& batch, const std::vector<double>& shared) const;

 private:
  const MpmScene* solids_;
  const LevelNodes* nodes_;
};

}  // namespace sluice::mpm
