// A V-cycle of semi-coarsened grids: one symmetric, positive approximation of the inverse.
//
// Grids halve the directions of strong coupling only, down to one cell; coarse equations are sums
// over faces. Smoothing by red-black Gauss-Seidel (before: red, black; after: black, red), or by
// lines along the direction of strongest coupling where it is much stronger than the others.
//
// J. E. Dendy, Black box multigrid, J. Comput. Phys. 48 (1982) 366-386 (semi-coarsening and lines);
// A. Brandt, Multi-level adaptive solutions, Math. Comp. 31 (1977) 333-390, section 3.
#pragma once
#include <vector>

#include "framework/solve/multigrid_level.hpp"

namespace sluice::solve {

struct MultigridSettings {
  int sweeps = 2;               // of both colours, before and after a coarse correction
  double coarsen_share = 0.25;  // of the strongest mean coupling: directions above are halved
  double line_ratio = 8;        // strongest to next mean coupling from which lines are solved
};

// Are lines solved on this grid. They want Real = double: what a line sums to is small beside its
// couplings.
bool needs_lines(const DenseEquations& equations, const MultigridSettings& settings);

template <class Real>
class Multigrid {
 public:
  Multigrid(DenseEquations finest, const MultigridSettings& settings);

  // The right-hand side to fill before a cycle, and the correction that it leaves: by place of the
  // window (DenseShape), units as in cell_matrix.hpp.
  Real* right_side() { return levels_.front().grid.right_side(); }
  const Real* correction() { return levels_.front().grid.solution(); }
  double scale() const { return scale_; }  // factor of the equations: a cycle solves scale A x = b
  void cycle() { cycle_from(0); }

  std::size_t grids() const { return levels_.size(); }
  std::size_t bytes() const;

 private:
  struct Step {
    MultigridLevel<Real> grid;
    std::array<int, 3> ratio{1, 1, 1};  // to the next coarser grid
  };
  void cycle_from(std::size_t n);
  void down(Step& fine, MultigridLevel<Real>& coarse) const;
  void up(Step& fine, const MultigridLevel<Real>& coarse) const;

  std::vector<Step> levels_;
  int sweeps_;
  double scale_ = 1;
};

}  // namespace sluice::solve
