// What a plan says of the solids of a deck: choices that change how they are solved.
#include "mpm/effects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mpm/test_support/solid_deck.hpp"

namespace sluice::mpm::effects_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string reason(const std::string& flags) {
  SolidDeck deck;
  deck.flags = flags;
  const ReadDeck read = read_solids(deck);
  EXPECT_FALSE(any_error(read.faults)) << read.text;
  return effects_of(read.scene, read.solids)[0].reason;
}

TEST(EffectsOfSolids, NameEachChoiceOfTheScheme) {
  EXPECT_THAT(reason(""), Not(HasSubstr("transfer,")));
  for (const auto& [tag, says] :
       {std::pair("total_lagrangian", "total Lagrangian"),
        std::pair("artificial_viscosity", "artificial viscosity"),
        std::pair("do_contact_friction_heating", "heating by friction"),
        std::pair("DoGranularMPM", "grains with separate velocity fields"),
        std::pair("UseGradientEnhancedVelocityProjection", "gradient-enhanced velocities")}) {
    EXPECT_THAT(reason(fmt::format("<{0}>true</{0}>", tag)), HasSubstr(says));
    EXPECT_THAT(reason(fmt::format("<{0}>false</{0}>", tag)), Not(HasSubstr(says)));
  }
}

}  // namespace
}  // namespace sluice::mpm::effects_test
