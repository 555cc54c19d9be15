// Sweeps repeated within a step.
#include "examples/repeated_poisson.hpp"

#include "examples/test_support/example_run.hpp"

namespace sluice::examples::repeated_poisson_test {
namespace {

using ::testing::HasSubstr;

constexpr Example poisson2{add_poisson_tags, make_repeated_poisson};

ExampleDeck deck(IntVec3 cells, const std::string& residual) {
  ExampleDeck d;
  d.type = "poisson2";
  d.blocks = "<Poisson><delt>.01</delt><maxresidual>" + residual + "</maxresidual></Poisson>";
  d.save = "<save label=\"phi\"/><save label=\"residual\"/>";
  d.cells = cells;
  d.max_steps = 1;
  for (const char* name : {"x-", "x+", "y-", "y+", "z-", "z+"})
    d.sides += std::string("<Face side=\"") + name +
               "\"><BCType id=\"0\" label=\"Phi\" var=\"Dirichlet\"><value>" +
               (name == std::string("x-") ? "1" : "0") + "</value></BCType></Face>\n";
  return d;
}

TEST(RepeatedPoisson, OneStepEndsBelowTheResidual) {
  const ExampleRun run(poisson2, deck({12, 12, 12}, "1e-20").text());
  EXPECT_EQ(run.report().steps, 1);
  const std::vector<double> residual = run.history("residual");
  ASSERT_EQ(residual.size(), 1U);
  EXPECT_LT(residual[0], 1e-20);
  EXPECT_GT(residual[0], 0);
  // A sixth of each of six problems whose sum is 1.
  EXPECT_LT(run.worst(
                "phi", [](Vec3) { return 1.0 / 6; },
                [](Vec3 x) {
                  return std::abs(x.x - 0.5) + std::abs(x.y - 0.5) + std::abs(x.z - 0.5) < 1e-9;
                }),
            1e-8);
}

TEST(RepeatedPoisson, SameBitsOnBoxesBlocksAndThreads) {
  const std::string text = deck({12, 10, 9}, "1e-6").text();
  const ExampleRun whole(poisson2, text);
  for (const ExampleOptions& o :
       {ExampleOptions{{3, 1, 1}, 1, {}}, ExampleOptions{{2, 3, 4}, 2, {}},
        ExampleOptions{{1, 1, 1}, 2, {5, 3, 2}}}) {
    const ExampleRun cut(poisson2, text, o);
    EXPECT_EQ(cut.values("phi"), whole.values("phi"));
    EXPECT_EQ(cut.history("residual"), whole.history("residual"));
  }
}

// Neighbours that sum to more than a number holds.
TEST(RepeatedPoisson, SweepsThatEndNowhereEndTheRun) {
  ExampleDeck d = deck({4, 4, 4}, "1e-6");
  for (const char* value : {"<value>1<", "<value>0<"})
    d.sides.replace(d.sides.find(value) + 7, 1, "1.7e308");
  EXPECT_THAT([&] { ExampleRun(poisson2, d.text()); },
              ::testing::ThrowsMessage<PhysicsError>(HasSubstr("try a larger <maxresidual>")));
}

constexpr Example poisson3{add_poisson_tags, make_poisson_on_levels};

// A second level over the middle half, twice as fine.
std::string with_level(std::string text, int cells, const std::string& z = ".25,.75") {
  const std::size_t comma = z.find(',');
  const std::string n = std::to_string(cells), low = z.substr(0, comma), high = z.substr(comma + 1);
  const std::string level = "<Level><Box label=\"fine\"><lower>[.25,.25," + low +
                            "]</lower><upper>[.75,.75," + high + "]</upper><resolution>[" + n +
                            ',' + n + ',' + n +
                            "]</resolution><patches>[1,1,1]</patches></Box></Level>";
  text.insert(text.find("</Grid>"), level);
  return text.insert(text.find("<Grid>"), "<AMR><useLockStep>true</useLockStep></AMR>\n");
}

// A straight line is what both levels have exactly, and what lies between nodes too.
TEST(PoissonOnLevels, AStraightLineThroughBothLevels) {
  ExampleDeck d = deck({8, 8, 8}, "1e-22");
  d.type = "poisson3";
  d.periodic = {0, 1, 1};
  d.max_steps = 200;
  const ExampleRun run(poisson3, with_level(d.text(), 8), {{2, 2, 1}, 1, {}});
  double worst = 0;
  for (const int level : {0, 1})
    run.for_each(
        "phi", [&](Vec3 x, double v) { worst = std::max(worst, std::abs(v - 1 + x.x)); }, level);
  EXPECT_LT(worst, 1e-9);
}

TEST(PoissonOnLevels, TheCentreOfACubeIsASixth) {
  ExampleDeck d = deck({8, 8, 8}, "1e-20");
  d.type = "poisson3";
  d.max_steps = 200;
  const ExampleRun run(poisson3, with_level(d.text(), 8));
  for (const int level : {0, 1})
    run.for_each(
        "phi",
        [&](Vec3 x, double v) {
          if (std::abs(x.x - 0.5) + std::abs(x.y - 0.5) + std::abs(x.z - 0.5) > 1e-9) return;
          EXPECT_NEAR(v, 1.0 / 6, 3e-3) << level;  // 2.2e-3, all of it from where levels meet
        },
        level);
}

TEST(PoissonOnLevels, SameBitsOnBoxesBlocksAndThreads) {
  ExampleDeck d = deck({8, 8, 8}, "1e-6");
  d.type = "poisson3";
  d.max_steps = 5;
  const std::string text = with_level(d.text(), 8);
  const std::vector<double> whole = ExampleRun(poisson3, text).values("phi");
  for (const ExampleOptions& o :
       {ExampleOptions{{2, 1, 1}, 1, {}}, ExampleOptions{{1, 2, 2}, 2, {}},
        ExampleOptions{{1, 1, 1}, 2, {5, 3, 2}}})
    EXPECT_EQ(ExampleRun(poisson3, text, o).values("phi"), whole);
}

TEST(PoissonOnLevels, LevelsStepTogether) {
  ExampleDeck d = deck({8, 8, 8}, "1e-6");
  d.type = "poisson3";
  std::string text = with_level(d.text(), 8);
  text.replace(text.find(">true</useLockStep>") + 1, 4, "false");
  EXPECT_THAT(faults_of(poisson3, text), HasSubstr("the levels of poisson3 step together"));
}

}  // namespace
}  // namespace sluice::examples::repeated_poisson_test
