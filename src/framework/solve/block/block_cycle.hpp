// A multigrid V-cycle for matrices of blocks, on grids of 2, 4, 8, ... times the spacing.
//
// Galerkin's matrices (block_coarsening.hpp), smoothing by Chebyshev polynomials before and after,
// a direct solve on the coarsest grid. It is symmetric, as conjugate gradients need it.
// Y. Zhu, E. Sifakis, J. Teran, A. Brandt, ACM Trans. Graph. 29 (2010) 16, for elastic solids on
// grids.
#pragma once
#include <memory>

#include "framework/solve/block/block_coarsening.hpp"
#include "framework/solve/block/chebyshev.hpp"

namespace sluice::solve {

class BlockCycle {
 public:
  explicit BlockCycle(const Workers& workers);
  ~BlockCycle();

  // Of a symmetric matrix, which must stay. False: the matrix of the coarsest grid cannot be
  // factored. A later matrix with the same nodes uses the grids of the one before.
  bool set_up(const BlockRows& rows, Chebyshev::Estimate estimate = Chebyshev::Estimate::quick);
  // x = C r, about A^-1 r; rows.unknowns() numbers each.
  void apply(std::span<const double> r, std::span<double> x);

  std::size_t grids() const { return grids_.size(); }

 private:
  struct Grid;
  struct Factor;
  bool factor_coarsest();
  void cycle(std::size_t n);

  const Workers* workers_;
  std::vector<std::unique_ptr<Grid>> grids_;  // the finest first
  std::unique_ptr<Factor> factor_;
};

}  // namespace sluice::solve
