// The passes between reading and checking: obsolete tags, overrides, labels; then the whole.
#include "framework/deck/load_deck.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/error.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/schema_check.hpp"

namespace sluice::load_deck_test {
namespace {

using ::testing::HasSubstr;

// A small language of its own: <run> with a few tags of every kind.
Schema small_schema() {
  Schema schema;
  schema.add(tag("run", "the run")
                 .once()
                 .attribute(attribute("mode", "how").words({"fast", "exact"}).by_default("fast"))
                 .exactly_one({"steps", "time"})
                 .with_children({tag("steps", "number of steps").integer().at_least(1),
                                 tag("time", "length").real().above(0).alias("duration"),
                                 tag("name", "its name").text().by_default("unnamed"),
                                 tag("part", "a part")
                                     .multiple()
                                     .attribute(attribute("id", "its name").once().text()),
                                 tag("limits", "limits")
                                     .fill()
                                     .child(tag("most", "the most").real().by_default("7"))}));
  return schema;
}

Deck load(const std::string& inside, const std::vector<std::string>& overrides = {}) {
  return load_deck_text("<Uintah_specification>" + inside + "</Uintah_specification>", "small.ups",
                        overrides, small_schema());
}

std::string messages(const Deck& deck) {
  std::string text;
  for (const Fault& fault : deck.faults) text += to_string(fault) + '\n';
  return text;
}

TEST(LoadDeck, FillsInDefaultsAndMarksThem) {
  const Deck deck = load("<run><steps>3</steps></run>");
  ASSERT_TRUE(deck.good()) << messages(deck);
  const DeckNode& run = deck.root->need("run");
  EXPECT_EQ(run.string("name"), "unnamed");
  EXPECT_FALSE(run.has("name"));
  EXPECT_EQ(run.need("limits").real("most"), 7.0);
  EXPECT_EQ(run.attribute("mode"), "fast");
  EXPECT_EQ(run.child("time"), nullptr);
}

TEST(LoadDeck, ReadsOtherSpellings) {
  const Deck deck = load("<run><duration>2.5</duration></run>");
  ASSERT_TRUE(deck.good()) << messages(deck);
  EXPECT_EQ(deck.root->need("run").real("time"), 2.5);
}

// Whoever adds a row need not know the list of what was refused before.
TEST(UnsupportedWords, AreWithoutThoseOfRows) {
  const TagSpec law = tag("law", "which one")
                          .words({"row"})
                          .spelling("Row", "row")
                          .not_built({"row", "Row", "other"});
  EXPECT_EQ(unsupported_words(law.value), std::vector<std::string>{"other"});
  for (std::string word : {"row", "Row"}) EXPECT_EQ(judge_value(law.value, word).problem, "");
  std::string other = "other";
  EXPECT_TRUE(judge_value(law.value, other).not_built);
}

TEST(LoadDeck, FindsAllFaultsInDocumentOrder) {
  const Deck deck =
      load("<run mode='slow'>\n<steps>0</steps>\n<stps>1</stps>\n<time>x</time></run>");
  ASSERT_EQ(deck.faults.size(), 5u) << messages(deck);
  EXPECT_THAT(deck.faults[0].message, HasSubstr("'slow'"));
  EXPECT_THAT(deck.faults[1].message, HasSubstr("<steps>: '0' is out of range"));
  EXPECT_THAT(deck.faults[2].message, HasSubstr("<stps> does not exist in <run>"));
  EXPECT_THAT(deck.faults[2].suggestion, HasSubstr("'steps'"));
  EXPECT_THAT(deck.faults[3].message, HasSubstr("<time>: 'x'"));
  EXPECT_THAT(deck.faults[4].message, HasSubstr("exclude each other"));
}

TEST(Override, SetsCreatesAndDeletes) {
  const std::string inside = "<run><steps>3</steps><part id='a'/><part id='b'/></run>";
  EXPECT_EQ(load(inside, {"run/steps=9"}).root->find("run/steps")->text, "9");
  const Deck created = load(inside, {"run/limits/most=2"});
  EXPECT_EQ(created.root->find("run/limits/most")->text, "2");
  EXPECT_EQ(load(inside, {"/run/@mode=exact"}).root->child("run")->attribute("mode"), "exact");
  EXPECT_EQ(load(inside, {"run/part[1]="}).root->child("run")->all("part").size(), 1u);
  EXPECT_TRUE(load(inside, {"run/name="}).good());
  const Deck selected = load(inside, {"run/part[@id=b]/@id=c"});
  EXPECT_EQ(selected.root->child("run")->all("part")[1]->attribute("id"), "c");
}

TEST(Override, OfOneChoiceRemovesTheOther) {
  const Deck deck = load("<run><steps>3</steps></run>", {"run/duration=4"});
  ASSERT_TRUE(deck.good()) << messages(deck);
  EXPECT_EQ(deck.root->find("run/time")->text, "4");
  EXPECT_EQ(deck.root->find("run/steps"), nullptr);
}

TEST(Override, ActsInTheGivenOrder) {
  const Deck deck = load("<run><steps>3</steps></run>", {"run/steps=4", "run/steps=5"});
  EXPECT_EQ(deck.root->find("run/steps")->text, "5");
}

TEST(Override, NamesItselfWhenItsValueIsBad) {
  const Deck deck = load("<run><steps>3</steps></run>", {"run/steps=many"});
  EXPECT_THAT(messages(deck), HasSubstr("--set run/steps=many: error: <steps>: 'many' is not"));
}

TEST(Override, RefusesPathsThatLeadNowhere) {
  const std::string inside = "<run><steps>3</steps><part id='a'/><part id='b'/></run>";
  const auto said = [&](const char* text) { return messages(load(inside, {text})); };
  EXPECT_THAT(said("run/stps=1"), HasSubstr("did you mean 'steps'?"));
  EXPECT_THAT(said("run/part/@id=x"), HasSubstr("choose one with part[1]"));
  EXPECT_THAT(said("run/part[3]/@id=x"), HasSubstr("it has 2"));
  EXPECT_THAT(said("run/part[@id=z]/@id=x"), HasSubstr("no <part> in <run> has id=\"z\""));
  EXPECT_THAT(said("run/part[0]/@id=x"), HasSubstr("number from 1"));
  EXPECT_THAT(said("run/steps/@unit=x"), HasSubstr("has no attribute 'unit'"));
  EXPECT_THAT(said("run//steps=1"), HasSubstr("a tag name is missing"));
  EXPECT_THAT(said("steps"), HasSubstr("there is no '='"));
}

Deck grid(const std::vector<std::string>& overrides, const std::string& level) {
  Deck deck = read_deck_text(
      "<Uintah_specification><Grid><Level>" + level + "</Level></Grid></Uintah_specification>",
      "grid.ups");
  Schema schema;
  schema.add(
      tag("Grid", "g")
          .child(tag("Level", "l")
                     .multiple()
                     .with_children(
                         {tag("spacing", "s").vector(),
                          tag("Box", "b").multiple().child(tag("resolution", "r").int_vector())})));
  for (const std::string& text : overrides) {
    apply_override(*deck.root, text, schema, deck.faults);
  }
  return deck;
}

TEST(Override, ResolutionTakesThePlaceOfSpacingAndTheOtherWayRound) {
  const Deck fine = grid({"Grid/Level/Box/resolution=[8,1,1]"}, "<spacing>[1,1,1]</spacing><Box/>");
  EXPECT_EQ(fine.root->find("Grid/Level/spacing"), nullptr);
  EXPECT_EQ(fine.root->find("Grid/Level/Box/resolution")->text, "[8,1,1]");
  const Deck spaced = grid({"Grid/Level/spacing=[2,2,2]"},
                           "<Box><resolution>[4,4,4]</resolution></Box><Box><resolution>[1,1,1]"
                           "</resolution></Box>");
  EXPECT_EQ(spaced.root->find("Grid/Level/spacing")->text, "[2,2,2]");
  for (const DeckNode* box : spaced.root->find("Grid/Level")->all("Box")) {
    EXPECT_TRUE(box->children.empty());
  }
}

// <steps> is not told to be missing beside <stps>, which most likely means it.
TEST(LoadDeck, TellsAMisspeltTagOnce) {
  const std::string said = messages(load("<run><stps>3</stps></run>"));
  EXPECT_THAT(said, HasSubstr("did you mean 'steps'?"));
  EXPECT_EQ(said.find("needs"), std::string::npos) << said;
}

TEST(Override, EndOfAPathIsEnoughWhereItMeansOnePlace) {
  const std::string inside = "<run><steps>3</steps><part id='a'/><part id='b'/></run>";
  EXPECT_EQ(load(inside, {"steps=9"}).root->find("run/steps")->text, "9");
  EXPECT_EQ(load(inside, {"part[@id=b]/@id=c"}).root->child("run")->all("part")[1]->attribute("id"),
            "c");
  // Not in the deck: the place that the schema has.
  EXPECT_EQ(load(inside, {"most=2"}).root->find("run/limits/most")->text, "2");
  const auto said = [&](const char* text) { return messages(load(inside, {text})); };
  EXPECT_THAT(said("stps=1"), HasSubstr("no deck has a tag 'stps'"));
  EXPECT_THAT(said("stps=1"), HasSubstr("did you mean 'steps'?"));
  EXPECT_THAT(said("part/@id=x"), HasSubstr("choose one with part[1]"));
}

TEST(Override, ShortPathWithSeveralMeaningsListsThem) {
  const std::string boxes =
      "<Box><resolution>[4,4,4]</resolution></Box><Box><resolution>[1,1,1]</resolution></Box>";
  const Deck two = grid({"resolution=[8,1,1]"}, boxes);
  EXPECT_THAT(messages(two), HasSubstr("'resolution' means 2 places of this deck"));
  EXPECT_THAT(messages(two), HasSubstr("Grid/Level/Box[1]/resolution, Grid/Level/Box[2]/resolu"));
  const Deck second = grid({"Box[2]/resolution=[8,1,1]"}, boxes);
  EXPECT_EQ(second.root->find("Grid/Level")->all("Box")[1]->child("resolution")->text, "[8,1,1]");
}

TEST(Override, AdditionPutsTagsBehindTheOthers) {
  const std::string inside = "<run><steps>3</steps><part id='a'/></run>";
  const Deck deck = load(inside, {addition("run=<part id='b'/><part id='c'/>")});
  ASSERT_TRUE(deck.good()) << messages(deck);
  ASSERT_EQ(deck.root->child("run")->all("part").size(), 3u);
  EXPECT_EQ(deck.root->child("run")->all("part")[2]->attribute("id"), "c");
  // In order with the others, and checked as what is written in the deck.
  const Deck changed = load(inside, {addition("run=<part id='b'/>"), "part[2]/@id=d"});
  EXPECT_EQ(changed.root->child("run")->all("part")[1]->attribute("id"), "d");
  const auto said = [&](const char* text) { return messages(load(inside, {addition(text)})); };
  EXPECT_THAT(said("run=<prt/>"), HasSubstr("--add run:1:"));
  EXPECT_THAT(said("run=<prt/>"), HasSubstr("did you mean 'part'?"));
  EXPECT_THAT(said("run=<part"), HasSubstr("this is no XML"));
  EXPECT_THAT(said("run=part"), HasSubstr("there is no tag behind the '='"));
  EXPECT_THAT(said("run"), HasSubstr("there is no '='"));
}

struct Resolved {
  Deck deck;
  std::string xml, faults;
};

Resolved resolve_labels(const std::string& objects) {
  Resolved result;
  result.deck = read_deck_text(
      "<Uintah_specification><geom_object>" + objects + "</geom_object></Uintah_specification>",
      "pieces.ups");
  resolve_piece_labels(*result.deck.root, result.deck.faults);
  result.xml = to_xml(*result.deck.root);
  result.faults = messages(result.deck);
  return result;
}

TEST(PieceLabels, ReferencesBecomeCopies) {
  const Resolved r = resolve_labels(
      "<sphere label='ball'><origin>[0,0,0]</origin><radius>1</radius></sphere>"
      "<union><sphere label='ball'/><null/></union>");
  EXPECT_EQ(r.faults, "");
  EXPECT_EQ(r.deck.root->find("geom_object/union/sphere/radius")->text, "1");
  EXPECT_EQ(r.deck.root->find("geom_object/union/sphere")->attribute("label"), std::nullopt);
  EXPECT_EQ(r.deck.root->find("geom_object/sphere")->attribute("label"), "ball");
}

TEST(PieceLabels, ReferencesInsideReferencedPiecesAreFollowed) {
  const Resolved r = resolve_labels(
      "<union label='both'><box label='a'><min>[0,0,0]</min></box><box label='a'/></union>"
      "<union label='both'/>");
  EXPECT_EQ(r.faults, "");
  const auto unions = r.deck.root->child("geom_object")->all("union");
  ASSERT_EQ(unions[1]->children.size(), 2u);
  EXPECT_EQ(unions[1]->children[1]->string("min"), "[0,0,0]");
}

TEST(PieceLabels, FaultsAreNamed) {
  EXPECT_THAT(resolve_labels("<box label='nobody'/>").faults, HasSubstr("no piece has the label"));
  EXPECT_THAT(resolve_labels("<box label='a'><min>1</min></box><sphere label='a'/>").faults,
              HasSubstr("'a' is the label of a <box>"));
  EXPECT_THAT(
      resolve_labels("<box label='a'><min>1</min></box><box label='a'><min>2</min></box>").faults,
      HasSubstr("warning: label 'a' is already used by the piece at pieces.ups:1:"));
  EXPECT_THAT(resolve_labels("<box label='a'><min>1</min></box><box label='a'><min>2</min></box>"
                             "<box label='a'/>")
                  .faults,
              HasSubstr("error: 'a' is the label of two pieces, at pieces.ups:1:"));
  EXPECT_THAT(
      resolve_labels("<box label='a'><min>1</min></box><box label='a'><min>1</min></box>").faults,
      HasSubstr("warning: label 'a' repeats the piece"));
}

TEST(PieceLabels, ThatHoldThemselvesEnd) {
  const Resolved r = resolve_labels("<union label='u'><union label='u'/><null/></union>");
  EXPECT_THAT(r.faults, HasSubstr("endlessly"));
}

// Conditions of a second face of one place follow those of the first; other places stay.
TEST(SettleFaces, JoinsThoseOfOnePlace) {
  Deck deck = read_deck_text(
      "<Uintah_specification><Grid><BoundaryConditions>\n"
      "<Face side='x-'><BCType label='a'/></Face>\n"
      "<Face circle='x-' origin='0 0 0' radius='1'><BCType label='b'/></Face>\n"
      "<Face radius='1.0' circle=' x-' origin='0.0 0 0' name='hole'><BCType label='c'/></Face>\n"
      "<Face circle='x-' origin='0 0 0' radius='2'><BCType label='d'/></Face>\n"
      "<Face side='x-'><BCType label='e'/></Face>\n"
      "<Face/><Face/>"
      "</BoundaryConditions></Grid></Uintah_specification>",
      "faces.ups");
  settle_faces(*deck.root, deck.faults);
  const auto faces = deck.root->find("Grid/BoundaryConditions")->all("Face");
  ASSERT_EQ(faces.size(), 5u);
  const auto labels = [&](std::size_t face) {
    std::string text;
    for (const DeckNode* condition : faces[face]->all("BCType"))
      text += *condition->attribute("label");
    return text;
  };
  EXPECT_EQ(labels(0) + ' ' + labels(1) + ' ' + labels(2), "ae bc d");
  EXPECT_EQ(messages(deck),
            "faces.ups:4:1: warning: second <Face circle=\"x-\">; merged with the first at "
            "faces.ups:3:1 (write all conditions of a face in one <Face>)\n"
            "faces.ups:6:1: warning: second <Face side=\"x-\">; merged with the first at "
            "faces.ups:2:1 (write all conditions of a face in one <Face>)\n");
}

TEST(SettleFaces, GivesConditionsTheDefaultMaterial) {
  Deck deck = read_deck_text(
      "<Uintah_specification><Grid><BoundaryConditions><DefaultMaterial>1</DefaultMaterial>"
      "<Face side='x-'><BCType/><BCType id='all'/><BCType ids='[0,2]'/></Face>"
      "</BoundaryConditions></Grid></Uintah_specification>",
      "faces.ups");
  settle_faces(*deck.root, deck.faults);
  const auto conditions = deck.root->find("Grid/BoundaryConditions/Face")->all("BCType");
  EXPECT_EQ(conditions.at(0)->attribute("id"), "1");
  EXPECT_EQ(conditions.at(1)->attribute("id"), "all");
  EXPECT_EQ(conditions.at(2)->attribute("id"), std::nullopt);
}

TEST(Obsolete, TagsMapOrDropWithOneWarningEach) {
  Deck deck = read_deck_text(
      "<Uintah_specification>\n"
      "<PhysicalConstants><pressure>1</pressure><gravity>[0,0,0]</gravity></PhysicalConstants>\n"
      "<MPM><UseMomentumForm>false</UseMomentumForm><interpolator>cpid</interpolator></MPM>\n"
      "<DataArchiver><checkpoint cycle='4.0'/><checkpoint cycle='2'/></DataArchiver>\n"
      "<Models><Model><TracerParticles><newVariables/></TracerParticles></Model></Models>\n"
      "</Uintah_specification>",
      "old.ups");
  drop_obsolete(*deck.root, deck.faults);
  EXPECT_EQ(deck.root->find("PhysicalConstants/pressure"), nullptr);
  EXPECT_NE(deck.root->find("PhysicalConstants/gravity"), nullptr);
  EXPECT_EQ(deck.root->find("MPM/UseMomentumForm"), nullptr);
  EXPECT_EQ(deck.root->find("MPM/interpolator")->text, "cpdi");
  EXPECT_EQ(deck.root->find("DataArchiver/checkpoint")->attribute("cycle"), "4");
  EXPECT_NE(deck.root->find("Models/Model/TracerParticles/cloneVariables"), nullptr);
  ASSERT_EQ(deck.faults.size(), 5u);
  for (const Fault& fault : deck.faults) {
    EXPECT_EQ(fault.severity, Severity::warning);
    EXPECT_GT(fault.where.line, 1);
  }
  const std::string before = to_xml(*deck.root);
  drop_obsolete(*deck.root, deck.faults);
  EXPECT_EQ(deck.faults.size(), 5u);  // nothing obsolete is left
  EXPECT_EQ(to_xml(*deck.root), before);
}

TEST(Obsolete, WhatHasNoEffectIsToldOfByLineAndStays) {
  Deck deck = read_deck_text(
      "<Uintah_specification>\n"
      "<LoadBalancer type='DLB'>\n"
      "<gainThreshold>0.1</gainThreshold>\n"
      "<costAlgorithm>Model</costAlgorithm>\n"
      "</LoadBalancer>\n"
      "</Uintah_specification>",
      "balanced.ups");
  const std::string before = to_xml(*deck.root);
  drop_obsolete(*deck.root, deck.faults);
  EXPECT_EQ(to_xml(*deck.root), before);
  ASSERT_EQ(deck.faults.size(), 2u);
  EXPECT_EQ(deck.faults[0].severity, Severity::warning);
  EXPECT_EQ(deck.faults[0].where.line, 2);
  EXPECT_EQ(deck.faults[0].message, "<LoadBalancer type> has no effect");
  EXPECT_EQ(deck.faults[1].where.line, 4);
  EXPECT_EQ(deck.faults[1].message, "<costAlgorithm> has no effect");
}

// What a rule cannot read hides no other fault, and is a fault where there is no other.
TEST(LoadDeck, RulesThatThrowHideNothing) {
  Schema schema;
  int calls = 0;
  schema.rules.push_back(
      [](const DeckNode&, std::vector<Fault>&) { throw InputError("a rule could not read it"); });
  schema.rules.push_back([&](const DeckNode&, std::vector<Fault>&) { ++calls; });
  const std::string good = "<Uintah_specification></Uintah_specification>";
  const Deck alone = load_deck_text(good, "deck.ups", {}, schema);
  ASSERT_EQ(alone.faults.size(), 1u);
  EXPECT_EQ(alone.faults[0].message, "a rule could not read it");
  const std::string bad = "<Uintah_specification><unknown/></Uintah_specification>";
  const Deck other = load_deck_text(bad, "deck.ups", {}, schema);
  ASSERT_EQ(other.faults.size(), 1u);
  EXPECT_NE(other.faults[0].message.find("unknown"), std::string::npos);
  EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace sluice::load_deck_test
