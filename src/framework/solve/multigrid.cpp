// The hierarchy of grids and the order of work in a cycle.
#include "framework/solve/multigrid.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::solve {
namespace {

// Halves the directions of strong coupling; where lines are solved, among the other two, as long as
// these have cells to halve.
std::array<int, 3> ratio_of(const DenseShape& shape, std::array<double, 3> mean, bool lines,
                            double share) {
  if (lines && (shape.count[0] > 1 || shape.deep())) mean[1] = -1;
  const double strongest = *std::max_element(mean.begin(), mean.end());
  std::array<int, 3> ratio{1, 1, 1};
  for (int d = 0; d < 3; ++d)
    if (shape.count[d] > 1 && mean[d] >= share * strongest) ratio[d] = 2;
  return ratio;
}

// Several stages over the own slices of a grid, each one slice behind the one before it: a slice is
// still in the cache when the next stage comes. Where slices are periodic or ranks share them, a
// stage must have ended before the next begins.
template <class Real>
class Pipeline {
 public:
  explicit Pipeline(MultigridLevel<Real>& grid)
      : grid_(grid),
        begin_(grid.slabs().begin()),
        slices_(grid.slabs().end() - begin_),
        lag_(grid.shape().periodic[2] || grid.slabs().shared() ? slices_ : 1) {}

  // stage(s, k) for all stages s and slices k. After the last stage the slices beside the own ones
  // are as they were before it.
  template <class Stage>
  void run(int stages, Stage&& stage) const {
    for (int front = 0; front < slices_ + (stages - 1) * lag_; ++front) {
      for (int s = 0; s < stages; ++s) {
        const int k = front - s * lag_;
        if (k < 0 || k >= slices_) continue;
        stage(s, begin_ + k);
        grid_.wrap_round(begin_ + k);
        if (k == slices_ - 1 && s < stages - 1) grid_.wrap_last();
      }
    }
  }

 private:
  MultigridLevel<Real>& grid_;
  int begin_, slices_, lag_;
};

}  // namespace

bool needs_lines(const DenseEquations& equations, const MultigridSettings& settings) {
  const std::array<double, 3> mean = equations.mean_couplings();
  return !equations.shape.periodic[1] && mean[1] > settings.line_ratio * std::max(mean[0], mean[2]);
}

template <class Real>
Multigrid<Real>::Multigrid(DenseEquations finest, const MultigridSettings& settings)
    : sweeps_(settings.sweeps) {
  if (const double largest = finest.largest_diagonal(); largest > 0)
    scale_ = std::ldexp(1.0, -std::ilogb(largest));
  DenseEquations e = std::move(finest);
  while (true) {
    const std::array<double, 3> mean = e.mean_couplings();
    const bool lines = needs_lines(e, settings);
    Step step{MultigridLevel<Real>(e, scale_, lines)};
    if (e.shape.cells() == 1) {
      levels_.push_back(std::move(step));
      return;
    }
    step.ratio = ratio_of(e.shape, mean, lines, settings.coarsen_share);
    e = e.coarsened(step.ratio);
    levels_.push_back(std::move(step));
  }
}

template <class Real>
void Multigrid<Real>::down(Step& fine, MultigridLevel<Real>& coarse) const {
  MultigridLevel<Real>& grid = fine.grid;
  const int stages = 2 * sweeps_ + 1;
  Pipeline(grid).run(stages, [&](int s, int k) {
    if (s == 0) {
      grid.first_sweep(k);
    } else if (s < stages - 1) {
      grid.sweep(k, s & 1);
    } else {
      grid.restrict_residual(k, coarse, fine.ratio);
    }
  });
  if (grid.slabs().shared() && !coarse.slabs().shared())
    grid.slabs().grouped(coarse.shape(), fine.ratio[2]).gather(coarse.shape(), coarse.right_side());
}

template <class Real>
void Multigrid<Real>::up(Step& fine, const MultigridLevel<Real>& coarse) const {
  MultigridLevel<Real>& grid = fine.grid;
  Pipeline(grid).run(2 * sweeps_ + 1, [&](int s, int k) {
    if (s == 0) {
      grid.add_correction(k, coarse, fine.ratio);
    } else {
      grid.sweep(k, s & 1);
    }
  });
}

template <class Real>
void Multigrid<Real>::cycle_from(std::size_t n) {
  if (n + 1 == levels_.size()) {
    levels_[n].grid.solve_one_cell();
    return;
  }
  down(levels_[n], levels_[n + 1].grid);
  cycle_from(n + 1);
  up(levels_[n], levels_[n + 1].grid);
}

template <class Real>
std::size_t Multigrid<Real>::bytes() const {
  std::size_t total = 0;
  for (const Step& step : levels_) total += step.grid.bytes();
  return total;
}

template class Multigrid<float>;
template class Multigrid<double>;

}  // namespace sluice::solve
