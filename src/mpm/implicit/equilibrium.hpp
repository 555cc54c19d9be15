// Newton's method for the displacements of nodes in an implicit step.
//
//   residual r = f_ext + f_2 - sum T G - M a_1(u),   (sum G.A.G + K_2 + 4 M/dt^2) du = r
//
// on what is free; f_2, K_2: second_differences.hpp. Displacements that are given enter with the
// first iteration, as part of its linear system. Small systems are solved directly, with new
// tangents in every iteration. Large ones are solved by conjugate gradients to a part of the
// residual (inexact Newton), and tangents, matrix and preconditioner serve while each iteration
// reduces the residual to .3 of it. It has converged when |du|^2 is less than a part of its largest
// and |du.r| than a part of the first and, with an inexact solution, the residual than 1e-6 of the
// first; or when the residual is round-off of the forces in it. A solution that failed is not
// counted. An iteration that turns a particle inside out is halved. Where the matrix is not
// positive definite (CG meets p.A p <= 0), negative eigenvalues of the particles' tangents are left
// out for one iteration. Without inertia a step that fails is repeated in increments: loads and
// given displacements are those of the last equilibrium and a part of what has been added since.
// J. E. Guilkey, J. A. Weiss, Int. J. Numer. Meth. Engng 57 (2003) 1323; R. S. Dembo, S. C.
// Eisenstat, T. Steihaug, SIAM J. Numer. Anal. 19 (1982) 400.
#pragma once
#include <memory>
#include <string>

#include "mpm/implicit/node_solver.hpp"
#include "mpm/implicit/second_differences.hpp"

namespace sluice::mpm {

// How it went.
struct NewtonReport {
  bool converged = false;
  int iterations = 0;             // with new tangents
  int solves = 0;                 // of linear systems; more than iterations where these serve on
  int gradient_iterations = 0;    // of conjugate gradients or BiCGSTAB, in all
  int increments = 0;             // of the loads; 0: they were applied at once
  int projected = 0;              // iterations without negative eigenvalues of tangents
  int unknowns = 0;               // free components of displacements
  bool directly = false;          // linear systems were solved directly
  std::string reason;             // why it did not
  std::vector<double> residuals;  // the largest force on a free node that is not balanced, N
};

class Equilibrium {
 public:
  Equilibrium(const NodesOfStep::Parts& parts, const ThreadTeam& team, double time);
  ~Equilibrium();

  // Collective only in that every rank finds the same displacements by itself.
  NewtonReport find(NodesOfStep& nodes, SparseSolver& direct);

  // After find(): the force of the stresses on each node, as last evaluated, N.
  const std::vector<Vec3>& inner_forces() const { return inner_; }
  // The same of second differences.
  const std::vector<Vec3>& smoothing_forces() const { return smoothing_; }
  const ParticleStresses& particles() const { return particles_; }

 private:
  struct Progress;
  void prepare(const NodesOfStep& nodes, SparseSolver& direct);
  void choose_start(NodesOfStep& nodes);
  void iterate(NodesOfStep& nodes, double share, NewtonReport& report);
  void apply_in_increments(NodesOfStep& nodes, NewtonReport& report);

  double find_forces(const NodesOfStep& nodes);
  void add_particle_forces(std::size_t kind, std::size_t first, std::size_t end);
  double find_residual(const NodesOfStep& nodes, double share);
  bool find_gap(const NodesOfStep& nodes, double share);
  bool has_converged(const Progress& now) const;
  bool renew(const NodesOfStep& nodes, bool positive, Progress& now, NewtonReport& report);
  void find_given_forces(const NodesOfStep& nodes);
  double add_given_forces();
  bool solve(const NodesOfStep& nodes, Progress& now, NewtonReport& report);
  bool step(NodesOfStep& nodes, Progress& now, NewtonReport& report);
  double move(NodesOfStep& nodes, double share, bool gives) const;

  NodesOfStep::Parts parts_;
  const ThreadTeam* team_;
  solve::Workers workers_;
  ParticleStresses particles_;
  std::unique_ptr<NodePairs> pairs_;
  std::unique_ptr<Stiffness> stiffness_;
  std::unique_ptr<NodeSolver> solver_;
  SecondDifferences second_;
  // By unknown of the matrix: right-hand side, its part from given displacements, the change of u.
  std::vector<double> right_, given_, change_;
  std::vector<double> size_;                   // by node: the sum of sizes of forces, N
  std::vector<Vec3> inner_, smoothing_, gap_;  // gap: given displacement - u of what is given
  bool in_increments_ = false;
  std::vector<Vec3> held_;  // residual of the last equilibrium, of which increments hold a part
};

}  // namespace sluice::mpm
