// Burgers' equation: order where it is smooth, speed of shocks, sides, equal bits.
#include "examples/burger.hpp"

#include <numbers>

#include "examples/test_support/example_run.hpp"

namespace sluice::examples::burger_test {
namespace {

using ::testing::HasSubstr;

constexpr Example burger{add_burger_tags, make_burger};

ExampleDeck deck(IntVec3 cells, double dt, double end) {
  ExampleDeck d;
  d.type = "burger";
  d.blocks = "<Burger><delt>" + std::to_string(dt) + "</delt></Burger>";
  d.save = "<save label=\"u\"/>";
  d.cells = cells;
  d.end = end;
  return d;
}

// Along lines that move with u in every direction u stays: u = start(x - t u), by Newton's method.
double exact(Vec3 x, double t, std::array<bool, 3> active) {
  const auto at = [&](double u) {
    Vec3 from{};
    for (int d = 0; d < 3; ++d)
      if (active[d]) from[d] = x[d] - t * u;
    return Burger::start(from);
  };
  double u = at(0);
  for (int n = 0; n < 50; ++n) {
    const double h = 1e-6, f = at(u) - u;
    u -= f / ((at(u + h) - at(u - h)) / (2 * h) - 1);
  }
  return u;
}

double mean_error(const ExampleRun& run, double t, std::array<bool, 3> active) {
  double sum = 0;
  int places = 0;
  run.for_each("u", [&](Vec3 x, double u) {
    sum += std::abs(u - exact(x, t, active));
    ++places;
  });
  return sum / places;
}

// On a domain of two lengths the start is periodic.
TEST(Burger, IsOfSecondOrderWhileItIsSmooth) {
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const int n = 64 << level;
    ExampleDeck d = deck({n, n, 1}, 0.2 / n, 0.04);
    d.high = 2;
    d.periodic = {1, 1, 0};
    error[level] = mean_error(ExampleRun(burger, d.text()), 0.04, {true, true, false});
  }
  EXPECT_GT(std::log2(error[0] / error[1]), 1.8) << error[0] << ' ' << error[1];
}

TEST(Burger, FullInThreeDimensionsToo) {
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const int n = 32 << level;
    ExampleDeck d = deck({n, n, n}, 0.2 / n, 0.01);
    d.high = 2;
    d.periodic = {1, 1, 1};
    error[level] = mean_error(ExampleRun(burger, d.text()), 0.01, {true, true, true});
  }
  EXPECT_GT(std::log2(error[0] / error[1]), 1.7) << error[0] << ' ' << error[1];
}

// sin(pi x) on [0, 2]: a shock stands at x = 1 from t = 1/pi on; u is odd about it, and its mean
// stays 0.
TEST(Burger, AShockStandsWhereItShould) {
  ExampleDeck d = deck({64, 1, 1}, 0.004, 1);
  d.high = 2;
  d.periodic = {1, 0, 0};
  const ExampleRun run(burger, d.text());
  double sum = 0, most = 0;
  run.for_each("u", [&](Vec3 x, double u) {
    if (x.x < 2 - 1e-9) sum += u;
    most = std::max(most, std::abs(u));
    const double left_of_shock = 1 - x.x;
    if (std::abs(left_of_shock) > 0.05 && std::abs(left_of_shock) < 0.95) {
      EXPECT_GT(u * left_of_shock, 0) << x.x;
    }
  });
  EXPECT_LT(std::abs(sum), 1e-12);
  EXPECT_LT(most, 1);
}

TEST(Burger, SidesCopyTheirInnerNodes) {
  const ExampleRun run(burger, deck({6, 5, 4}, 1e-3, 0.01).text());
  const std::vector<double> u = run.values("u");
  const auto at = [&](int i, int j, int k) { return u[i + 7 * (j + 6 * k)]; };
  EXPECT_EQ(at(0, 2, 2), at(1, 2, 2));
  EXPECT_EQ(at(6, 2, 2), at(5, 2, 2));
  EXPECT_EQ(at(0, 0, 0), at(1, 1, 1));
  EXPECT_EQ(at(6, 5, 4), at(5, 4, 3));
}

TEST(Burger, TakesShorterStepsThanTheDeckWhereItMust) {
  const ExampleRun run(burger, deck({20, 20, 1}, 1.0, 0.1).text());
  EXPECT_GT(run.report().steps, 5);
  EXPECT_LT(run.worst("u", [](Vec3) { return 0; }), 2.0);
}

TEST(Burger, SameBitsOnBoxesBlocksAndThreads) {
  const std::string text = deck({12, 10, 9}, 1e-3, 0.01).text();
  const std::vector<double> whole = ExampleRun(burger, text).values("u");
  for (const ExampleOptions& o :
       {ExampleOptions{{3, 1, 1}, 1, {}}, ExampleOptions{{2, 3, 4}, 2, {}},
        ExampleOptions{{1, 1, 1}, 2, {5, 3, 2}}})
    EXPECT_EQ(ExampleRun(burger, text, o).values("u"), whole);
}

TEST(Burger, ConditionsOnSidesHaveNoEffect) {
  ExampleDeck d = deck({4, 4, 4}, 1e-3, 0.01);
  d.sides =
      "<Face side=\"x-\"><BCType id=\"0\" label=\"u\" var=\"Dirichlet\"><value>0</value></BCType>"
      "</Face>";
  EXPECT_THAT(faults_of(burger, d.text()), HasSubstr("warning: this condition has no effect"));
}

}  // namespace
}  // namespace sluice::examples::burger_test
