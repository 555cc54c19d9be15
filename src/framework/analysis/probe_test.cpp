// Point probes: linear fields are met exactly, by whatever boxes and levels.
#include "framework/analysis/probe.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/analysis/analysis_test_support.hpp"
#include "framework/archive/posix_file.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::probe_test {
namespace {

using namespace analysis_test;
using testing::ElementsAre;

AnalysedPoint point(const char* name, Vec3 position) {
  AnalysedPoint p;
  p.name = name;
  p.position = position;
  return p;
}

TEST(ProbeStencils, AtCentresEndsAndAcrossPeriodicEnds) {
  Level level = fine_level({});
  const ProbeStencil centre = stencil_around({0.1875, 0.4375, 0.5}, level);
  EXPECT_THAT(centre.cells, ElementsAre(IntVec3{1, 3, 0}));
  const ProbeStencil corner = stencil_around({2, 0, 0.2}, level);
  EXPECT_THAT(corner.cells, ElementsAre(IntVec3{15, 0, 0}));
  EXPECT_TRUE(stencil_around({2.1, 0, 0}, level).cells.empty());
  level.periodic = {true, false, false};
  const ProbeStencil across = stencil_around({0, 0.0625, 0.2}, level);
  EXPECT_THAT(across.cells, ElementsAre(IntVec3{15, 0, 0}, IntVec3{0, 0, 0}));
  EXPECT_THAT(across.weights, ElementsAre(0.5, 0.5));
}

// A value is i + 100 j: linear in place. Level 1 counts where it holds the cells.
TEST(Probes, TakeTheFinestLevelThatHoldsTheirCells) {
  TemporaryFolder folder;
  const std::vector<AnalysedQuantity> quantities = {{labels().value, 0, 1}, {labels().wind, 0, 3}};
  Level coarse = fine_level({{columns(0, 16), 0, 0}});
  coarse.index = 0;
  for (const int ranks : {1, 3}) {
    const Level fine = ranks == 1 ? fine_level({{columns(4, 8), 0, 0}})
                                  : fine_level({{columns(6, 8), 2, 0}, {columns(4, 6), 1, 1}});
    const auto probes = std::make_shared<Probes>(
        std::vector<AnalysedPoint>{point("in", {0.75, 0.5, 0.5}), point("edge", {1.0, 0.5, 0.5})},
        quantities);
    ProbeSampler lower(coarse, quantities, probes), upper(fine, quantities, probes);
    for (int step = 1; step <= 2; ++step) {
      for (const auto& [sampler, level] :
           {std::pair<ProbeSampler*, const Level*>{&lower, &coarse}, {&upper, &fine}}) {
        sampler->lay_out(*level);
        take(*sampler, *level, ranks, step);
      }
      lower.end_sample(step, 0.125 * step);
      upper.end_sample(step, 0.125 * step);
    }
    const std::string name = std::to_string(ranks);
    lower.flush(folder / name);
    upper.flush(folder / name);
    EXPECT_EQ(read_text(folder / name / "points" / "in"),
              "# at 0.75 0.5 0.5\n"
              "# Timestep Time Level sampled_0 sampled_wind_0.x sampled_wind_0.y sampled_wind_0.z\n"
              "1 0.125 1 355.5 355.5 -644.5 -1644.5\n2 0.25 1 355.5 355.5 -644.5 -1644.5\n");
    EXPECT_THAT(read_text(folder / name / "points" / "edge"),
                testing::HasSubstr("\n2 0.25 0 357.5 357.5 -642.5 -1642.5\n"));
  }
}

}  // namespace
}  // namespace sluice::probe_test
