// The stiffness of the nodes, K = sum_p G.A.G, as a matrix of blocks.
//
// Particles add to rows in their order: each entry is a sum in a fixed order, whatever the number
// of threads. Of a symmetric matrix the upper half is summed and the lower one copied from it.
#pragma once
#include "mpm/implicit/node_pairs.hpp"
#include "mpm/implicit/particle_stresses.hpp"

namespace sluice::mpm {

class Stiffness {
 public:
  // `pairs` are numbered here and must stay.
  Stiffness(const NodesOfStep::Parts& parts, NodePairs& pairs, const solve::Workers& workers);

  // K of the tangents, N/m. Symmetric: of their symmetric parts.
  void assemble(const ParticleStresses& particles, bool symmetric);
  // Adds c to components d, d of the block of nodes i and j, N/m.
  void add(std::int32_t i, std::int32_t j, double c);
  // Adds 4 M/dt^2 on the diagonal.
  void add_inertia(const NodesOfStep& nodes);
  // Zeros in rows and columns of what is not free, and of unknowns whose diagonal is at most this
  // part of the largest: nodes that a body reaches by almost nothing, or failed particles alone.
  void leave_out(const NodesOfStep& nodes, double least_part);

  const solve::BlockRows& rows() const { return rows_; }
  int width() const { return rows_.width; }
  // Unknown c of a node is its component along axis(c): directions with cells, in order.
  int axis(int c) const { return axes_[static_cast<std::size_t>(c)]; }
  // The sum of the diagonal, N/m.
  double diagonal_sum() const;

 private:
  template <int D>
  void add_particles(const ParticleStresses& particles, bool symmetric, std::size_t first,
                     std::size_t end);
  void copy_upper_half();
  const double* diagonal_block(std::size_t node) const;

  NodesOfStep::Parts parts_;
  const NodePairs* pairs_;
  const solve::Workers* workers_;
  std::array<int, 3> axes_{};
  solve::BlockRows rows_;
};

}  // namespace sluice::mpm
