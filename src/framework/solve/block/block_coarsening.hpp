// From a grid of nodes to one of twice the spacing: interpolation and Galerkin's product.
//
// Coarse node I lies at fine node 2 I, whatever the basis: P is trilinear, and A_c = P^T A P. With
// linear and GIMP functions the functions of twice the spacing are these sums of the fine ones.
// A. Brandt, Math. Comp. 31 (1977) 333; W. L. Briggs, V. E. Henson, S. F. McCormick, A Multigrid
// Tutorial (2000), chapter 10.
#pragma once
#include "framework/solve/block/block_rows.hpp"

namespace sluice::solve {

// Rows of P: fine node i takes weight[e] of coarse node coarse[e], e from begin[i] on; and those of
// P^T in the same form.
struct Interpolation {
  struct Rows {
    std::vector<std::size_t> begin;
    std::vector<std::int32_t> node;
    std::vector<double> weight;
  };
  Rows to_fine, to_coarse;
  std::vector<IntVec3> coarse;  // indices of the coarse nodes, rising along x, y, z

  // fine += P coarse_values, coarse_values = P^T fine; `width` numbers per node.
  void add_to_fine(const Workers& workers, int width, std::span<const double> coarse_values,
                   std::span<double> fine) const;
  void sum_to_coarse(const Workers& workers, int width, std::span<const double> fine,
                     std::span<double> coarse_values) const;
};

// Of fine nodes with these indices.
Interpolation interpolation_between(std::span<const IntVec3> fine);
// P^T A P.
BlockRows galerkin_product(const BlockRows& fine, const Interpolation& between,
                           const Workers& workers);

}  // namespace sluice::solve
