// Solver tags as decks write them, and what becomes of them.
#include "framework/solve/solver_tags.hpp"

#include "framework/deck/schema_check.hpp"
#include "framework/scene/deck_values.hpp"
#include "framework/scene/test_support/deck_text.hpp"

namespace sluice::solve::solver_tags_test {
namespace {

using ::testing::HasSubstr;

struct Read {
  SolverSettings settings;
  std::string faults;
};

// A deck of <Solver type> and a block <SolverTest>, through the schema and the reader.
Read read(const std::string& type, const std::string& in_solver, const std::string& in_block) {
  const std::string solver =
      type.empty() ? "" : "<Solver type=\"" + type + "\">" + in_solver + "</Solver>";
  Deck deck = read_deck_text("<Uintah_specification>\n" + solver + "<SolverTest>\n" + in_block +
                                 "</SolverTest></Uintah_specification>\n",
                             "deck.ups");
  Schema schema;
  add_solver_tag(schema);
  schema.add(tag("SolverTest", "a solve").child(solver_parameters_tag()));
  check_structure(*deck.root, schema, deck.faults);
  Read result;
  if (!any_error(deck.faults))
    result.settings = read_solver_settings(*deck.root, *deck.root->child("SolverTest"),
                                           "implicitPressure", deck.faults);
  result.faults = all_faults(deck.faults);
  return result;
}

std::string parameters(const std::string& tags, const std::string& attribute = "") {
  return "<Parameters" + attribute + ">" + tags + "</Parameters>\n";
}

TEST(SolverTags, WithoutTagsOurOwnSolverAndDefaults) {
  const Read r = read("", "", "");
  EXPECT_EQ(r.faults, "");
  EXPECT_EQ(r.settings.type, "CGSolver");
  EXPECT_EQ(r.settings.tolerance, 1e-10);
  EXPECT_EQ(r.settings.max_iterations, 75);
}

TEST(SolverTags, ABlockAsDecksWriteIt) {
  const Read r = read("hypre", "",
                      parameters("<solver> cg </solver><preconditioner> pfmg </preconditioner>"
                                 "<tolerance> 1.e-8 </tolerance><maxiterations> 7500 "
                                 "</maxiterations><npre>2</npre><npost>3</npost><skip>1</skip>"
                                 "<jump>0</jump><relax_type> 2 </relax_type><logging>0</logging>"
                                 "<setupFrequency> 3 </setupFrequency>",
                                 " variable=\"implicitPressure\""));
  EXPECT_EQ(r.faults, "");
  const SolverSettings& s = r.settings;
  EXPECT_EQ(s.type, "hypre");
  EXPECT_EQ(s.solver, "cg");
  EXPECT_EQ(s.preconditioner, "pfmg");
  EXPECT_EQ(s.tolerance, 1e-8);
  EXPECT_EQ(s.max_iterations, 7500);
  EXPECT_EQ(s.before, 2);
  EXPECT_EQ(s.after, 3);
  EXPECT_EQ(s.skip, 1);
  EXPECT_EQ(s.relax_type, 2);
  EXPECT_EQ(s.set_up_every, 3);
}

TEST(SolverTags, NamesInAnySpellingOfTheFormat) {
  for (const char* name : {"CG", "conjugategradient", "PCG", "SMG", "PFMG", "SparseMSG", "GMRES",
                           "BiCGSTAB", "Hybrid", "Jacobi", "Diagonal", "BoomerAMG", "AMG"}) {
    const Read r = read("hypre", "", parameters("<solver>" + std::string(name) + "</solver>"));
    EXPECT_THAT(r.faults, ::testing::Not(HasSubstr("error"))) << name;
  }
  EXPECT_EQ(read("hypre", "", parameters("<solver>conjugategradient</solver>")).settings.solver,
            "cg");
  EXPECT_EQ(read("hypre", "", parameters("<solver>BoomerAMG</solver>")).settings.solver, "amg");
}

TEST(SolverTags, AlgebraicMultigridIsNamedEitherWay) {
  const Read r = read("hypre", "",
                      parameters("<solver>cg</solver><preconditioner>amg"
                                 "</preconditioner>"));
  EXPECT_EQ(r.faults, "");
  EXPECT_EQ(r.settings.solver, "amg");
  EXPECT_THAT(read("hypre", "",
                   parameters("<solver>gmres</solver>\n<preconditioner>amg"
                              "</preconditioner>"))
                  .faults,
              HasSubstr("deck.ups:4:1: error: amg is not a preconditioner of gmres"));
}

TEST(SolverTags, NormAndCriteriaAreOfOurOwnSolver) {
  const std::string tags =
      "<norm> LInfinity </norm><criteria>Absolute</criteria><tolerance>1e-6</tolerance>";
  const Read own = read("CGSolver", "", parameters(tags));
  EXPECT_EQ(own.faults, "");
  EXPECT_EQ(own.settings.norm, Norm::largest);
  EXPECT_EQ(own.settings.tolerance, 0);
  EXPECT_EQ(own.settings.absolute_tolerance, 1e-6);
  const Read hypre = read("hypre", "", parameters(tags));
  EXPECT_THAT(hypre.faults, HasSubstr("warning: <norm> and <criteria> have no effect"));
  EXPECT_EQ(hypre.settings.norm, Norm::two);
  EXPECT_EQ(hypre.settings.tolerance, 1e-6);
}

TEST(SolverTags, TagsOfASolverThatDoesNotRunAreTold) {
  const std::string tags =
      "<tolerance>1e-8</tolerance>\n<solver>cg</solver><preconditioner>pfmg</preconditioner>"
      "<npre>1</npre><skip>0</skip><jump>2</jump>";
  EXPECT_THAT(read("CGSolver", "", parameters(tags)).faults,
              HasSubstr("deck.ups:4:1: warning: <solver>, <preconditioner>, <npre>, <skip>, <jump> "
                        "have no effect: the solver is CGSolver"));
  EXPECT_THAT(
      read("hypre", "", parameters(tags)).faults,
      HasSubstr("warning: <jump> has no effect: the solver is hypre's cg, preconditioned by "
                "pfmg"));
  EXPECT_THAT(read("hypre", "",
                   parameters("<solver>pfmg</solver><preconditioner>smg</preconditioner>"
                              "<precond_maxiters>2</precond_maxiters><relax_type>1</relax_type>"))
                  .faults,
              HasSubstr("warning: <preconditioner>, <precond_maxiters> have no effect"));
  EXPECT_EQ(read("hypreamr", "", parameters("<precond_maxiters>2</precond_maxiters>")).faults, "");
}

TEST(SolverTags, TheBlockOfTheSolveGoesFirstAndOfItsVariableOnly) {
  const std::string general = parameters("<npre>5</npre>"), own = parameters("<npre>6</npre>");
  EXPECT_EQ(read("hypre", general, own).settings.before, 6);
  EXPECT_EQ(read("hypre", general, "").settings.before, 5);
  const Read foreign = read("hypre", general, parameters("<npre>6</npre>", " variable=\"divQ\""));
  EXPECT_EQ(foreign.settings.before, 5);
  EXPECT_THAT(foreign.faults, HasSubstr("warning: <Parameters> have no effect: what is solved for "
                                        "is implicitPressure"));
}

TEST(SolverTags, SettingsThatNoSolverTakesNameTheirPlace) {
  EXPECT_THAT(
      read("hypre", "", parameters("<solver>sparsemsg</solver><relax_type>2</relax_type>")).faults,
      HasSubstr("deck.ups:3:1: error: sparsemsg does not support relax_type 2"));
}

}  // namespace
}  // namespace sluice::solve::solver_tags_test
