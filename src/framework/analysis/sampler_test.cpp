// Samples of one level: on ranks and boxes, while boxes come and go, across a restart.
#include "framework/analysis/sampler.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/analysis/analysis_test_support.hpp"
#include "framework/analysis/extremes.hpp"
#include "framework/analysis/points.hpp"
#include "framework/archive/posix_file.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::sampler_test {
namespace {

namespace fs = std::filesystem;
using namespace analysis_test;
using testing::HasSubstr;

class Samples : public testing::Test {
 protected:
  std::string text(const char* name) const { return read_text(folder_ / name); }
  bool exists(const std::string& name) const { return fs::exists(folder_ / name); }
  TemporaryFolder folder_;
};

// A line along the row j = 3, through all columns.
std::vector<SampledLine> row() {
  SampledLine line{"row", {}};
  for (int i = 0; i < 16; ++i) line.cells.push_back({i, 3, 0});
  return {line};
}

TEST_F(Samples, ExtremesOfALevelTakeAllItsFaces) {
  ExtremesSampler sampler(1, {{labels().value, 0, 1},
                              {labels().flux, 0, 1},
                              {labels().wind, 0, 3},
                              {labels().value, 0, 1}});
  EXPECT_EQ(sampler.lines(), 3u) << "named twice, taken once";
  take(sampler, fine_level({{columns(4, 8), 0, 0}}), 1, 4);
  sampler.flush(folder_.path());
  EXPECT_EQ(text("MinMax/L-1/sampled_0"),
            "# time[s] minimum maximum of sampled [1], material 0\n0.5 4 707\n");
  EXPECT_THAT(text("MinMax/L-1/sampled_flux_0"), HasSubstr("\n0.5 4 708\n"))
      << "the face where the level ends inside the domain";
  EXPECT_THAT(text("MinMax/L-1/sampled_wind_0"),
              HasSubstr("\n0.5 [4 -996 -1996] [707 -293 -1293]\n"));
}

TEST_F(Samples, OfALineAreThoseCellsThatTheLevelHolds) {
  const Level level = fine_level({{columns(4, 8), 0, 0}});
  PointsSampler sampler(level, {{labels().flux, 0, 1}, {labels().wind, 0, 3}}, row());
  EXPECT_EQ(sampler.lines(), 0u);
  sampler.lay_out(level);
  EXPECT_EQ(sampler.lines(), 4u);
  take(sampler, level, 1, 4);
  sampler.flush(folder_.path());
  EXPECT_FALSE(exists("row/L-1/i3_j3_k0"));
  EXPECT_FALSE(exists("row/L-1/i8_j3_k0"));
  EXPECT_EQ(text("row/L-1/i7_j3_k0"),
            "# X Y Z Timestep Time sampled_flux_0 sampled_wind_0.x sampled_wind_0.y "
            "sampled_wind_0.z\n0.9375 0.4375 0.5 4 0.5 307 307 -693 -1693\n");
}

TEST_F(Samples, RanksAndBoxesDoNotShow) {
  const Level whole = fine_level({{columns(2, 10), 0, 0}});
  const Level cut = cut_level();
  const std::vector<AnalysedQuantity> quantities = {{labels().flux, 0, 1}, {labels().wind, 0, 3}};
  for (const auto& [level, ranks, name] : {std::tuple{whole, 1, "whole"}, {cut, 3, "cut"}}) {
    PointsSampler points(level, quantities, row());
    points.lay_out(level);
    ExtremesSampler extremes(1, quantities);
    take(points, level, ranks, 2);
    take(extremes, level, ranks, 2);
    points.flush(folder_ / name);
    extremes.flush(folder_ / name);
  }
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "whole")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    EXPECT_EQ(read_text(folder_ / "cut" / fs::relative(entry.path(), folder_ / "whole")),
              read_text(entry.path()));
  }
  EXPECT_EQ(files, 8 + 2);
}

TEST_F(Samples, AFileGoesOnWhenItsCellComesBack) {
  const Level left = fine_level({{columns(0, 4), 0, 0}}),
              right = fine_level({{columns(2, 6), 0, 0}});
  const Level none = fine_level({});
  PointsSampler sampler(left, {{labels().value, 0, 1}}, row());
  int step = 0;
  for (const Level* level : {&left, &right, &none, &left}) {
    sampler.lay_out(*level);
    take(sampler, *level, 1, ++step);
    sampler.flush(folder_.path());
  }
  const std::string head = "# X Y Z Timestep Time sampled_0\n";
  EXPECT_EQ(text("row/L-1/i1_j3_k0"), head +
                                          "0.1875 0.4375 0.5 1 0.125 301\n"
                                          "0.1875 0.4375 0.5 4 0.5 301\n");
  EXPECT_EQ(text("row/L-1/i5_j3_k0"), head + "0.6875 0.4375 0.5 2 0.25 305\n");
  EXPECT_FALSE(exists("row/L-1/i6_j3_k0"));
}

TEST_F(Samples, ARestartTakesOverFilesOfCellsThatAreGone) {
  const Level left = fine_level({{columns(0, 4), 0, 0}}),
              right = fine_level({{columns(2, 6), 0, 0}});
  PointsSampler first(left, {{labels().value, 0, 1}}, row());
  int step = 0;
  for (const Level* level : {&left, &right, &right}) {
    first.lay_out(*level);
    take(first, *level, 1, ++step);
  }
  first.flush(folder_ / "earlier");

  // From the end of step 1: cell 5 had no sample then.
  PointsSampler second(left, {{labels().value, 0, 1}}, row());
  second.adopt(folder_ / "earlier", folder_ / "later", 0.125);
  EXPECT_EQ(text("later/row/L-1/i0_j3_k0"), text("earlier/row/L-1/i0_j3_k0"));
  EXPECT_FALSE(exists("later/row/L-1/i5_j3_k0"));
  second.lay_out(right);
  for (const int later : {2, 3}) take(second, right, 1, later);
  second.flush(folder_ / "later");
  for (int i = 0; i < 6; ++i) {
    const std::string name = "row/L-1/i" + std::to_string(i) + "_j3_k0";
    EXPECT_EQ(text(("later/" + name).c_str()), text(("earlier/" + name).c_str()));
  }
}

TEST(RankNumbers, MoreThanWasPackedIsAFault) {
  RankNumbers numbers({std::string(2 * sizeof(double), '\0'), {}});
  EXPECT_EQ(numbers.ranks(), 2);
  EXPECT_EQ(*numbers.take(0, 2), 0.0);
  EXPECT_THROW(numbers.take(0, 1), std::logic_error);
  EXPECT_THROW(numbers.take(1, 1), std::logic_error);
}

}  // namespace
}  // namespace sluice::sampler_test
