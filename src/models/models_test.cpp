// The laws of models and the table that makes them known.
#include "models/models.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/deck/schema_check.hpp"
#include "models/deck/material_name.hpp"

namespace sluice::models::models_test {
namespace {

TEST(MassExchange, IsTheExponentialWhateverTheSteps) {
  MassExchange m;
  m.rate = 100;
  double left = 1, t = 0;
  for (const double dt : {1e-3, 2.5e-4, 0.0, 7e-3, 1e-9, 0.03}) {
    left *= 1 - m.share(t, dt);
    t += dt;
  }
  EXPECT_NEAR(left, std::exp(-100 * t), 4e-16);
  EXPECT_EQ(m.share(0, 1e6), 1.0);  // never more than there is
  EXPECT_EQ(m.share(0, 0), 0.0);
}

// A start inside a step: only the rest of the step counts.
TEST(MassExchange, StartsInsideAStep) {
  MassExchange m;
  m.rate = 2;
  m.when.start = 0.3;
  EXPECT_EQ(m.share(0.0, 0.25), 0.0);
  EXPECT_NEAR(m.share(0.25, 0.25), 1 - std::exp(-2 * 0.2), 1e-15);
  EXPECT_EQ(m.share(0.3, 0.25), -std::expm1(-0.5));
}

TEST(TimeWindow, OverlapsStepsByTheirCommonPart) {
  const TimeWindow w{1, 2};
  EXPECT_EQ(w.overlap(0, 1), 0);
  EXPECT_EQ(w.overlap(0.5, 1), 0.5);
  EXPECT_EQ(w.overlap(1.25, 0.5), 0.5);
  EXPECT_EQ(w.overlap(1.5, 1), 0.5);
  EXPECT_EQ(w.overlap(2, 1), 0);
  EXPECT_EQ(w.overlap(0, 4), 1);
  EXPECT_EQ(TimeWindow{}.overlap(3, 0.1), 0.1);
}

TEST(MaterialOfAModel, IsFoundByNameAndElseByIndex) {
  const std::vector<std::string> names{"gas", "1", ""};
  EXPECT_EQ(find_material("gas", names), 0);
  EXPECT_EQ(find_material("1", names), 1);
  EXPECT_EQ(find_material("2", names), 2);
  EXPECT_EQ(find_material("3", names), std::nullopt);
  EXPECT_EQ(find_material("", names), std::nullopt);
  EXPECT_EQ(find_material("water", names), std::nullopt);
}

TEST(ModelsTag, KnowsEveryTypeOfTheFormatOnce) {
  const TagSpec models = models_tag();
  ASSERT_EQ(models.children.size(), 1u);
  const TagSpec& model = models.children[0];
  ASSERT_EQ(model.attributes.size(), 1u);
  const ValueSpec& type = model.attributes[0].value;
  EXPECT_THAT(type.words, ::testing::IsSupersetOf({"Test", "mass_momentum_energy_src"}));
  EXPECT_EQ(type.words.size(), model.children.size());
  EXPECT_GE(type.words.size() + unsupported_words(type).size(), 23u);  // the format has 23
}

}  // namespace
}  // namespace sluice::models::models_test
