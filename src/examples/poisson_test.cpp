// Laplace's equation on nodes: boundary values, convergence, the residual, equal bits.
#include "examples/poisson.hpp"

#include "examples/test_support/example_run.hpp"

namespace sluice::examples::poisson_test {
namespace {

using ::testing::HasSubstr;

constexpr Example poisson1{add_poisson_tags, make_poisson};

std::string side(const std::string& name, double value) {
  return "<Face side=\"" + name + "\"><BCType id=\"0\" label=\"Phi\" var=\"Dirichlet\"><value>" +
         std::to_string(value) + "</value></BCType></Face>\n";
}

ExampleDeck deck(IntVec3 cells, int steps) {
  ExampleDeck d;
  d.type = "poisson1";
  d.blocks = "<Poisson><delt>.01</delt><maxresidual>.01</maxresidual></Poisson>";
  d.save = "<save label=\"phi\"/><save label=\"residual\"/>";
  d.cells = cells;
  d.max_steps = steps;
  d.sides = side("x-", 1);
  for (const char* name : {"x+", "y-", "y+"}) d.sides += side(name, 0);
  if (cells.z > 1) d.sides += side("z-", 0) + side("z+", 0);
  return d;
}

// What the sweeps do, by itself: values at all nodes of n^3 cells, x fastest.
std::vector<double> jacobi(int n, int sweeps, std::vector<double>& residuals) {
  const int m = n + 1;
  const auto at = [m](int i, int j, int k) {
    return static_cast<std::size_t>(i + m * (j + m * k));
  };
  std::vector<double> phi(m * m * m, 0.0);
  for (int k = 0; k < m; ++k)
    for (int j = 0; j < m; ++j)
      if (j > 0 && j < n && k > 0 && k < n) phi[at(0, j, k)] = 1;
  for (int s = 0; s < sweeps; ++s) {
    std::vector<double> next = phi;
    double residual = 0;
    for (int k = 1; k < n; ++k)
      for (int j = 1; j < n; ++j)
        for (int i = 1; i < n; ++i) {
          double& to = next[at(i, j, k)];
          to = (phi[at(i - 1, j, k)] + phi[at(i + 1, j, k)] + phi[at(i, j - 1, k)] +
                phi[at(i, j + 1, k)] + phi[at(i, j, k - 1)] + phi[at(i, j, k + 1)]) /
               6;
          residual += (to - phi[at(i, j, k)]) * (to - phi[at(i, j, k)]);
        }
    residuals.push_back(residual);
    phi = next;
  }
  return phi;
}

TEST(Poisson, SweepsAreThoseOfJacobi) {
  const ExampleRun run(poisson1, deck({8, 8, 8}, 5).text());
  EXPECT_EQ(run.report().steps, 5);
  EXPECT_DOUBLE_EQ(run.report().time, 0.05);
  std::vector<double> residuals;
  const std::vector<double> expected = jacobi(8, 5, residuals), found = run.values("phi");
  ASSERT_EQ(found.size(), 9U * 9 * 9);  // a node more than cells, the closing ones too
  for (std::size_t n = 0; n < found.size(); ++n) EXPECT_NEAR(found[n], expected[n], 1e-15);
  const std::vector<double> history = run.history("residual");
  ASSERT_EQ(history.size(), 5U);
  for (std::size_t n = 0; n < 5; ++n) EXPECT_NEAR(history[n], residuals[n], 1e-14);
}

TEST(Poisson, AStraightLineBetweenTwoSides) {
  ExampleDeck d = deck({16, 1, 1}, 3000);
  d.sides = side("x-", 3) + side("x+", -1);
  const ExampleRun run(poisson1, d.text());
  EXPECT_LT(run.worst("phi", [](Vec3 x) { return 3 - 4 * x.x; }), 1e-12);
}

// The four problems with 1 on one side each are turns of one another, and their sum is 1: a quarter
// at the centre, on every grid.
TEST(Poisson, TheSquareHasAQuarterAtItsCentre) {
  for (const int n : {8, 16}) {
    const ExampleRun run(poisson1, deck({n, n, 1}, 1500).text());
    const auto centre = [](Vec3 x) {
      return std::abs(x.x - 0.5) < 1e-9 && std::abs(x.y - 0.5) < 1e-9;
    };
    EXPECT_LT(run.worst(
                  "phi", [](Vec3) { return 0.25; }, centre),
              1e-9)
        << n;
  }
}

// The series of the square: of second order inside, away from the corners where sides disagree.
double square(Vec3 x) {
  double sum = 0;
  const double pi = std::acos(-1.0);
  for (int n = 1; n < 80; n += 2)
    sum +=
        4 / (n * pi) * std::sinh(n * pi * (1 - x.x)) / std::sinh(n * pi) * std::sin(n * pi * x.y);
  return sum;
}

TEST(Poisson, ConvergesToSecondOrderInsideTheSquare) {
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const int n = 16 << level;
    const ExampleRun run(poisson1, deck({n, n, 1}, 3 * n * n).text());
    error[level] = run.worst("phi", square, [](Vec3 x) {
      return std::abs(x.x - 0.5) < 0.26 && std::abs(x.y - 0.5) < 0.26;
    });
  }
  EXPECT_GT(std::log2(error[0] / error[1]), 1.9) << error[0] << ' ' << error[1];
}

TEST(Poisson, SameBitsOnBoxesBlocksAndThreads) {
  const std::string text = deck({12, 10, 9}, 6).text();
  const ExampleRun whole(poisson1, text);
  for (const ExampleOptions& o :
       {ExampleOptions{{3, 1, 1}, 1, {}}, ExampleOptions{{2, 3, 4}, 2, {}},
        ExampleOptions{{1, 1, 1}, 2, {5, 3, 2}}}) {
    const ExampleRun cut(poisson1, text, o);
    EXPECT_EQ(cut.values("phi"), whole.values("phi"));
    EXPECT_EQ(cut.history("residual"), whole.history("residual"));
  }
}

TEST(Poisson, PeriodicDirectionsHaveNoSides) {
  ExampleDeck d = deck({8, 4, 4}, 1500);
  d.periodic = {0, 1, 1};
  d.sides = side("x-", 2) + side("x+", 0);
  const ExampleRun run(poisson1, d.text(), {{2, 2, 1}, 1, {}});
  EXPECT_LT(run.worst("phi", [](Vec3 x) { return 2 - 2 * x.x; }), 1e-12);
}

TEST(Poisson, DecksThatSayTooLittleOrTooMuch) {
  ExampleDeck d = deck({4, 4, 4}, 1);
  d.sides = side("x-", 1);
  EXPECT_THAT(faults_of(poisson1, d.text()),
              HasSubstr("warning: side z+ has no condition for Phi: 0 is used"));
  d = deck({4, 4, 4}, 1);
  d.blocks = "";
  EXPECT_THAT(faults_of(poisson1, d.text()),
              HasSubstr("a poisson1 deck needs the block <Poisson>"));
  d = deck({4, 4, 4}, 1);
  d.sides.replace(d.sides.find("Dirichlet"), 9, "Neumann");
  EXPECT_THAT(faults_of(poisson1, d.text()),
              HasSubstr("the condition for Phi must be its value on the side"));
}

}  // namespace
}  // namespace sluice::examples::poisson_test
