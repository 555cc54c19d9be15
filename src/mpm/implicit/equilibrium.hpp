// Newton's method for the displacements of nodes in an implicit step.
//
//   residual r = f_ext - sum T G - M a_1(u),   (sum G.A.G + 4 M/dt^2) du = r on what is free
//
// Displacements that are given enter with the first iteration, as part of its linear system. It has
// converged when |du|^2 is less than a part of its largest and |du.r| than a part of the first, or
// when the residual is round-off of the forces in it. An iteration that turns a particle inside out
// is halved.
// J. E. Guilkey, J. A. Weiss, Int. J. Numer. Meth. Engng 57 (2003) 1323.
#pragma once
#include <string>

#include "framework/task/thread_team.hpp"
#include "mpm/implicit/nodes_of_step.hpp"
#include "mpm/implicit/response.hpp"
#include "mpm/implicit/sparse_solver.hpp"

namespace sluice::mpm {

// How it went.
struct NewtonReport {
  bool converged = false;
  int iterations = 0;
  std::string reason;             // why it did not
  std::vector<double> residuals;  // the largest force on a free node that is not balanced, N
};

class Equilibrium {
 public:
  Equilibrium(const NodesOfStep::Parts& parts, const ThreadTeam& team, double time);

  NewtonReport find(NodesOfStep& nodes, SparseSolver& solver);

  // Phi of particles at, ..., at + n - 1 of a kind.
  void deformation(const NodesOfStep& nodes, std::size_t kind, const Response::Span& span,
                   const Response& response, ChunkOfMatrices& phi) const;
  // After find(): the force of the stresses on each node, as last evaluated.
  const std::vector<Vec3>& inner_forces() const { return inner_; }
  // Likewise T of the particles of a kind, nine numbers each.
  const std::vector<double>& stresses(std::size_t kind) const { return T_[kind]; }

 private:
  struct Chunk {
    std::size_t kind, at;
    int count;
  };
  bool evaluate(const NodesOfStep& nodes, std::string& reason);
  void number_unknowns(const NodesOfStep& nodes);
  void find_pattern();
  double assemble(const NodesOfStep& nodes, bool gives);
  double assemble_row(const NodesOfStep& nodes, std::size_t node, bool gives,
                      std::vector<int>& place, std::vector<double>& blocks);
  double move(NodesOfStep& nodes, const std::vector<double>& change, double share,
              bool gives) const;

  NodesOfStep::Parts parts_;
  const ThreadTeam* team_;
  double time_;
  std::vector<Chunk> chunks_;
  std::vector<std::vector<double>> T_, A_;       // by kind: 9 and 81 numbers a particle
  std::vector<std::vector<std::int32_t>> near_;  // of each node: nodes that share particles with it
  std::vector<std::array<int, 3>> unknown_;      // -1: given
  int unknowns_ = 0;
  SparseRows rows_;
  std::vector<double> right_;
  std::vector<Vec3> inner_, gap_;  // gap: given displacement - u of what is given
};

}  // namespace sluice::mpm
