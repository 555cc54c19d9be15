// One sparse linear system, solved directly and corrected until its residual is small.
//
// The symmetric part is factored, LDL^T with a permutation that keeps it sparse, its diagonal
// raised by 1e-8 of itself, so that modes without stiffness (hourglasses of one particle a cell)
// do no harm; BiCGSTAB with that factor as preconditioner then solves the system as it is.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "framework/solve/block/block_rows.hpp"

namespace sluice::mpm {

// Row after row; columns rise. The pattern is symmetric.
struct SparseRows {
  std::vector<int> begin, column;
  std::vector<double> value;
  int count() const { return static_cast<int>(begin.size()) - 1; }
};

// A matrix of blocks without the unknowns whose number is -1; the numbers of the others rise.
SparseRows sparse_rows(const solve::BlockRows& blocks, const std::vector<int>& number);

class SparseSolver {
 public:
  SparseSolver();
  ~SparseSolver();

  // False: the system is singular, or holds no numbers.
  bool solve(const SparseRows& rows, std::span<const double> right_side, std::vector<double>& x);
  // Of the last system: its symmetric part has a negative eigenvalue beyond round-off.
  bool indefinite() const { return indefinite_; }

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
  bool indefinite_ = false;
};

}  // namespace sluice::mpm
