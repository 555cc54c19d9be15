// Linear systems of the unknowns of nodes: directly where they are small, else by conjugate
// gradients.
#pragma once
#include <cstdint>

#include "framework/solve/block/block_solver.hpp"
#include "mpm/implicit/sparse_solver.hpp"

namespace sluice::mpm {

class NodeSolver {
 public:
  struct System {
    const solve::BlockRows* rows;    // must stay; rows and columns of what is not free are zeros
    std::vector<std::uint8_t> free;  // by unknown
    int dimensions = 3;              // directions with cells
    bool direct = false;             // directly, whatever the size
    bool inexact = false;            // errors of 6e-8 of the matrix do no harm
  };
  // `direct` keeps the order of its factors from system to system.
  NodeSolver(System system, const solve::Workers& workers, SparseSolver& direct);

  bool solves_directly() const { return system_.direct; }
  int unknowns() const { return unknowns_; }
  // Of a residual, after set_up(): sqrt(r . D^-1 r) with the diagonal blocks D where conjugate
  // gradients solve, so that nodes of little mass count; else sqrt(r . r).
  double norm(const std::vector<double>& r) const;
  // Whether the symmetric part of tangents serves whose asymmetry is this, |A - A^T|/|A|.
  bool takes_symmetric(double asymmetry) const;

  // For the matrix that the rows hold now. `share_of_storage`: of the sum of the diagonal, what
  // inertia or heat capacity give to it.
  void set_up(double asymmetry, double share_of_storage);

  struct Solution {
    bool solved = false;              // to the tolerance
    bool helps = false;               // the residual is less than half of the right-hand side
    bool negative_curvature = false;  // the matrix is not positive definite
    int iterations = 0;
    double residual = 0;  // over the right-hand side
  };
  // From 0 on; x is 0 for unknowns that are not free. A direct solution is to
  // 1e-12 if it can be, at least to 1e-5.
  Solution solve(const std::vector<double>& b, std::vector<double>& x, double tolerance);

 private:
  Solution solve_directly(const std::vector<double>& b, std::vector<double>& x);

  System system_;
  SparseSolver* direct_;
  std::vector<int> number_;  // of each unknown among the free ones; -1: not free
  int unknowns_ = 0;
  solve::BlockSolver blocks_;
};

}  // namespace sluice::mpm
