// Sweeps repeated within a step.
#include "examples/repeated_poisson.hpp"

#include "examples/example_run.hpp"

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
  d.most_steps = 1;
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

TEST(RepeatedPoisson, AResidualBelowRoundOffEndsTheRun) {
  ExampleDeck d = deck({4, 4, 4}, "1e-6");
  d.sides.replace(d.sides.find("<value>1<") + 7, 1, "1e200");  // its square is no number
  EXPECT_THAT([&] { ExampleRun(poisson2, d.text()); },
              ::testing::ThrowsMessage<PhysicsError>(HasSubstr("try a larger <maxresidual>")));
}

}  // namespace
}  // namespace sluice::examples::repeated_poisson_test
