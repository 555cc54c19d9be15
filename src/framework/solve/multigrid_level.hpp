// One grid of the multigrid cycle: its equations and what is done with them, slice by slice.
//
// The cycle only preconditions, so that 32-bit numbers serve most systems: half the memory is twice
// the speed. Loops over a row have unit stride; cells of the other colour are computed, not taken.
#pragma once
#include <vector>

#include "framework/solve/dense_shape.hpp"
#include "framework/solve/raw_memory.hpp"
#include "framework/solve/slabs.hpp"

namespace sluice::solve {

// Units as in cell_matrix.hpp, vectors by place of the window (DenseShape).
//
// A grid's equations in full precision while the hierarchy is made: the couplings (positive) with
// the cell below in each direction, and what a row sums to.
struct DenseEquations {
  DenseEquations(const DenseShape& s, const Slabs& slabs_of_ranks);  // zeros

  DenseShape shape;
  Slabs slabs;
  std::array<RawVector<double>, 3> low;
  RawVector<double> sum;

  double diagonal(std::ptrdiff_t c) const;
  // Collective, all below: the largest diagonal.
  double largest_diagonal() const;
  // The mean coupling over the cells, 0 in a direction of one cell that is its own neighbour.
  std::array<double, 3> mean_couplings() const;
  // Cells in groups of ratio[d]: sums of rows, sums of the faces on a coarse face over the ratio
  // (a coarse face is that much longer).
  DenseEquations coarsened(std::array<int, 3> ratio) const;

 private:
  void sum_into(DenseEquations& coarse, std::array<int, 3> ratio) const;
};

// Real: float or double.
template <class Real>
class MultigridLevel {
 public:
  // Rows are multiplied by `scale`. Lines along direction 1 are solved exactly if `lines`.
  MultigridLevel(const DenseEquations& equations, double scale, bool lines);

  const DenseShape& shape() const { return shape_; }
  const Slabs& slabs() const { return slabs_; }
  bool lines() const { return !pivot_.empty(); }
  Real* solution() { return x_.data(); }
  Real* right_side() { return b_.data(); }

  // The cells of a colour, from the right-hand side alone; the others become 0.
  void first_sweep(int k);
  void sweep(int k, int colour);
  // The residual of a slice, summed into the right-hand side of the coarser grid.
  void restrict_residual(int k, MultigridLevel& coarse, std::array<int, 3> ratio);
  void add_correction(int k, const MultigridLevel& coarse, std::array<int, 3> ratio);
  void wrap_round(int k) { wrap_slice(shape_, x_.data(), k); }
  // Collective, after a stage over all own slices: the solution in the slices beside them.
  void wrap_last() { slabs_.exchange(shape_, x_.data()); }
  // A single cell, or nothing to correct where its row sums to 0.
  void solve_one_cell();
  std::size_t bytes() const;

 private:
  template <bool Deep>
  void sweep_points(int k, int colour);
  template <bool Deep>
  void sweep_lines(int k, int colour);
  template <bool Deep>
  void residual_row(int j, int k);

  DenseShape shape_;
  Slabs slabs_;
  RawVector<Real> low_[3], diagonal_, pivot_, x_, b_;
  std::vector<Real> values_;  // of one row
  double sum_ = 0;            // of all rows
};

}  // namespace sluice::solve
