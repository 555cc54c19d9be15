// Planes: which cells they pass, and files that show neither ranks nor boxes.
#include "framework/analysis/plane.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/analysis/analysis_test_support.hpp"
#include "framework/archive/posix_file.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::plane_test {
namespace {

namespace fs = std::filesystem;
using namespace analysis_test;
using testing::HasSubstr;

AnalysedPlane rectangle(Vec3 start, Vec3 end, int normal) {
  AnalysedPlane p;
  p.name = "cut";
  p.start = start;
  p.end = end;
  p.normal = normal;
  return p;
}

// 8 x 4 x 2 cells of 1/2, 1/4 and 1, from the corner (-1, 0, 0) on.
Level block() {
  Level level;
  level.anchor = {-1, 0, 0};
  level.spacing = {0.5, 0.25, 1};
  level.domain = {{0, 0, 0}, {8, 4, 2}};
  level.boxes = {{level.domain, 0, 0}};
  return level;
}

TEST(PlaneCells, CellsThatARectanglePasses) {
  const Level level = block();
  const auto cells = [&](Vec3 a, Vec3 b, int normal) {
    return cells_in_plane(rectangle(a, b, normal), level);
  };
  EXPECT_EQ(cells({-1, 0, 0.5}, {3, 1, 0.5}, 2).cells, (IndexBox{{0, 0, 0}, {8, 4, 1}}));
  EXPECT_FALSE(cells({-1, 0, 0.5}, {3, 1, 0.5}, 2).clipped);
  // On a face between cells: the upper ones; at the high end of the domain: the last.
  EXPECT_EQ(cells({-1, 0, 1}, {3, 1, 1}, 2).cells.lower.z, 1);
  EXPECT_EQ(cells({-1, 0, 2}, {3, 1, 2}, 2).cells, (IndexBox{{0, 0, 1}, {8, 4, 2}}));
  // A part of it: cells that the rectangle reaches into, not those it only touches.
  EXPECT_EQ(cells({-0.4, 0.25, 0}, {0.5, 0.25, 2}, 1).cells, (IndexBox{{1, 1, 0}, {3, 2, 2}}));
  EXPECT_EQ(cells({0, 0.3, 0.2}, {0, 0.3000001, 0.7}, 0).cells, (IndexBox{{2, 1, 0}, {3, 2, 1}}));
}

TEST(PlaneCells, OutsideOfTheDomainThereAreNone) {
  const Level level = block();
  const PlaneCells over = cells_in_plane(rectangle({2, 0.5, 0}, {5, 0.5, 2}, 1), level);
  EXPECT_TRUE(over.clipped);
  EXPECT_EQ(over.cells, (IndexBox{{6, 2, 0}, {8, 3, 2}}));
  EXPECT_TRUE(cells_in_plane(rectangle({-1, 1.5, 0}, {3, 1.5, 2}, 1), level).cells.empty());
  EXPECT_TRUE(cells_in_plane(rectangle({4, 0.5, 0}, {5, 0.5, 2}, 1), level).cells.empty());
}

class Planes : public testing::Test {
 protected:
  std::string text(const std::string& name) const { return read_text(folder_ / name); }
  TemporaryFolder folder_;
};

TEST_F(Planes, EveryValueStandsAtItsPlace) {
  const Level level = fine_level({{columns(4, 6), 0, 0}, {columns(6, 8), 0, 1}});
  PlaneSampler sampler(level,
                       {{labels().value, 0, 1}, {labels().flux, 0, 1}, {labels().wind, 0, 3}},
                       {{"cut", {{2, 3, 0}, {7, 5, 1}}}});
  sampler.lay_out(level);
  EXPECT_EQ(sampler.lines(), 3u * 2 * 3);
  take(sampler, level, 1, 4);
  sampler.flush(folder_.path());
  EXPECT_EQ(text("cut/t00004/L-1/sampled_0.dat"),
            "# Simulation time: 0.5\n# X Y Z sampled_0\n"
            "0.5625 0.4375 0.5 304\n0.6875 0.4375 0.5 305\n0.8125 0.4375 0.5 306\n"
            "0.5625 0.5625 0.5 404\n0.6875 0.5625 0.5 405\n0.8125 0.5625 0.5 406\n");
  // Faces: one more than cells, at their own places.
  EXPECT_THAT(text("cut/t00004/L-1/sampled_flux_0.dat"),
              HasSubstr("\n0.5 0.4375 0.5 304\n0.625 0.4375 0.5 305\n0.75 0.4375 0.5 306\n"
                        "0.875 0.4375 0.5 307\n0.5 0.5625 0.5 404\n"));
  EXPECT_THAT(text("cut/t00004/L-1/sampled_wind_0.dat"),
              HasSubstr("# X Y Z sampled_wind_0.x sampled_wind_0.y sampled_wind_0.z\n"
                        "0.5625 0.4375 0.5 304 -696 -1696\n"));
}

TEST_F(Planes, RanksAndBoxesDoNotShow) {
  const Level whole = fine_level({{columns(2, 10), 0, 0}});
  const Level cut = cut_level();
  for (const auto& [level, ranks, name] : {std::tuple{whole, 1, "whole"}, {cut, 3, "cut"}}) {
    PlaneSampler sampler(level, {{labels().flux, 0, 1}, {labels().wind, 0, 3}},
                         {{"p", {{0, 0, 0}, {16, 8, 1}}}});
    sampler.lay_out(level);
    take(sampler, level, ranks, 2);
    sampler.flush(folder_ / name);
  }
  for (const char* name : {"p/t00002/L-1/sampled_flux_0.dat", "p/t00002/L-1/sampled_wind_0.dat"})
    EXPECT_EQ(text(std::string("cut/") + name), text(std::string("whole/") + name));
}

TEST_F(Planes, ALevelWithoutCellsThereHasNoFile) {
  const Level away = fine_level({{columns(4, 6), 0, 0}}),
              here = fine_level({{columns(0, 2), 0, 0}});
  PlaneSampler sampler(away, {{labels().value, 0, 1}}, {{"cut", {{0, 0, 0}, {2, 8, 1}}}});
  int step = 0;
  for (const Level* level : {&away, &here}) {
    sampler.lay_out(*level);
    take(sampler, *level, 1, ++step);
  }
  sampler.flush(folder_.path());
  EXPECT_FALSE(fs::exists(folder_ / "cut/t00001"));
  EXPECT_TRUE(fs::exists(folder_ / "cut/t00002/L-1/sampled_0.dat"));
}

TEST_F(Planes, ARestartTakesOverTheSamplesBeforeIt) {
  const Level level = fine_level({{columns(0, 4), 0, 0}});
  const std::vector<SampledPlane> planes = {{"cut", {{0, 0, 0}, {2, 8, 1}}}};
  PlaneSampler first(level, {{labels().value, 0, 1}}, planes);
  first.lay_out(level);
  for (int step = 1; step <= 3; ++step) take(first, level, 1, step);
  first.flush(folder_ / "earlier");
  PlaneSampler second(level, {{labels().value, 0, 1}}, planes);
  second.adopt(folder_ / "earlier", folder_ / "later", 0.25);
  for (int step = 1; step <= 2; ++step) {
    const std::string name = "cut/t0000" + std::to_string(step) + "/L-1/sampled_0.dat";
    EXPECT_EQ(text("later/" + name), text("earlier/" + name));
  }
  EXPECT_FALSE(fs::exists(folder_ / "later/cut/t00003"));
}

}  // namespace
}  // namespace sluice::plane_test
