// One sparse linear system, solved directly and corrected until its residual is small.
//
// The symmetric part is factored, LDL^T with a permutation that keeps it sparse, its diagonal
// raised by 1e-8 of itself, so that modes without stiffness (hourglasses of one particle a cell)
// do no harm; BiCGSTAB with that factor as preconditioner then solves the system as it is.
#pragma once
#include <memory>
#include <span>
#include <vector>

namespace sluice::mpm {

// Row after row; columns rise. The pattern is symmetric.
struct SparseRows {
  std::vector<int> begin, column;
  std::vector<double> value;
  int count() const { return static_cast<int>(begin.size()) - 1; }
};

class SparseSolver {
 public:
  SparseSolver();
  ~SparseSolver();

  // False: the system is singular, or holds no numbers.
  bool solve(const SparseRows& rows, std::span<const double> right_side, std::vector<double>& x);

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace sluice::mpm
