// Systems on several levels: symmetric, solved in few iterations, the same as on one level where
// the finer one changes nothing; corrections of the defect give second order (manufactured).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "framework/base/communicator.hpp"
#include "framework/base/error.hpp"
#include "framework/solve/composite_solver.hpp"

namespace sluice::solve::composite_test {
namespace {

Level level_of(int index, int dimensions, int cells, const IndexBox& box, int ratio) {
  Level l;
  l.index = index;
  l.active = {true, dimensions > 1, dimensions > 2};
  l.domain = {{0, 0, 0}, {cells, dimensions > 1 ? cells : 1, dimensions > 2 ? cells : 1}};
  l.spacing = {1.0 / cells, 1.0 / cells, 1.0 / cells};
  l.ratio = {ratio, dimensions > 1 ? ratio : 1, dimensions > 2 ? ratio : 1};
  l.boxes = {{box, 0, 0}};
  return l;
}

// Nested squares or cubes in the middle of the domain, each half as wide as the one around.
std::vector<Level> nested(int dimensions, int cells, int levels, int ratio) {
  std::vector<Level> all;
  int n = cells, low = 0, high = cells;
  for (int l = 0; l < levels; ++l) {
    if (l > 0) {
      const int quarter = (high - low) / 4;
      low = (low + quarter) * ratio;
      high = (high - quarter) * ratio;
      n *= ratio;
    }
    IndexBox box{{low, 0, 0}, {high, 1, 1}};
    if (dimensions > 1) box.lower.y = low, box.upper.y = high;
    if (dimensions > 2) box.lower.z = low, box.upper.z = high;
    all.push_back(level_of(l, dimensions, n, box, ratio));
  }
  return all;
}

// rho of 1 or, in a ball, less; own coefficient 1/(rho c^2).
std::vector<LevelCoefficients> coefficients(const std::vector<Level>& levels, double own,
                                            double jump) {
  std::vector<LevelCoefficients> all;
  for (const Level& l : levels) {
    LevelCoefficients& c = all.emplace_back(l, 0);
    const auto beta = [&](IntVec3 cell, int d, int side) {
      Vec3 x = l.centre(cell);
      x[d] += 0.5 * side * l.spacing[d];
      double r2 = 0;
      for (int e = 0; e < 3; ++e)
        if (l.active[e]) r2 += (x[e] - 0.4) * (x[e] - 0.4);
      return r2 < 0.09 ? jump : 1.0;
    };
    for (std::size_t b = 0; b < l.boxes.size(); ++b)
      for_each_cell(l.boxes[b].cells, [&](IntVec3 cell) {
        c.own.views()[b](cell) = own * l.cell_volume();
        for (int d = 0; d < 3; ++d) {
          if (!l.active[d]) continue;
          const double per_dx2 = l.cell_volume() / (l.spacing[d] * l.spacing[d]);
          // Dirichlet on the sides: half a cell away.
          const auto at_side = [&](int side) {
            const int end = side < 0 ? l.domain.lower[d] : l.domain.upper[d] - 1;
            return cell[d] == end ? 2.0 : 1.0;
          };
          c.low[d].views()[b](cell) = beta(cell, d, -1) * per_dx2 * at_side(-1);
          c.high[d].views()[b](cell) = beta(cell, d, 1) * per_dx2 * at_side(1);
        }
      });
  }
  return all;
}

void fill(const std::vector<Level>& levels, CompositeSystem& system, CompositeVector& v,
          auto value) {
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const BoxArrays arrays(boxes_of(levels[l], 0));
    for (std::size_t b = 0; b < arrays.views().size(); ++b)
      for_each_cell(levels[l].boxes[b].cells,
                    [&](IntVec3 c) { arrays.views()[b](c) = value(levels[l], c); });
    system.load(l, arrays.values(), v);
  }
}

double wave(const Level& l, IntVec3 c) {
  const Vec3 x = l.centre(c);
  return std::sin(3 * x.x + 1) * std::cos(5 * x.y) * std::cos(2 * x.z) + 0.3 * ((c.x + c.y) & 1);
}

struct Case {
  int dimensions, cells, levels, ratio;
  double jump;
  int max_iterations, most_with_amg;  // two more than measured with amg, to 1e-11
};

class CompositeCase : public testing::TestWithParam<Case> {
 protected:
  static void solve_with(const SolverSettings& settings, int max_iterations) {
    const Case k = GetParam();
    const std::vector<Level> levels = nested(k.dimensions, k.cells, k.levels, k.ratio);
    CompositeSolver solver(settings);
    const auto parts = coefficients(levels, 1e-3, k.jump);
    solver.set_up(parts);
    auto& system = const_cast<CompositeSystem&>(solver.system());
    CompositeVector a = system.vector(), b = a, Aa = a, Ab = a;
    fill(levels, system, a, wave);
    fill(levels, system, b, [](const Level& l, IntVec3 c) {
      return wave(l, c + IntVec3{3, 5, 1});
    });
    system.apply(a, Aa);
    system.apply(b, Ab);
    const double scale = std::sqrt(system.dot(Aa, Aa) * system.dot(b, b));
    EXPECT_NEAR(system.dot(Aa, b), system.dot(a, Ab), 1e-13 * scale);
    CompositeVector x = system.vector();
    const SolveReport report = solver.solve(Aa, x);
    EXPECT_TRUE(report.converged) << report.reason;
    EXPECT_LE(report.iterations, max_iterations);
    double worst = 0;
    for (std::size_t l = 0; l < x.size(); ++l)
      for (std::size_t c = 0; c < x[l].size(); ++c)
        worst = std::max(worst, std::fabs(x[l][c] - a[l][c]));
    EXPECT_LT(worst, 1e-7);
  }
};

TEST_P(CompositeCase, IsSymmetricAndSolvedInFewIterations) {
  solve_with({}, GetParam().max_iterations);
}

// hypre's rows are those of the system: its cycle would not converge so fast on others.
TEST_P(CompositeCase, IsSolvedWithBoomerAmgToo) {
  SolverSettings amg;
  amg.type = "hypreamr";
  amg.tolerance = 1e-11;
  solve_with(amg, GetParam().most_with_amg);
}

INSTANTIATE_TEST_SUITE_P(Nested, CompositeCase,
                         testing::Values(Case{2, 32, 2, 2, 1, 14, 18}, Case{2, 32, 4, 2, 1, 16, 19},
                                         Case{2, 32, 3, 4, 1, 24, 20}, Case{1, 64, 3, 2, 1, 12, 17},
                                         Case{3, 16, 2, 2, 1, 16, 17},
                                         Case{2, 32, 3, 2, 1e-4, 24, 18},
                                         Case{2, 32, 3, 2, 1e4, 24, 19}));

TEST(CompositeSystem, NamesTheCellOfACoefficientThatIsNoNumber) {
  const std::vector<Level> levels = nested(2, 16, 2, 2);
  auto parts = coefficients(levels, 1e-3, 1);
  parts[0].own.views()[0]({1, 2, 0}) = std::numeric_limits<double>::quiet_NaN();
  CompositeSolver solver({});
  try {
    solver.set_up(parts);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const PhysicsError& error) {
    EXPECT_NE(std::string(error.what()).find("cell (1, 2, 0)"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sluice::solve::composite_test
