#include "framework/solve/block/block_cycle.hpp"

#include <algorithm>
#include <Eigen/Dense>

namespace sluice::solve {
namespace {

constexpr std::size_t most_direct = 400;  // unknowns of the coarsest grid, whose matrix is dense
constexpr std::size_t most_grids = 16;
// The diagonal of the coarsest matrix is raised by this part of itself and of its largest number.
constexpr double raised = 1e-10, raised_by_largest = 1e-13;

}  // namespace

struct BlockCycle::Grid {
  BlockRows own;                    // of all grids but the finest
  const BlockRows* rows = nullptr;  // own, or the matrix of the caller
  Interpolation to_next;
  Chebyshev smoother;
  std::vector<double> x, b, r;
};

struct BlockCycle::Factor {
  Eigen::LLT<Eigen::MatrixXd> cholesky;
  Eigen::LDLT<Eigen::MatrixXd> indefinite;
  bool definite = true;
};

BlockCycle::BlockCycle(const Workers& workers) : workers_(&workers) {}
BlockCycle::~BlockCycle() = default;

bool BlockCycle::set_up(const BlockRows& rows, Chebyshev::Estimate estimate) {
  const bool known = !grids_.empty() && grids_.front()->x.size() == rows.unknowns() &&
                     grids_.front()->rows->place == rows.place;
  if (!known) grids_.clear();
  for (std::size_t n = 0;; ++n) {
    if (n == grids_.size()) grids_.push_back(std::make_unique<Grid>());
    Grid& grid = *grids_[n];
    if (n == 0) {
      grid.rows = &rows;
    } else {
      const Grid& finer = *grids_[n - 1];
      grid.own = galerkin_product(*finer.rows, finer.to_next, *workers_);
      grid.rows = &grid.own;
    }
    const std::size_t unknowns = grid.rows->unknowns();
    for (std::vector<double>* v : {&grid.x, &grid.b, &grid.r}) v->resize(unknowns);
    if (unknowns <= most_direct || n + 1 == most_grids) break;
    if (!known) grid.to_next = interpolation_between(grid.rows->place);
    // Nodes too far apart to have common coarse nodes: no coarser grid is smaller.
    if (grid.to_next.coarse.size() >= grid.rows->count()) break;
    grid.smoother.set_up(*grid.rows, *workers_, estimate);
  }
  return factor_coarsest();
}

bool BlockCycle::factor_coarsest() {
  const BlockRows& rows = *grids_.back()->rows;
  const auto n = static_cast<Eigen::Index>(rows.unknowns()), w = Eigen::Index{rows.width};
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < rows.count(); ++i)
    for (std::size_t e = rows.begin[i]; e < rows.begin[i + 1]; ++e)
      for (Eigen::Index a = 0; a < w; ++a)
        for (Eigen::Index b = 0; b < w; ++b)
          K(w * static_cast<Eigen::Index>(i) + a, w * rows.column[e] + b) =
              rows.value[static_cast<std::size_t>(w * w) * e + static_cast<std::size_t>(w * a + b)];
  const double most = K.diagonal().maxCoeff();
  if (!(most > 0) || !K.allFinite()) return false;
  for (Eigen::Index i = 0; i < n; ++i) {
    double& diagonal = K(i, i);
    // Unknowns without stiffness are not moved.
    diagonal = diagonal > 1e-14 * most ? diagonal * (1 + raised) + raised_by_largest * most : most;
  }
  factor_ = std::make_unique<Factor>();
  factor_->cholesky.compute(K);
  factor_->definite = factor_->cholesky.info() == Eigen::Success;
  if (factor_->definite) return true;
  factor_->indefinite.compute(K);
  return factor_->indefinite.info() == Eigen::Success;
}

void BlockCycle::cycle(std::size_t n) {
  Grid& grid = *grids_[n];
  if (n + 1 == grids_.size()) {
    const Eigen::Map<const Eigen::VectorXd> b(grid.b.data(),
                                              static_cast<Eigen::Index>(grid.b.size()));
    Eigen::Map<Eigen::VectorXd> x(grid.x.data(), b.size());
    if (factor_->definite)
      x = factor_->cholesky.solve(b);
    else
      x = factor_->indefinite.solve(b);
    return;
  }
  Grid& coarse = *grids_[n + 1];
  const int width = grid.rows->width;
  grid.smoother.smooth_from_zero(grid.b, grid.x, grid.r);
  grid.to_next.sum_to_coarse(*workers_, width, grid.r, coarse.b);
  cycle(n + 1);
  grid.to_next.add_to_fine(*workers_, width, coarse.x, grid.x);
  grid.smoother.smooth(grid.b, grid.x, grid.r);
}

void BlockCycle::apply(std::span<const double> r, std::span<double> x) {
  Grid& finest = *grids_.front();
  std::copy(r.begin(), r.end(), finest.b.begin());
  cycle(0);
  std::copy(finest.x.begin(), finest.x.end(), x.begin());
}

}  // namespace sluice::solve
