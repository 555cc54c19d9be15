// Formulas against the same expressions in C++, and where a bad one is said to be bad.
#include "framework/scene/formula.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/base/error.hpp"

namespace sluice::formula_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double pi = std::numbers::pi;

double value(const std::string& text, Vec3 p) {
  return Formula(text)(p);
}

TEST(Formula, EvaluatesWhatInitialStatesNeed) {
  const Vec3 p{0.3, -0.7, 2};
  EXPECT_DOUBLE_EQ(value("1+0.2*sin(2*pi*x)", p), 1 + 0.2 * std::sin(2 * pi * p.x));
  EXPECT_DOUBLE_EQ(value("exp(-(x^2+y^2)/0.1)", p), std::exp(-(0.09 + 0.49) / 0.1));
  EXPECT_DOUBLE_EQ(value("x < 0.5 ? 1 : 0.125", p), 1);
  EXPECT_DOUBLE_EQ(value("x >= 0.5 || y < 0 && z == 2 ? 4 : 5", p), 4);
  EXPECT_DOUBLE_EQ(value("min(x, y, z) + max(x, z)", p), -0.7 + 2);
  EXPECT_DOUBLE_EQ(value("sqrt(abs(y)) * tanh(z) + cos(x)", p),
                   std::sqrt(0.7) * std::tanh(2.0) + std::cos(0.3));
  EXPECT_DOUBLE_EQ(value("floor(y) + ceil(x) + log(e)", p), -1 + 1 + 1);
  EXPECT_DOUBLE_EQ(value("-2^2", p), -4);
  EXPECT_DOUBLE_EQ(value("1e-3*x", p), 3e-4);
  EXPECT_DOUBLE_EQ(value("x != y", p), 1);
  EXPECT_DOUBLE_EQ(value("x <= y", p), 0);
}

TEST(Formula, KnowsNamedConstants) {
  EXPECT_DOUBLE_EQ(Formula("gamma*x", {{"gamma", 1.4}})({2, 0, 0}), 2.8);
}

TEST(Formula, CanBeMoved) {
  Formula a("x+y");
  const Formula b = std::move(a);
  EXPECT_DOUBLE_EQ(b({1, 2, 0}), 3);
  EXPECT_EQ(b.text(), "x+y");
}

TEST(Formula, FaultsNameTheirPlace) {
  EXPECT_THAT([] { Formula("1 + foo*x"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("'foo' is not a variable"),
                                              HasSubstr("character 5\n  1 + foo*x\n      ^"))));
  EXPECT_THAT([] { Formula("sin(x"); }, ThrowsMessage<InputError>(HasSubstr("sin(x")));
  EXPECT_THAT([] { Formula("x +"); }, ThrowsMessage<InputError>(HasSubstr("ends too early")));
  EXPECT_THAT([] { Formula(" "); }, ThrowsMessage<InputError>(HasSubstr("no expression")));
  EXPECT_THAT([] { Formula("x, y"); }, ThrowsMessage<InputError>(HasSubstr("2 values")));
  EXPECT_THAT([] { Formula("x = 3"); },
              ThrowsMessage<InputError>(HasSubstr("write '==' at character 3")));
  EXPECT_THAT([] { Formula("1 2"); }, ThrowsMessage<InputError>(HasSubstr("character 3")));
}

}  // namespace
}  // namespace sluice::formula_test
