// Error bars from errors of known order.
#include "app/accuracy/error_bar.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "app/accuracy/deck_ladder.hpp"
#include "app/accuracy/quantity.hpp"

namespace sluice::error_bar_test {
namespace {

// f_h = f + h^p, at h = 1, r, r^2, ...: so many differences.
ErrorBar bar_of_order(double p, double ratio, int differences = 3) {
  std::vector<double> d;
  for (int n = differences; n > 0; --n)
    d.push_back(std::pow(ratio, n * p) - std::pow(ratio, (n - 1) * p));
  return error_bar(d, ratio);
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
  const ErrorBar unconfirmed = bar_of_order(1.8, 2, 2);
  EXPECT_EQ(unconfirmed.used_order, 1) << "two differences: the order may be chance";
  EXPECT_GT(unconfirmed.bar, 2 * 1.25) << "the true error is 1";
  EXPECT_EQ(error_bar({9, 8, 2}, 2).used_order, 1) << "orders .2 and 2 do not confirm each other";
  EXPECT_EQ(bar_of_order(.2, 2).used_order, .5);
  const ErrorBar diverging = error_bar({1, 2}, 2);
  EXPECT_TRUE(diverging.diverges);
  EXPECT_GT(diverging.bar, 2);
  EXPECT_EQ(error_bar({1, 0}, 2).bar, 0);
}

TEST(History, DifferencesAreMeansOverTime) {
  // a = t, b = t + 0.5 at other times, over [0, 2] and [0, 1.5].
  const History a{{0, 1, 2}, {{0, 1, 2}}}, b{{0, .75, 1.5}, {{.5, 1.25, 2}}};
  const MeanDifference d = mean_difference(a, b);
  EXPECT_NEAR(d.difference, .5, 1e-14);
  EXPECT_NEAR(d.size, 1.25, 1e-14);
}

TEST(Ladder, CoarseRunsAreUsedWhereTheyHaveEnoughCells) {
  EXPECT_EQ(factors_for(100), (std::vector<double>{.125, .25, .5, 1}));
  EXPECT_EQ(factors_for(40), (std::vector<double>{.25, .5, 1, 2}));
  EXPECT_EQ(factors_for(20), (std::vector<double>{.5, 1, 2}));
  EXPECT_EQ(factors_for(10), (std::vector<double>{1, 2, 4}));
}

}  // namespace
}  // namespace sluice::error_bar_test
