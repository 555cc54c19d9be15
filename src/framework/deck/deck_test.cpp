// The tree's accessors, and what it looks like as XML.
#include "framework/deck/deck.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "framework/base/error.hpp"

namespace sluice::deck_test {
namespace {

Deck sample() {
  return read_deck_text(
      "<Uintah_specification>\n"
      "  <Time><maxTime> 0.5 </maxTime><steps>12</steps><exact>true</exact></Time>\n"
      "  <Level id='a'><low>[0,1,2]</low><cells>[3,4,5]</cells></Level>\n"
      "  <Level id='b'><bad>1.2.3</bad></Level>\n"
      "</Uintah_specification>",
      "sample.ups");
}

TEST(DeckNode, FindsChildrenAndPaths) {
  const Deck deck = sample();
  ASSERT_TRUE(deck.good());
  const DeckNode& root = *deck.root;
  EXPECT_EQ(root.find("Time/maxTime")->text, "0.5");
  EXPECT_EQ(root.find("Time/nothing"), nullptr);
  EXPECT_EQ(root.find("Time/nothing/deeper"), nullptr);
  EXPECT_EQ(root.all("Level").size(), 2u);
  EXPECT_EQ(root.all("Level")[1]->attribute("id"), "b");
  EXPECT_EQ(root.child("Time")->attribute("id"), std::nullopt);
}

TEST(DeckNode, ReadsTypedValues) {
  const Deck deck = sample();
  const DeckNode& time = deck.root->need("Time");
  EXPECT_EQ(time.real("maxTime"), 0.5);
  EXPECT_EQ(time.integer("steps"), 12);
  EXPECT_TRUE(time.boolean("exact"));
  const DeckNode& level = deck.root->need("Level");
  EXPECT_EQ(level.vector("low"), (Vec3{0, 1, 2}));
  EXPECT_EQ(level.int_vector("cells"), (IntVec3{3, 4, 5}));
  EXPECT_EQ(level.string("cells"), "[3,4,5]");
}

TEST(DeckNode, NamesThePlaceOfAValueThatCannotBeRead) {
  const Deck deck = sample();
  try {
    deck.root->all("Level")[1]->real("bad");
    FAIL() << "1.2.3 was read";
  } catch (const InputError& problem) {
    EXPECT_STREQ(problem.what(), "sample.ups:4:17: <bad>: '1.2.3' is not a number");
  }
}

TEST(DeckNode, CallsForAMissingChildAreProgrammingErrors) {
  const Deck deck = sample();
  EXPECT_THROW(deck.root->need("Grid"), std::logic_error);
}

TEST(DeckNode, TellsWrittenFromDefaulted) {
  DeckNode parent;
  parent.children.push_back(std::make_unique<DeckNode>());
  parent.children.back()->name = "filled";
  parent.children.back()->defaulted = true;
  EXPECT_NE(parent.child("filled"), nullptr);
  EXPECT_FALSE(parent.has("filled"));
}

TEST(Deck, IsBadWithoutRootOrWithAnError) {
  EXPECT_FALSE(Deck{}.good());
  EXPECT_FALSE(read_deck_text("<Uintah_Include/>", "x").good());
  EXPECT_FALSE(read_deck_text("", "x").good());
  Deck deck = sample();
  deck.faults.push_back({Severity::warning, {}, "careful", ""});
  EXPECT_TRUE(deck.good());
  deck.faults.push_back({Severity::error, {}, "wrong", ""});
  EXPECT_FALSE(deck.good());
}

TEST(Deck, IsTheSameAfterBeingWrittenAndRead) {
  Deck deck = sample();
  deck.root->attributes.emplace_back("odd", "a<b & \"c\"");
  deck.root->child("Time")->child("maxTime")->text = "x < y & z > w";
  const std::string xml = to_xml(*deck.root);
  const Deck again = read_deck_text(xml, "again.ups");
  ASSERT_TRUE(again.good());
  EXPECT_EQ(to_xml(*again.root), xml);
  EXPECT_EQ(again.root->attribute("odd"), "a<b & \"c\"");
  EXPECT_EQ(again.root->find("Time/maxTime")->text, "x < y & z > w");
}

TEST(Fault, ReadsLikeACompilersMessage) {
  const Fault fault{Severity::warning, {"a.ups", 3, 7}, "odd", "try this"};
  EXPECT_EQ(to_string(fault), "a.ups:3:7: warning: odd (try this)");
  EXPECT_EQ(to_string(Location{"a.ups", 3, 0}), "a.ups:3");
  EXPECT_EQ(to_string(Location{"--set X=1", 0, 0}), "--set X=1");
}

}  // namespace
}  // namespace sluice::deck_test
