// Averages and covariances over planes: exact values, any ranks and boxes, sums with all digits.
#include "framework/analysis/average.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "framework/analysis/analysis_test_support.hpp"
#include "framework/analysis/sums.hpp"
#include "framework/archive/posix_file.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::average_test {
namespace {

namespace fs = std::filesystem;
using namespace analysis_test;
using testing::HasSubstr;

const AnalysedQuantity value{labels().value, 0, 1}, wind{labels().wind, 0, 3};

class Averages : public testing::Test {
 protected:
  // One sample of level 1, as if on so many ranks.
  void sample(const Level& level, int ranks, const AveragePlan& plan, const std::string& name) {
    AverageSampler sampler(level, plan);
    sampler.lay_out(level);
    take(sampler, level, ranks, 2);
    sampler.flush(folder_ / name);
  }
  std::string text(const std::string& name) const { return read_text(folder_ / name); }
  TemporaryFolder folder_;
};

// A value is i + 100 j: over i = 2 ... 9 its mean is 5.5 + 100 j.
TEST_F(Averages, MeansSumsAndWeightedMeans) {
  const Level level = fine_level({{{{2, 3, 0}, {10, 5, 1}}, 0, 0}});
  AveragePlan plan;
  plan.normal = 1;
  plan.averaged = {{value, Weighting::cells}, {wind, Weighting::none}};
  sample(level, 1, plan, "a");
  EXPECT_EQ(text("a/planeAverage/t00002/L-1/sampled_0"),
            "# Simulation time: 0.25\n# X Y Z sampled_0 nCells\n"
            "1 0.4375 0.5 305.5 8\n1 0.5625 0.5 405.5 8\n");
  EXPECT_THAT(text("a/planeAverage/t00002/L-1/sampled_wind_0"),
              HasSubstr("sampled_wind_0.z\n1 0.4375 0.5 2444 -5556 -13556\n"));
  // Sum of w q over sum of w with w = q: (mean^2 + variance) / mean, variance (64 - 1) / 12.
  plan.averaged = {{value, Weighting::mass}};
  plan.weight = value;
  sample(level, 1, plan, "b");
  EXPECT_THAT(text("b/planeAverage/t00002/L-1/sampled_0"),
              HasSubstr(" weight\n1 0.4375 0.5 305.51718494271688 2444\n"));
}

TEST_F(Averages, CovariancesOfAPlane) {
  const Level level = fine_level({{{{2, 3, 0}, {10, 5, 1}}, 0, 0}});
  AveragePlan plan;
  plan.normal = 1;
  plan.averaged = {{value, Weighting::cells}, {wind, Weighting::cells}};
  plan.velocity = AveragedQuantity{wind, Weighting::cells};
  sample(level, 1, plan, "a");
  const std::string root = "a/planarAveTurbFluxes/";
  for (const char* name : {"normalTurbStrss_0", "shearTurbStrss_0", "sampled_turbFlux_0"})
    EXPECT_THAT(text(root + "TurbFluxes/t00002/L-1/" + name),
                HasSubstr("nCells\n1 0.4375 0.5 5.25 5.25 5.25 8\n1 0.5625 0.5 5.25 5.25 5.25 8\n"))
        << name;
  EXPECT_THAT(text(root + "AvgQ/t00002/L-1/sampled_wind_0"), HasSubstr(" 305.5 -694.5 -1694.5 8"));
  EXPECT_FALSE(fs::exists(folder_ / (root + "TurbFluxes/t00002/L-1/sampled_wind_turbFlux_0")));
}

TEST_F(Averages, RanksAndBoxesDoNotShow) {
  const Level whole = fine_level({{columns(2, 10), 0, 0}});
  const Level cut = cut_level();
  for (int normal = 0; normal < 3; ++normal) {
    AveragePlan plan;
    plan.normal = normal;
    plan.averaged = {{value, Weighting::mass}};
    plan.weight = value;
    plan.velocity = AveragedQuantity{wind, Weighting::mass};
    sample(whole, 1, plan, "whole");
    sample(cut, 3, plan, "cut");
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "whole")) {
      if (!entry.is_regular_file()) continue;
      ++files;
      EXPECT_EQ(read_text(folder_ / "cut" / fs::relative(entry.path(), folder_ / "whole")),
                read_text(entry.path()));
    }
    EXPECT_EQ(files, 5);
  }
}

ExactSum through_a_message(const ExactSum& a, const ExactSum& b) {
  std::vector<std::string> packed;
  for (const ExactSum* s : {&a, &b}) {
    std::vector<double> numbers;
    pack_sum(*s, numbers);
    packed.emplace_back(reinterpret_cast<const char*>(numbers.data()),
                        numbers.size() * sizeof(double));
  }
  RankNumbers numbers(packed);
  return take_sum(numbers);
}

TEST(AnalysisSums, PackedSumsAreTheSums) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  for (const std::vector<double>& values : {std::vector<double>{},
                                            {1.5},
                                            {-1.5},
                                            {-tiny},
                                            {1e300, tiny},
                                            {-1e300, tiny},
                                            {-3, 2},
                                            {std::numeric_limits<double>::infinity(), -1},
                                            {-std::numeric_limits<double>::infinity()},
                                            {std::nan("")}}) {
    ExactSum a, b, both;
    for (const double v : values) a.add(v);
    b.add(-0.125);
    both.merge(a);
    both.merge(b);
    EXPECT_EQ(through_a_message(a, b), both);
    EXPECT_EQ(through_a_message(b, a), both);
  }
  ExactSum few;
  few.add(-7);
  std::vector<double> numbers;
  pack_sum(few, numbers);
  EXPECT_LE(numbers.size(), 4u) << "only words that hold something";
}

// A variance of 1e-16 about a mean of 1e4: 24 digits below the squares.
TEST(AnalysisSums, PairsOfDoublesKeepSmallVariances) {
  ExactSum sum, squares;
  const double step = std::ldexp(1.0, -27);
  double mean = 0;
  for (int i = 0; i < 4; ++i) {
    const double x = 8192 + step * i;
    mean += x / 4;
    sum.add(x);
    const Double2 p = product(x, x);
    squares.add(p.high);
    squares.add(p.low);
  }
  const Double2 m = as_double2(mean);
  const Double2 moment =
      value2(squares) - m * value2(sum) - m * value2(sum) + as_double2(4.0) * (m * m);
  EXPECT_EQ((moment.high + moment.low) / 4, 1.25 * step * step);
}

}  // namespace
}  // namespace sluice::average_test
