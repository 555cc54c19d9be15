// Smoothing by Chebyshev polynomials of D^-1 A, with D the diagonal blocks.
//
// Its products are those of the matrix in single precision: it is a preconditioner.
// It damps errors of eigenvalues in [lmax/8, lmax]; products and no sweeps, so that its bits depend
// on the matrix alone.
// Y. Saad, Iterative Methods for Sparse Linear Systems (2003), algorithm 12.1; M. Adams, M.
// Brezina, J. Hu, R. Tuminaro, J. Comput. Phys. 188 (2003) 593.
#pragma once
#include "framework/solve/block/block_diagonal.hpp"

namespace sluice::solve {

class Chebyshev {
 public:
  enum class Estimate { quick, careful };
  // The matrix must stay. A later one of the same size begins its estimate of lmax where that of
  // the matrix before ended, which takes fewer products; a careful one begins from nothing and
  // takes more. Eigenvalues far beyond the estimate make the polynomial negative there.
  void set_up(const BlockRows& rows, const Workers& workers, Estimate estimate = Estimate::quick);
  double largest_eigenvalue() const { return largest_; }

  // x = p(D^-1 A) b of the degree, from 0; residual = b - A x.
  void smooth_from_zero(std::span<const double> b, std::span<double> x,
                        std::span<double> residual) const;
  // The same from x; the residual is scratch and is not that of the result.
  void smooth(std::span<const double> b, std::span<double> x, std::span<double> scratch) const;

  static constexpr int degree = 2;

 private:
  void estimate_largest(int products);
  void run(std::span<double> x, std::span<double> residual, bool last_residual) const;

  RoundedRows rows_;
  const Workers* workers_ = nullptr;
  BlockDiagonal diagonal_;
  double largest_ = 1;
  std::vector<double> vector_;  // of the largest eigenvalue, about
  mutable std::vector<double> change_, product_;
};

}  // namespace sluice::solve
