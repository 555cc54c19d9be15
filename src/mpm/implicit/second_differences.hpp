// A weak stiffness against second differences of displacements along lines of the grid.
//
//   f = -g E V_c/h^2 c c^T u,   c = (1, -2, 1), for every three nodes in a row of a body, each
//   component by itself; E = rho c^2 at the middle node (no more than 3.5 times the shear modulus),
//   V_c the volume of a cell, h its size there
//
// It is 0 for displacements that are linear in space: rigid motion, uniform strain. It gives
// stiffness to nodes that a body only just reaches, to modes without strain at particles
// (hourglasses of one particle per cell), and to nodes whose only stiffness is that of compressive
// stress. Without inertia each of them makes the stiffness singular or indefinite. u is the
// displacement of the step, so that nothing of it is left once a body rests. g = 1e-4, and 1e-3
// where particles are fewer than 2^d per cell.
// E. Burman, C. R. Math. 348 (2010) 1217, ghost penalty; W. M. Coombs, Int. J. Numer. Meth. Engng
// 124 (2023) 4841, for material points.
#pragma once
#include "mpm/implicit/stiffness.hpp"

namespace sluice::mpm {

class SecondDifferences {
 public:
  SecondDifferences() = default;  // none
  // Of nodes that act on each other; adds these pairs. `particles` are evaluated.
  SecondDifferences(const NodesOfStep::Parts& parts, const NodesOfStep& nodes,
                    const ParticleStresses& particles, NodePairs& pairs);
  // Whether a step of this length needs them: without inertia, or where waves cross more than ten
  // cells.
  static bool needed(const NodesOfStep::Parts& parts, const NodesOfStep& nodes,
                     const ParticleStresses& particles);

  bool empty() const { return triples_.empty(); }
  // Adds to each node's force, N.
  void add_forces(const NodesOfStep& nodes, std::vector<Vec3>& forces) const;
  void add_stiffness(Stiffness& stiffness) const;

 private:
  void find_triples(const ReachedNodes& reached, const NodesOfStep& nodes, const NodePairs& pairs);
  void find_coefficients(const NodesOfStep::Parts& parts, const ParticleStresses& particles);

  std::vector<NodeTriple> triples_;
  std::vector<std::int8_t> axis_;
  std::vector<double> coefficient_;  // N/m
};

}  // namespace sluice::mpm
