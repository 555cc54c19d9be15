// Words of decks that have no effect, or none here: what is told of each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mpm/test_support/solid_deck.hpp"

namespace sluice::mpm::idle_words_test {
namespace {

using ::testing::HasSubstr;

constexpr const char* zone =
    "<cohesive_zone><cz_filename>none.txt</cz_filename><sig_max>1</sig_max><tau_max>1</tau_max>"
    "<delta_n>1</delta_n><delta_t>1</delta_t></cohesive_zone>";

TEST(IdleWords, ACohesiveZoneThatNothingSwitchesOnIsTold) {
  SolidDeck deck;
  deck.contacts = zone;
  const char* told = "warning: <cohesive_zone> has no effect without <use_cohesive_zones> true";
  EXPECT_THAT(read_solids(deck).text, HasSubstr(told));
  deck.flags = "<use_cohesive_zones>false</use_cohesive_zones>";
  const ReadDeck off = read_solids(deck);
  EXPECT_THAT(off.text, HasSubstr(told));
  EXPECT_TRUE(off.solids.cohesive_zones.empty());
  deck.flags = "<use_cohesive_zones>true</use_cohesive_zones>";
  EXPECT_THAT(read_solids(deck).text, ::testing::Not(HasSubstr(told)));
}

// A choice for mixtures with fluids: told where it is true, since solids have their own pressure.
TEST(IdleWords, EquationsOfStateForSharedPressures) {
  const auto said = [](const std::string& value) {
    SolidDeck deck;
    deck.further =
        "<material><density>1000</density><constitutive_model type='comp_neo_hook'>"
        "<bulk_modulus>1e6</bulk_modulus><shear_modulus>5e5</shear_modulus><useModifiedEOS>" +
        value +
        "</useModifiedEOS></constitutive_model><thermal_conductivity>1</thermal_conductivity>"
        "<specific_heat>5</specific_heat></material>";
    return read_solids(deck).text;
  };
  EXPECT_EQ(said("false"), "");
  EXPECT_THAT(said("true"), HasSubstr("warning: <useModifiedEOS> true has no effect"));
  EXPECT_THAT(said("perhaps"), HasSubstr("error"));
}

TEST(IdleWords, InterpolationBetweenLevels) {
  const auto said = [](const std::string& value) {
    SolidDeck deck;
    deck.blocks = "<AMR><MPM><CFI_interpolator>" + value + "</CFI_interpolator></MPM></AMR>";
    return read_solids(deck).text;
  };
  for (const char* word : {"linear", "gimp"})
    EXPECT_THAT(said(word), HasSubstr("warning: <CFI_interpolator> has no effect"));
  EXPECT_THAT(said("cubic"), HasSubstr("error"));
}

}  // namespace
}  // namespace sluice::mpm::idle_words_test
