// A linear solve as a stage of a step: exact solutions, solvers, equal bits, faults.
#include "examples/linear_solve.hpp"

#include "examples/test_support/example_run.hpp"

namespace sluice::examples::linear_solve_test {
namespace {

using ::testing::HasSubstr;

constexpr Example solvertest{add_solver_test_tags, make_solver_test};

ExampleDeck deck(const std::string& directions, const std::string& parameters,
                 const std::string& solver = "") {
  ExampleDeck d;
  d.type = "solvertest";
  d.blocks = "<SolverTest><delt>.01</delt>" + directions +
             "<Parameters variable=\"implicitPressure\">" + parameters +
             "</Parameters></SolverTest>" + solver;
  d.save =
      "<save label=\"pressure\"/><save label=\"pressure_rhs\"/><save label=\"pressure_matrix\"/>";
  d.cells = {10, 10, 10};
  d.max_steps = 2;
  return d;
}

const std::string all = "<X_Laplacian/><Y_Laplacian/><Z_Laplacian/>";
const std::string tight = "<tolerance>1e-12</tolerance><maxiterations>500</maxiterations>";

// Along x alone: a straight line from the source to the cell beyond the last one.
TEST(LinearSolve, OneDirectionIsAStraightLine) {
  for (const char* solver : {"", "<Solver type=\"hypre\"/>"}) {
    const ExampleRun run(solvertest, deck("<X_Laplacian/>", tight, solver).text());
    const auto exact = [](Vec3 x) {
      const int i = static_cast<int>(x.x * 10), j = static_cast<int>(x.y * 10),
                k = static_cast<int>(x.z * 10);
      return j == 0 && k == 0 ? (10 - i) / 11.0 : 0.0;
    };
    EXPECT_LT(run.worst("pressure", exact), 1e-10) << solver;
    EXPECT_EQ(run.worst("pressure_matrix", [](Vec3) { return 2.0; }), 0);
    EXPECT_EQ(run.worst("pressure_rhs",
                        [](Vec3 x) { return x.x < 0.1 && x.y < 0.1 && x.z < 0.1 ? 1.0 : 0.0; }),
              0);
  }
}

// The sum over the eigenvectors, products of sines.
double series(IntVec3 c, int n) {
  const double pi = std::acos(-1.0);
  double sum = 0;
  for (int a = 1; a <= n; ++a)
    for (int b = 1; b <= n; ++b)
      for (int e = 1; e <= n; ++e) {
        const int m[3] = {a, b, e};
        double product = 1, value = 0;
        for (int d = 0; d < 3; ++d) {
          const double w = pi * m[d] / (n + 1);
          product *= std::sin(w) * std::sin(w * (c[d] + 1)) * 2 / (n + 1);
          value += 2 - 2 * std::cos(w);
        }
        sum += product / value;
      }
  return sum;
}

TEST(LinearSolve, ThreeDirectionsAreTheSeries) {
  const ExampleRun run(solvertest, deck(all, tight).text());
  const auto exact = [](Vec3 x) {
    return series(
        {static_cast<int>(x.x * 10), static_cast<int>(x.y * 10), static_cast<int>(x.z * 10)}, 10);
  };
  EXPECT_LT(run.worst("pressure", exact, [](Vec3 x) { return x.z < 0.25; }), 1e-10);
}

TEST(LinearSolve, SameBitsOnBoxesBlocksAndThreads) {
  const std::string text = deck(all, tight).text();
  const std::vector<double> whole = ExampleRun(solvertest, text).values("pressure");
  for (const ExampleOptions& o :
       {ExampleOptions{{2, 1, 1}, 1, {}}, ExampleOptions{{2, 3, 4}, 2, {}},
        ExampleOptions{{1, 1, 1}, 2, {5, 3, 2}}})
    EXPECT_EQ(ExampleRun(solvertest, text, o).values("pressure"), whole);
}

TEST(LinearSolve, NoConvergenceEndsTheRunWithTheResidual) {
  const std::string text =
      deck(all, "<tolerance>1e-12</tolerance><maxiterations>1</maxiterations>").text();
  EXPECT_THAT([&] { ExampleRun(solvertest, text); },
              ::testing::ThrowsMessage<PhysicsError>(HasSubstr("solve for pressure: residual")));
}

TEST(LinearSolve, ADeckWithoutDirections) {
  EXPECT_THAT(faults_of(solvertest, deck("", tight).text()),
              HasSubstr("needs one of <X_Laplacian>"));
}

}  // namespace
}  // namespace sluice::examples::linear_solve_test
