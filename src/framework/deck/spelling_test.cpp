// Other spellings of names and words, and what stands in an element in place of an attribute.
#include "framework/deck/spelling.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/deck/load_deck.hpp"

namespace sluice::spelling_test {
namespace {

using ::testing::HasSubstr;

Schema small_schema() {
  Schema schema;
  schema.root.children = {
      tag("MPM", "solids")
          .with_children(
              {tag("withColor", "colours").boolean(),
               tag("max_Timesteps", "steps").integer().alias("max_Timestep"),
               tag("model", "a choice")
                   .multiple()
                   .attribute(attribute("type", "which")
                                  .once()
                                  .words({"Arenisca3", "vonMises", "comp_neo_hook", "x-", "x+"}))}),
      tag("Run", "who runs").attribute(attribute("type", "which").once().words({"ice", "mpm"}))};
  return schema;
}

Deck load(const std::string& inside) {
  return load_deck_text("<Uintah_specification>" + inside + "</Uintah_specification>", "s.ups", {},
                        small_schema());
}

std::string told(const Deck& deck) {
  std::string text;
  for (const Fault& fault : deck.faults) text += to_string(fault) + '\n';
  return text;
}

TEST(Spelling, CapitalsAndUnderscoresDoNotCount) {
  const Deck deck = load("<MPM><with_color>true</with_color><max_timestep>5</max_timestep></MPM>");
  EXPECT_TRUE(deck.good()) << told(deck);
  EXPECT_EQ(deck.root->find("MPM/withColor")->text, "true");
  EXPECT_EQ(deck.root->find("MPM/max_Timesteps")->text, "5");
  EXPECT_THAT(told(deck), HasSubstr("<with_color> is an old spelling; read as <withColor>"));
  EXPECT_EQ(deck.faults.size(), 2u);
}

TEST(Spelling, UnderscoresStandForCapitals) {
  for (const auto& [name, snake] :
       {std::pair{"keepPressBCNormalToSurface", "keep_press_bc_normal_to_surface"},
        std::pair{"RunMMSProblem", "run_mms_problem"}, std::pair{"max_Timesteps", "max_timesteps"},
        std::pair{"withColor", "with_color"}, std::pair{"Arenisca3", "arenisca3"}}) {
    EXPECT_EQ(with_underscores(name), snake);
    EXPECT_TRUE(is_spelling_of(snake, name));
  }
  EXPECT_FALSE(is_spelling_of("max_iterations", "maxiterations"));
  EXPECT_TRUE(is_spelling_of("run_MMS_problem", "RunMMSProblem"));
}

TEST(Spelling, BesideTheNameItselfIsAFault) {
  const Deck deck = load("<MPM><withColor>true</withColor><with_color>true</with_color></MPM>");
  EXPECT_FALSE(deck.good());
  EXPECT_THAT(told(deck), HasSubstr("<with_color> does not exist in <MPM>"));
}

TEST(Spelling, OfWordsAndAttributes) {
  const Deck deck = load("<MPM><model Type='arenisca3'/></MPM>");
  EXPECT_TRUE(deck.good()) << told(deck);
  EXPECT_EQ(deck.root->find("MPM/model")->attribute("type"), "Arenisca3");
  EXPECT_THAT(told(deck), HasSubstr("'arenisca3' is an old spelling; read as 'Arenisca3'"));
  EXPECT_EQ(load("<MPM><model type='von_mises'/></MPM>").root->find("MPM/model")->attribute("type"),
            "vonMises");
  EXPECT_FALSE(load("<MPM><model type='comp_neohook'/></MPM>").good());
  EXPECT_FALSE(load("<MPM><model type='x'/></MPM>").good());  // of x- or x+
  EXPECT_FALSE(load("<MPM><model type='arenisca_3'/></MPM>").good());
}

TEST(Spelling, AnElementMayStandForAnAttribute) {
  const Deck deck = load("<Run><type>mpm</type></Run>");
  EXPECT_TRUE(deck.good()) << told(deck);
  EXPECT_EQ(deck.root->child("Run")->attribute("type"), "mpm");
  EXPECT_THAT(told(deck), HasSubstr("<type> in <Run> is obsolete; read as its attribute type"));
  EXPECT_FALSE(load("<Run type='mpm'><type>ice</type></Run>").good());
}

TEST(Spelling, OfAKindIsToldOnce) {
  const std::string model = "<model type='VonMises'/>";
  const Deck deck = load("<MPM>" + model + model + model + "</MPM>");
  EXPECT_TRUE(deck.good()) << told(deck);
  ASSERT_EQ(deck.faults.size(), 1u) << told(deck);
  EXPECT_THAT(told(deck), HasSubstr("here and at 2 other places"));
}

}  // namespace
}  // namespace sluice::spelling_test
