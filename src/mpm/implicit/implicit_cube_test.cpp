// Cubes with more unknowns than are solved directly: against direct solutions, large deflections,
// one particle per cell, bits.
#include <gtest/gtest.h>

#include "mpm/test_support/implicit_run.hpp"

namespace sluice::mpm::implicit_cube_test {
namespace {

// E = 1, nu = .3, density 1; held at x = 0, gravity along -y; a unit cube of n cells each way.
struct Cube {
  int cells = 7;
  const char* basis = "linear";
  bool dynamic = false;
  double gravity = 0.01;
  const char* res = "[2,2,2]";
  std::string flags = {};
};

SolidDeck deck_of(const Cube& c) {
  SolidDeck deck;
  deck.upper = "[1.4,3,2]";
  const int n = c.cells;
  deck.cells = fmt::format("[{},{},{}]", n * 14 / 10, 3 * n, 2 * n);
  deck.upper = fmt::format("[{},3,2]", static_cast<double>(n * 14 / 10) / n);
  deck.flags = fmt::format(
      "<time_integrator>implicit</time_integrator><interpolator>{}</interpolator>"
      "<dynamic>{}</dynamic>{}",
      c.basis, c.dynamic, c.flags);
  deck.objects = fmt::format(
      "<geom_object><box><min>[0,1.5,0.5]</min><max>[1,2.5,1.5]</max></box><res>{}</res>"
      "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>",
      c.res);
  deck.faces =
      "<Face side='x-'><BCType id='all' label='Velocity' var='Dirichlet'><value>[0,0,0]</value>"
      "</BCType></Face>" +
      free_face("x+") + free_face("y-") + free_face("y+") + free_face("z-") + free_face("z+");
  return deck;
}

struct Ran {
  std::vector<std::vector<double>> way;
  std::vector<double> id = {};
  std::string events = {};
  double lowest = 0, mean = 0;  // displacement along y
};

Ran run_of(const Cube& c, int steps = 1, int threads = 1, const char* patches = "[1,1,1]") {
  TextRun::Rewrites rewrites =
      implicit_steps(0.1, 0.1 * steps, saves({"p.displacement", "p.particleID"}));
  rewrites.emplace_back("<gravity>[0,0,0]", fmt::format("<gravity>[0,{},0]", -c.gravity));
  rewrites.emplace_back("<density>1000</density>", "<density>1</density>");
  rewrites.emplace_back("<bulk_modulus>1e6", "<bulk_modulus>0.8333333333333334");
  rewrites.emplace_back("<shear_modulus>5e5", "<shear_modulus>0.3846153846153846");
  rewrites.emplace_back("</resolution>",
                        fmt::format("</resolution><patches>{}</patches>", patches));
  const TextRun run(deck_of(c), rewrites, "cube", threads, implicit_solids);
  Ran ran{run.particles("p.displacement"), run.particles("p.particleID")[0],
          run.report().events_json};
  for (const double y : ran.way[1]) {
    ran.lowest = std::min(ran.lowest, y);
    ran.mean += y / static_cast<double>(ran.id.size());
  }
  return ran;
}

TEST(ImplicitCube, ConjugateGradientsEndWhereDirectSolutionsEnd) {
  for (const bool dynamic : {false, true}) {
    Cube c{.cells = 6, .basis = dynamic ? "gimp" : "linear", .dynamic = dynamic};
    const Ran by_gradients = run_of(c);
    c.flags = "<solver>simple</solver>";
    const Ran directly = run_of(c);
    double most = 0;
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t p = 0; p < directly.id.size(); ++p)
        most = std::max(most, std::fabs(by_gradients.way[d][p] - directly.way[d][p]));
    EXPECT_LT(most, -1e-6 * directly.lowest) << dynamic;
  }
}

// It bends by about its own length. Newton's method meets matrices that are not positive definite.
TEST(ImplicitCube, BendsByItsOwnLength) {
  const Ran cube = run_of({.gravity = 0.3});
  EXPECT_GT(-cube.lowest, 0.7);
  EXPECT_LT(-cube.lowest, 1.2);
}

// Too much at once: the step is repeated with increments of the load.
TEST(ImplicitCube, LoadsAreAppliedInIncrementsWhereNewtonsMethodFails) {
  const Ran cube = run_of({.cells = 4, .gravity = 0.5});
  EXPECT_NE(cube.events.find("loads were applied in increments"), std::string::npos) << cube.events;
  EXPECT_GT(-cube.lowest, 0.8);
  EXPECT_LT(-cube.lowest, 1.5);
  const Ran easy = run_of({.cells = 4, .gravity = 0.1});
  EXPECT_EQ(easy.events.find("increments"), std::string::npos) << easy.events;
}

// The stiffness of a cell with one particle alone has modes without strain.
TEST(ImplicitCube, OneParticlePerCellIsNearlyAsStiffAsEight) {
  const double eight = run_of({.cells = 8}).mean, one = run_of({.cells = 8, .res = "[1,1,1]"}).mean;
  EXPECT_NEAR(one / eight, 1, 0.03);
}

TEST(ImplicitCube, BitsDoNotDependOnThreadsOrBoxes) {
  const Cube c{.cells = 6, .basis = "gimp"};
  const auto by_id = [](const Ran& ran) {
    std::map<double, std::array<double, 3>> ways;
    for (std::size_t p = 0; p < ran.id.size(); ++p)
      ways[ran.id[p]] = {ran.way[0][p], ran.way[1][p], ran.way[2][p]};
    return ways;
  };
  const auto one = by_id(run_of(c, 2));
  EXPECT_EQ(one, by_id(run_of(c, 2, 2)));
  EXPECT_EQ(one, by_id(run_of(c, 2, 1, "[1,2,2]")));
}

}  // namespace
}  // namespace sluice::mpm::implicit_cube_test
