// Error bars from errors of known order.
#include "app/accuracy/error_bar.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "app/accuracy/deck_ladder.hpp"
#include "app/accuracy/quantity.hpp"

namespace sluice::error_bar_test {
namespace {

// f_h = f + h^p, at h = 1, r and r^2.
ErrorBar bar_of_order(double p, double ratio) {
  const double middle = std::pow(ratio, p), coarse = std::pow(ratio, 2 * p);
  return error_bar(coarse - middle, middle - 1, ratio);
}

TEST(ErrorBar, IsAFixedMultipleOfAnErrorOfOneOrder) {
  for (const double p : {0.7, 1.0, 1.5, 1.9})
    for (const double ratio : {2.0, 1.5}) {
      const ErrorBar found = bar_of_order(p, ratio);
      EXPECT_NEAR(found.order.value(), p, 1e-12);
      EXPECT_NEAR(found.bar, 1.25, 1e-12);
      EXPECT_NEAR(found.at_spacing(4), 1.25 * std::pow(4, p), 1e-9);
      EXPECT_FALSE(found.diverges);
    }
}

TEST(ErrorBar, OrdersThatNoSchemeHasAreNotTrusted) {
  const ErrorBar lucky = bar_of_order(4, 2);
  EXPECT_GT(lucky.bar, 2 * 1.25) << "the true error is 1, order 4 may be chance";
  const ErrorBar slow = bar_of_order(.2, 2);
  EXPECT_EQ(slow.used_order(), .5);
  const ErrorBar diverging = error_bar(1, 2, 2);
  EXPECT_TRUE(diverging.diverges);
  EXPECT_GT(diverging.bar, 2);
  EXPECT_EQ(error_bar(1, 0, 2).bar, 0);
}

TEST(History, DifferencesAreMeansOverTime) {
  // a = t, b = t + 0.5 at other times, over [0, 2] and [0, 1.5].
  const History a{{0, 1, 2}, {{0, 1, 2}}}, b{{0, .75, 1.5}, {{.5, 1.25, 2}}};
  const MeanDifference d = mean_difference(a, b);
  EXPECT_NEAR(d.difference, .5, 1e-14);
  EXPECT_NEAR(d.size, 1.25, 1e-14);
}

TEST(Ladder, CoarseRunsAreUsedWhereTheyHaveEnoughCells) {
  EXPECT_EQ(factors_for(100), (std::vector<double>{.25, .5, 1}));
  EXPECT_EQ(factors_for(20), (std::vector<double>{.5, 1, 2}));
  EXPECT_EQ(factors_for(10), (std::vector<double>{1, 2, 4}));
}

}  // namespace
}  // namespace sluice::error_bar_test
