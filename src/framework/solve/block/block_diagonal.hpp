// Inverses of the diagonal blocks of a matrix: the preconditioner of block Jacobi, and the scale of
// a smoother.
#pragma once
#include "framework/solve/block/block_rows.hpp"

namespace sluice::solve {

class BlockDiagonal {
 public:
  // Of the symmetric part of each diagonal block. Directions whose eigenvalue is below 1e-10 of the
  // block's largest count as without stiffness: their inverse is 0.
  void invert(const BlockRows& rows);
  // y = D^-1 x.
  void apply(const Workers& workers, std::span<const double> x, std::span<double> y) const;
  // Makes x 0 where D^-1 has a row of zeros: of unknowns without stiffness.
  void clear_unmoved(std::span<double> x) const;

 private:
  int width_ = 3;
  std::vector<double> inverse_;
};

}  // namespace sluice::solve
