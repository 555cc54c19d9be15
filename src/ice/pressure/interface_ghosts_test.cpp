// Manufactured Poisson problems on nested levels: the two-point matrix, corrected by the fluxes of
// the parabola where levels meet, is of second order in the largest error.
#include "ice/pressure/interface_ghosts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/solve/composite_solver.hpp"
#include "framework/solve/solve_test_support.hpp"

namespace sluice::ice::pressure::interface_ghosts_test {
namespace {

using solve::BoxArrays;
using solve::CompositeVector;
using solve::Sides;

constexpr double pi = std::numbers::pi;
constexpr double min_order = 1.9;

struct Problem {
  Sides sides;
  int dimensions, levels, ratio, cells;  // cells: a side of the coarsest level
};
std::ostream& operator<<(std::ostream& out, const Problem& p) {
  return out << p.dimensions << "-D, " << p.levels << " levels, ratio " << p.ratio << ", sides "
             << static_cast<int>(p.sides);
}

// One factor of the solution: its second derivative is -(wave)^2 times itself.
struct Factor {
  double wave;
  bool sine;
  double operator()(double x) const { return sine ? std::sin(wave * x) : std::cos(wave * x); }
};
Factor factor_of(Sides sides, int direction) {
  switch (sides) {
    case Sides::dirichlet:
      return {pi, true};
    case Sides::neumann:
      return {pi, false};
    case Sides::periodic:
      return {2 * pi, true};
    case Sides::mixed:
      break;
  }
  return {pi / 2, direction != 1};  // as solve::is_dirichlet says
}

// Nested squares or cubes in the middle of the domain, each half as wide as the one around; a
// quarter where half would be millions of cells.
std::vector<Level> nested(const Problem& p, int cells) {
  std::vector<Level> all;
  int n = cells, low = 0, high = cells;
  for (int l = 0; l < p.levels; ++l) {
    if (l > 0) {
      const int eighths = p.dimensions == 3 && p.ratio == 4 && p.levels > 2 ? 3 : 2;
      const int margin = (high - low) * eighths / 8;
      low = (low + margin) * p.ratio;
      high = (high - margin) * p.ratio;
      n *= p.ratio;
    }
    Level& level = all.emplace_back();
    level.index = l;
    level.domain = {{0, 0, 0}, {1, 1, 1}};
    IndexBox box = level.domain;
    level.spacing = {1, 1, 1};
    for (int d = 0; d < p.dimensions; ++d) {
      level.active[d] = true;
      level.periodic[d] = p.sides == Sides::periodic;
      level.domain.upper[d] = n;
      level.spacing[d] = 1.0 / n;
      level.ratio[d] = p.ratio;
      box.lower[d] = low;
      box.upper[d] = high;
    }
    for (int d = p.dimensions; d < 3; ++d) level.active[d] = false;
    level.boxes = {{box, 0, 0}};
  }
  return all;
}

// -div grad u + own u = f on all levels, solved by corrections of the defect.
class Corrected {
 public:
  Corrected(const Problem& p, int cells)
      : p_(p), levels_(nested(p, cells)), own_(p.sides == Sides::periodic ? 1.0 : 0.0) {
    if (p.sides == Sides::neumann) own_ = 1.0;
    for (const Level& level : levels_) {
      IndexBox with_ghosts = box(level);
      for (int d = 0; d < p.dimensions; ++d) {
        --with_ghosts.lower[d];
        ++with_ghosts.upper[d];
      }
      numbers_.emplace_back(solve::boxes_of(level, 0));
      windows_.emplace_back(std::vector{with_ghosts});
      right_side_.emplace_back(solve::boxes_of(level, 0));
      coefficients_.emplace_back(level, 0);
      set_coefficients(level, coefficients_.back());
    }
    solve::SolverSettings settings;
    settings.tolerance = 1e-6;
    solver_ = std::make_unique<solve::CompositeSolver>(settings);
    solver_->set_up(coefficients_);
  }

  // The largest |u - exact| after so many corrections.
  double error(int corrections) {
    const solve::CompositeSystem& system = solver_->system();
    CompositeVector x = system.vector(), change = x, b = x;
    for (int n = 0; n < corrections; ++n) {
      take(x);
      for (std::size_t l = 0; l < levels_.size(); ++l) find_defect(l);
      for (std::size_t l = 0; l < levels_.size(); ++l) system.load(l, right_side_[l].values(), b);
      system.clear_covered(b);
      const solve::SolveReport report = solver_->solve(b, change);
      EXPECT_TRUE(report.converged) << report.reason;
      for (std::size_t l = 0; l < x.size(); ++l)
        for (std::size_t c = 0; c < x[l].size(); ++c) x[l][c] += change[l][c];
    }
    take(x);
    double largest = 0;
    for (std::size_t l = 0; l < levels_.size(); ++l)
      for_each_cell(box(levels_[l]), [&](IntVec3 c) {
        if (!covered(l, c))
          largest = std::max(largest, std::fabs(windows_[l].views()[0](c) - exact(levels_[l], c)));
      });
    return largest;
  }

 private:
  static const IndexBox& box(const Level& level) { return level.boxes.front().cells; }

  void set_coefficients(const Level& level, solve::LevelCoefficients& c) const {
    for_each_cell(box(level), [&](IntVec3 cell) {
      c.own.views()[0](cell) = own_ * level.cell_volume();
      for (int d = 0; d < p_.dimensions; ++d) {
        c.low[d].views()[0](cell) = weight(level, d) * at_side(level, cell, d, -1);
        c.high[d].views()[0](cell) = weight(level, d) * at_side(level, cell, d, 1);
      }
    });
  }
  static double weight(const Level& level, int d) {
    return level.cell_volume() / (level.spacing[d] * level.spacing[d]);
  }
  bool leaves(const Level& level, IntVec3 cell, int d, int side) const {
    return cell[d] == (side < 0 ? level.domain.lower[d] : level.domain.upper[d] - 1);
  }
  double at_side(const Level& level, IntVec3 cell, int d, int side) const {
    if (p_.sides == Sides::periodic || !leaves(level, cell, d, side)) return 1;
    return solve::is_dirichlet(p_.sides, d, side > 0) ? 2 : 0;
  }

  double exact(const Level& level, IntVec3 c) const {
    double u = 1;
    for (int d = 0; d < p_.dimensions; ++d) u *= factor_of(p_.sides, d)(level.centre(c)[d]);
    return u;
  }
  double source(const Level& level, IntVec3 c) const {
    double waves = own_;
    for (int d = 0; d < p_.dimensions; ++d) waves += std::pow(factor_of(p_.sides, d).wave, 2);
    return waves * exact(level, c);
  }
  bool covered(std::size_t l, IntVec3 c) const {
    if (l + 1 >= levels_.size()) return false;
    const Level& finer = levels_[l + 1];
    return box(finer).contains(first_child(finer, c));
  }
  static IntVec3 first_child(const Level& finer, IntVec3 c) {
    return {c.x * finer.ratio.x, c.y * finer.ratio.y, c.z * finer.ratio.z};
  }

  // x into the windows of all levels, with their ghosts.
  void take(CompositeVector& x) {
    const solve::CompositeSystem& system = solver_->system();
    system.cover(x);
    for (std::size_t l = 0; l < levels_.size(); ++l) {
      system.store(x, l, numbers_[l].views());
      const RealView& from = numbers_[l].views()[0];
      const RealView& to = windows_[l].views()[0];
      for_each_cell(box(levels_[l]), [&](IntVec3 c) { to(c) = from(c); });
      if (l == 0) continue;
      InterfaceGhosts(levels_[l - 1], levels_[l], numbers_[l - 1].values(), numbers_[l].values())
          .fill(to, box(levels_[l]));
    }
  }

  // What flows in across a face, by differences of second order.
  double inflow(std::size_t l, IntVec3 c, int d, int side) const {
    const Level& level = levels_[l];
    const RealView& u = windows_[l].views()[0];
    IntVec3 beside = c;
    beside[d] += side;
    if (leaves(level, c, d, side)) {
      if (p_.sides != Sides::periodic) return -weight(level, d) * at_side(level, c, d, side) * u(c);
      beside[d] = side < 0 ? level.domain.upper[d] - 1 : level.domain.lower[d];
    }
    if (!covered(l, beside)) return weight(level, d) * (u(beside) - u(c));
    const Level& finer = levels_[l + 1];
    IndexBox faces{first_child(finer, beside), first_child(finer, beside)};
    for (int t = 0; t < 3; ++t) faces.upper[t] += t < p_.dimensions ? p_.ratio : 1;
    (side > 0 ? faces.upper[d] : faces.lower[d]) =
        side > 0 ? faces.lower[d] + 1 : faces.upper[d] - 1;
    double sum = 0;
    for_each_cell(faces, [&](IntVec3 f) { sum -= inflow(l + 1, f, d, -side); });
    return sum;
  }

  void find_defect(std::size_t l) {
    const Level& level = levels_[l];
    for_each_cell(box(level), [&](IntVec3 c) {
      double& defect = right_side_[l].views()[0](c);
      defect = 0;
      if (covered(l, c)) return;
      defect = level.cell_volume() * (source(level, c) - own_ * windows_[l].views()[0](c));
      for (int d = 0; d < p_.dimensions; ++d)
        for (const int side : {-1, 1}) defect += inflow(l, c, d, side);
    });
  }

  Problem p_;
  std::vector<Level> levels_;
  double own_;
  std::vector<BoxArrays> numbers_, windows_, right_side_;
  std::vector<solve::LevelCoefficients> coefficients_;
  std::unique_ptr<solve::CompositeSolver> solver_;
};

class CompositePoisson : public testing::TestWithParam<Problem> {};

TEST_P(CompositePoisson, IsOfSecondOrder) {
  constexpr int corrections = 10;  // each leaves a fifth
  const Problem& p = GetParam();
  const double coarse = Corrected(p, p.cells).error(corrections);
  const double fine = Corrected(p, 2 * p.cells).error(corrections);
  const double order = std::log2(coarse / fine);
  RecordProperty("order", std::to_string(order));
  EXPECT_GE(order, min_order) << coarse << " " << fine;
}

constexpr Sides all_sides[] = {Sides::dirichlet, Sides::neumann, Sides::mixed, Sides::periodic};

std::vector<Problem> problems() {
  std::vector<Problem> all;
  for (const Sides sides : all_sides) {
    for (int levels = 1; levels <= 4; ++levels) all.push_back({sides, 2, levels, 2, 16});
    all.push_back({sides, 2, 2, 4, 16});
    all.push_back({sides, 3, 2, 2, sides == Sides::periodic ? 12 : 8});
  }
  return all;
}
std::vector<Problem> long_problems() {
  std::vector<Problem> all;
  for (const Sides sides : all_sides) {
    const int cells = sides == Sides::periodic ? 12 : 8;
    all.push_back({sides, 3, 1, 2, cells});
    for (const int ratio : {2, 4})
      for (int levels = 2; levels <= 4; ++levels) {
        if (ratio == 4 && levels > 2) all.push_back({sides, 2, levels, ratio, 16});
        const bool narrow = ratio == 4 && levels > 2;
        if (ratio == 4 || levels > 2)
          all.push_back({sides, 3, levels, ratio, narrow && cells == 12 ? 16 : cells});
      }
  }
  return all;
}

// Measured 1.90 (three dimensions) and more.
INSTANTIATE_TEST_SUITE_P(AllSides, CompositePoisson, testing::ValuesIn(problems()));
INSTANTIATE_TEST_SUITE_P(Full, CompositePoisson, testing::ValuesIn(long_problems()));

// What the parabola is for.
TEST(CompositePoissonMatrix, AloneIsOfNoSecondOrder) {
  const Problem p{Sides::dirichlet, 2, 2, 2, 16};
  EXPECT_LT(std::log2(Corrected(p, 16).error(1) / Corrected(p, 32).error(1)), 1.5);
}

}  // namespace
}  // namespace sluice::ice::pressure::interface_ghosts_test
