// Solvers as tags of a deck: only their bytes change, and what is written reads back as the solver.
#include "app/tune/tune_deck.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/loading/sluice_schema.hpp"
#include "app/tune/tune_xml.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/solve/solver_tags.hpp"

namespace sluice::app::tune_deck_test {
namespace {

using solve::Norm;
using solve::SolverSettings;
using testing::HasSubstr;

std::string deck_with(const std::string& solver, const std::string& parameters) {
  return "<?xml version=\"1.0\"?>\n<!-- a <Solver type=\"none\"/> in a comment -->\n"
         "<Uintah_specification>\n  <SimulationComponent type=\"ice\"/>\n" +
         solver +
         "  <CFD><ICE>\n    <ImplicitSolver>\n"
         "      <max_outer_iterations> 1 </max_outer_iterations>\n" +
         parameters + "    </ImplicitSolver>\n  </ICE></CFD>\n</Uintah_specification>\n";
}

// As a run reads them.
SolverSettings settings_of(const std::string& text) {
  const Deck deck = read_deck_text(text, "test.ups");
  std::vector<Fault> faults;
  const SolverSettings s = solve::read_solver_settings(
      *deck.root, *deck.root->find("CFD/ICE/ImplicitSolver"), "implicitPressure", faults);
  for (const Fault& f : faults) ADD_FAILURE() << to_string(f) << "\n" << text;
  return s;
}

SolverSettings pfmg() {
  SolverSettings s;
  s.type = "hypre";
  s.tolerance = 1e-8;
  s.relax_type = 2;
  s.skip = 1;
  return s;
}

void expect_same(const SolverSettings& a, const SolverSettings& b) {
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.solver, b.solver);
  EXPECT_EQ(a.preconditioner, b.preconditioner);
  EXPECT_EQ(a.tolerance, b.tolerance);
  EXPECT_EQ(a.absolute_tolerance, b.absolute_tolerance);
  EXPECT_EQ(a.norm, b.norm);
  EXPECT_EQ(a.before, b.before);
  EXPECT_EQ(a.after, b.after);
  EXPECT_EQ(a.skip, b.skip);
  EXPECT_EQ(a.relax_type, b.relax_type);
  EXPECT_EQ(a.max_iterations, b.max_iterations);
}

TEST(TuneDeck, ReplacesValuesAndAddsTagsAndKeepsEveryOtherByte) {
  const std::string before =
      deck_with("  <Solver type = 'hypre' />\n",
                "      <Parameters variable=\"implicitPressure\">\n"
                "        <tolerance>  1.e-8 </tolerance>   <!-- kept -->\n"
                "        <solver>   smg   </solver>\n\t<skip/>\n      </Parameters>\n");
  SolverSettings own = pfmg();
  own.solver = "smg";
  own.relax_type = 1;
  own.skip = 0;
  const std::string after = tuned_deck(before, "test.ups", own, pfmg());
  EXPECT_THAT(after, HasSubstr("<Solver type = 'hypre' />"));
  EXPECT_THAT(after, HasSubstr("<tolerance>  1.e-8 </tolerance>   <!-- kept -->\n"));
  EXPECT_THAT(after, HasSubstr("<solver>   cg   </solver>\n\t<skip>1</skip>\n"
                               "\t<preconditioner>pfmg</preconditioner>\n"
                               "\t<relax_type>2</relax_type>\n      </Parameters>\n"));
  EXPECT_THAT(after, HasSubstr("a <Solver type=\"none\"/> in a comment"));
  expect_same(settings_of(after), pfmg());
}

TEST(TuneDeck, NamesASolverWhereTheDeckNamesNone) {
  const std::string before = deck_with("", "");
  SolverSettings own;
  SolverSettings to = pfmg();
  to.tolerance = own.tolerance;
  const std::string after = tuned_deck(before, "test.ups", own, to);
  expect_same(settings_of(after), to);
  EXPECT_THAT(after, HasSubstr("\n  <Solver type=\"hypre\"/>\n  <SimulationComponent"));
}

TEST(TuneDeck, WritesParametersOfTheSolverThatServeTheSolve) {
  const std::string before = deck_with(
      "  <Solver type=\"hypre\"><Parameters><tolerance>1e-8</tolerance></Parameters></Solver>\n",
      "");
  SolverSettings own = pfmg();
  own.relax_type = 1;
  own.skip = 0;
  const std::string after = tuned_deck(before, "test.ups", own, pfmg());
  expect_same(settings_of(after), pfmg());
  EXPECT_THAT(after, testing::Not(HasSubstr("variable=")));
}

// <norm> and <criteria> sleep under hypre; our own solver would obey them.
TEST(TuneDeck, AChangeOfTypeKeepsTheGoal) {
  const std::string sleeping =
      "      <Parameters variable=\"implicitPressure\">\n        <norm> LInfinity </norm>\n"
      "        <criteria>Absolute</criteria><tolerance>1e-8</tolerance>\n      </Parameters>\n";
  SolverSettings own = pfmg();
  own.relax_type = 1;
  own.skip = 0;
  SolverSettings to = own;
  to.type = "CGSolver";
  expect_same(settings_of(tuned_deck(deck_with("  <Solver type=\"hypre\"/>\n", sleeping),
                                     "test.ups", own, to)),
              to);
  // And back: what our own solver measured absolutely becomes a share.
  SolverSettings absolute;
  absolute.norm = Norm::largest;
  absolute.tolerance = 0;
  absolute.absolute_tolerance = 1e-8;
  SolverSettings share = pfmg();
  share.tolerance = 3e-7;
  expect_same(settings_of(tuned_deck(deck_with("", sleeping), "test.ups", absolute, share)), share);
}

TEST(TuneDeck, ADeckWithoutTheBlockIsRefused) {
  EXPECT_THROW(tuned_deck("<Uintah_specification> <include href=\"a\"/> </Uintah_specification>",
                          "test.ups", {}, pfmg()),
               InputError);
}

TEST(TuneDeck, XmlToPasteReadsBack) {
  const std::string xml = solver_xml(pfmg());
  const std::size_t line = xml.find('\n');
  expect_same(settings_of(deck_with(xml.substr(0, line + 1), xml.substr(line + 1))), pfmg());
  SolverSettings own;
  own.norm = Norm::largest;
  own.tolerance = 0;
  own.absolute_tolerance = 1e-9;
  const std::string ours = solver_xml(own);
  const std::size_t first = ours.find('\n');
  expect_same(settings_of(deck_with(ours.substr(0, first + 1), ours.substr(first + 1))), own);
}

TEST(TuneXml, FindsElementsAroundWhatIsNone) {
  const std::string text =
      "\n<!DOCTYPE a>\n<a b='1 > 0' c = \"'\"><!-- <d> --><e/><![CDATA[<d>]]><d >x</d\n></a>";
  const XmlSpan root = xml_elements(text);
  EXPECT_EQ(root.name, "a");
  EXPECT_EQ(root.attribute("b")->value, "1 > 0");
  EXPECT_EQ(root.attribute("c")->value, "'");
  ASSERT_EQ(root.children.size(), 2u);
  EXPECT_TRUE(root.child("e")->empty_tag);
  const XmlSpan& d = *root.child("d");
  EXPECT_EQ(text.substr(d.inner_begin, d.inner_end - d.inner_begin), "x");
  EXPECT_EQ(root.end, text.size());
  EXPECT_THROW(xml_elements("<a><b>"), InputError);
  EXPECT_THROW(xml_elements("no tag"), InputError);
}

TEST(TuneXml, TextBesideACommentIsReplacedAlone) {
  for (const auto& [before, after] :
       {std::pair{"<a> old <!-- why --> </a>", "<a> new <!-- why --> </a>"},
        std::pair{"<a><!-- why --> old\n</a>", "<a><!-- why --> new\n</a>"},
        std::pair{"<a></a>", "<a>new</a>"}, std::pair{"<a/>", "<a>new</a>"}}) {
    const std::string text = before;
    const XmlSpan root = xml_elements(text);
    XmlEdits edits(text);
    edits.set_text(root, "new");
    EXPECT_EQ(edits.result(), after);
  }
}

}  // namespace
}  // namespace sluice::app::tune_deck_test
