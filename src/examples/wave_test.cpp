// The wave equation: order against the exact radial solution, levels, mirrors, equal bits.
#include "examples/wave.hpp"

#include "examples/test_support/example_run.hpp"

namespace sluice::examples::wave_test {
namespace {

using ::testing::HasSubstr;

constexpr Example wave{add_wave_tags, make_wave};
constexpr double radius = 0.12;

ExampleDeck deck(IntVec3 cells, double end, const std::string& integration = "RK4") {
  ExampleDeck d;
  d.type = "wave";
  d.blocks =
      "<Wave><radius>.12</radius><initial_condition>Chombo</initial_condition><integration>" +
      integration + "</integration></Wave>";
  d.save = "<save label=\"phi\"/><save label=\"pi\"/>";
  d.cells = cells;
  d.low = -0.5;
  d.high = 0.5;
  d.periodic = {1, 1, 1};
  d.end = end;
  d.multiplier = 0.75;
  return d;
}

// r phi moves both ways as in one dimension: phi = ((r + t) f(r + t) + (r - t) f(r - t)) / (2 r),
// f the start.
double radial(Vec3 x, double t) {
  const double r = std::sqrt(x.x * x.x + x.y * x.y + x.z * x.z);
  const auto f = [](double s) { return std::exp(-s * s / (radius * radius)); };
  return ((r + t) * f(r + t) + (r - t) * f(r - t)) / (2 * r) / (radius * radius * radius);
}

double error_of(int n, double t, const std::string& integration) {
  const ExampleRun run(wave, deck({n, n, n}, t, integration).text());
  return run.worst("phi", [t](Vec3 x) { return radial(x, t); });
}

TEST(Wave, IsOfSecondOrderInSpace) {
  const double coarse = error_of(32, 0.15, "RK4"), fine = error_of(64, 0.15, "RK4");
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << ' ' << fine;
}

// Of first order: pi is half a step off.
TEST(Wave, EulerStaysBounded) {
  const ExampleRun run(wave, deck({16, 16, 16}, 3, "Euler").text());
  const double start = 1 / (radius * radius * radius);
  EXPECT_LT(run.worst("phi", [](Vec3) { return 0; }), start);
  EXPECT_GT(std::log2(error_of(16, 0.15, "Euler") / error_of(32, 0.15, "Euler")), 0.8);
}

TEST(Wave, StatesWithinAStepCanBeSaved) {
  ExampleDeck d = deck({8, 8, 8}, 1);
  d.max_steps = 1;
  d.save = "<save label=\"phi\"/><save label=\"phi1\"/><save label=\"phi4\"/><save label=\"pi4\"/>";
  const ExampleRun run(wave, d.text());
  const double start = std::exp(-3 * 0.0625 * 0.0625 / (radius * radius)) / std::pow(radius, 3);
  const auto corner = [](Vec3 x) {
    return x.x > 0 && x.y > 0 && x.z > 0 && x.x < 0.1 && x.y < 0.1 && x.z < 0.1;
  };
  EXPECT_LT(run.worst(
                "phi1", [&](Vec3) { return start; }, corner),
            1e-9);
  EXPECT_LT(run.worst(
                "phi4", [&](Vec3) { return start; }, corner),
            start);
  EXPECT_THAT(
      [&] {
        ExampleDeck euler = deck({8, 8, 8}, 0.1, "Euler");
        euler.save = "<save label=\"phi4\"/>";
        ExampleRun(wave, euler.text());
      },
      ::testing::ThrowsMessage<InputError>(HasSubstr("phi4")));
}

// A quarter of the domain with mirrors is the whole of it.
TEST(Wave, SidesAreMirrors) {
  const ExampleRun whole(wave, deck({16, 16, 16}, 0.3).text());
  ExampleDeck d = deck({8, 8, 8}, 0.3);
  d.low = 0;
  d.periodic = {0, 0, 0};
  const ExampleRun part(wave, d.text(), {{2, 1, 1}, 1, {}});
  std::vector<double> expected;
  whole.for_each("phi", [&](Vec3 x, double v) {
    if (x.x > 0 && x.y > 0 && x.z > 0) expected.push_back(v);
  });
  const std::vector<double> found = part.values("phi");
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t n = 0; n < found.size(); ++n) EXPECT_NEAR(found[n], expected[n], 1e-9);
}

// Refined where the wave is: as good there as the finer grid everywhere, with fewer cells.
TEST(Wave, LevelsFollowTheWave) {
  ExampleDeck d = deck({16, 16, 16}, 0.15);
  d.blocks =
      "<Wave><radius>.12</radius><integration>RK4</integration><refine_threshold>3"
      "</refine_threshold></Wave><AMR><Regridder type=\"Tiled\"><max_levels>2</max_levels>"
      "<cell_refinement_ratio>[[2,2,2]]</cell_refinement_ratio><cell_stability_dilation>[2,2,2]"
      "</cell_stability_dilation><min_boundary_cells>[1,1,1]</min_boundary_cells>"
      "<min_patch_size>[[4,4,4]]</min_patch_size></Regridder></AMR>";
  const ExampleRun run(wave, d.text());
  EXPECT_GT(run.report().regrids, 0);
  EXPECT_LT(run.report().cells, 16 * 16 * 16 + 32 * 32 * 32);
  double worst = 0;
  run.for_each(
      "phi", [&](Vec3 x, double v) { worst = std::max(worst, std::abs(v - radial(x, 0.15))); }, 1);
  const double everywhere = error_of(32, 0.15, "RK4");
  EXPECT_LT(worst, 1.05 * everywhere) << worst << ' ' << everywhere;
}

TEST(Wave, SameBitsOnBoxesBlocksAndThreads) {
  const std::string text = deck({12, 10, 9}, 0.2).text();
  const std::vector<double> whole = ExampleRun(wave, text).values("phi");
  for (const ExampleOptions& o :
       {ExampleOptions{{3, 1, 1}, 1, {}}, ExampleOptions{{2, 3, 2}, 2, {}},
        ExampleOptions{{1, 1, 1}, 2, {5, 3, 2}}})
    EXPECT_EQ(ExampleRun(wave, text, o).values("phi"), whole);
}

}  // namespace
}  // namespace sluice::examples::wave_test
