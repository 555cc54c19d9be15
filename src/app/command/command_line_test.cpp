// The command line as a user meets it: the executable itself is run, its status and text checked.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "app/command/command_test_support.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::command_line_test {
namespace {

using ::testing::HasSubstr;

Outcome run_in(const std::string& folder, const std::string& arguments) {
  return run_in_shell("cd " + folder + " && " + std::string(SLUICE_COMMAND) + " " + arguments);
}

Outcome run(const std::string& arguments) {
  return run_in(".", arguments);
}

TEST(CommandLine, WithoutArgumentsIsBadInput) {
  const Outcome outcome = run("");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.text, HasSubstr("subcommand is required"));
}

TEST(CommandLine, HelpAndVersionAreGood) {
  EXPECT_EQ(run("--help").status, 0);
  EXPECT_EQ(run("check --help").status, 0);
  const Outcome version = run("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.text, HasSubstr("sluice 0."));
}

TEST(CommandLine, UnknownOptionIsBadInputAndNamed) {
  const Outcome outcome = run("check --frobnicate deck.ups");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.text, HasSubstr("--frobnicate"));
}

TEST(CommandLine, UnknownSubcommandIsBadInputAndNamed) {
  const Outcome outcome = run("chek deck.ups");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.text, HasSubstr("did you mean 'check'?"));
}

TEST(CommandLine, MissingDeckIsBadInputAndNamed) {
  const Outcome outcome = run("check nosuch.ups");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.text, HasSubstr("nosuch.ups: error: no such file"));
}

TEST(CommandLine, FolderInPlaceOfADeckIsBadInput) {
  const Outcome outcome = run("check /usr");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.text, HasSubstr("not a regular file"));
}

TEST(CommandLine, CheckReportsAsJson) {
  const Outcome outcome =
      run("check --json nosuch.ups " SLUICE_SOURCE_DIR "/src/framework/deck/bad_decks/good.ups");
  EXPECT_EQ(outcome.status, 2);
  const auto report = nlohmann::json::parse(outcome.text);
  EXPECT_EQ(report.at("good"), false);
  ASSERT_EQ(report.at("decks").size(), 2u);
  const auto& missing = report["decks"][0];
  EXPECT_EQ(missing.at("good"), false);
  ASSERT_EQ(missing.at("faults").size(), 1u);
  EXPECT_EQ(missing["faults"][0].at("kind"), "error");
  EXPECT_EQ(missing["faults"][0].at("file"), "nosuch.ups");
  EXPECT_EQ(report["decks"][1].at("good"), true);
  EXPECT_TRUE(report["decks"][1].at("faults").empty());
}

TEST(CommandLine, HelpExplainsTagsAndRefusesUnknownOnes) {
  const Outcome known = run("help CFD/ICE/scheme");
  EXPECT_EQ(known.status, 0);
  EXPECT_THAT(known.text, HasSubstr("conservative"));
  EXPECT_EQ(run("help").status, 0);
  const Outcome unknown = run("help gama");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.text, HasSubstr("did you mean 'gamma'?"));
}

TEST(CommandLine, OverridesReachTheCheck) {
  const std::string deck = SLUICE_SOURCE_DIR "/src/framework/deck/bad_decks/good.ups";
  EXPECT_EQ(run("check " + deck + " --set Grid/Level/Box/resolution=[500,1,1]").status, 0);
  EXPECT_EQ(run("check --set CFD/cfl=0.1 --set CFD/ICE/scheme=classic " + deck).status, 0);
  EXPECT_EQ(run("check --set Time/timestep_multiplier= " + deck).status, 2);
}

// A run that would be long if it started.
const std::string long_run =
    "run " SLUICE_SOURCE_DIR "/inputs/ice/riemann_sod.ups --no-output --progress none ";

TEST(CommandLine, LimitsThatLimitNothingAreBadInput) {
  for (const char* steps : {"-3", "0"}) {
    const Outcome outcome = run(long_run + "--max-steps " + steps);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.text, HasSubstr(std::string("--max-steps is ") + steps));
    EXPECT_THAT(outcome.text, HasSubstr("at least 1"));
  }
  for (const char* seconds : {"-1", "0", "nan"}) {
    const Outcome outcome = run(long_run + "--wall-limit " + seconds);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.text, HasSubstr("greater than 0"));
  }
  EXPECT_EQ(run(long_run + "--max-steps 1 --wall-limit 1000").status, 0);
}

TEST(CommandLine, AStepBelongsToARestart) {
  const Outcome outcome = run(long_run + "--step 5");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.text, HasSubstr("--restart"));
}

TEST(CommandLine, TheReportGoesToStandardOutputAlone) {
  const std::string deck = SLUICE_SOURCE_DIR "/inputs/ice/riemann_sod.ups";
  const Outcome outcome = run("run " + deck + " --no-output --max-steps 2 --json -");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(nlohmann::json::parse(outcome.text).at("steps"), 2);
  EXPECT_EQ(run("run " + deck + " --no-output --max-steps 2 --json - --costs").status, 2);
}

TEST(CommandLine, CasesAndStudiesAreFoundFromAnyFolder) {
  const Outcome list = run_in("/", "regress --list");
  EXPECT_EQ(list.status, 0) << list.text;
  EXPECT_THAT(list.text, HasSubstr("sod\n"));
  // The study is read, and none of its runs is wanted.
  const std::string folder = ::testing::TempDir() + "sluice_found_study";
  const Outcome study = run_in("/", "accuracy sod --only nosuchrun -o " + folder);
  EXPECT_EQ(study.status, 2);
  EXPECT_THAT(study.text, HasSubstr("--only nosuchrun matches none"));
  EXPECT_EQ(run_in("/", "accuracy nosuch").status, 2);
}

TEST(CommandLine, NotesAboutTheTimeStepCanBeSilenced) {
  const std::string command = "run " SLUICE_SOURCE_DIR
                              "/inputs/ice/riemann_sod.ups --no-output --max-steps 2 "
                              "--set Time/delt_init=1e-6";
  EXPECT_THAT(run(command).text, HasSubstr("delt_init lowers"));
  EXPECT_THAT(run(command + " --quiet").text, ::testing::Not(HasSubstr("delt_init lowers")));
  EXPECT_EQ(run(command + " --progress none").text, "");
}

TEST(CommandLine, AReportThatCannotBeWrittenFailsBeforeTheRun) {
  const Outcome outcome = run("run " SLUICE_SOURCE_DIR
                              "/inputs/ice/riemann_sod.ups --no-output --progress plain --json "
                              "/nosuch/folder/run.json");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.text, HasSubstr("/nosuch/folder/run.json"));
  EXPECT_THAT(outcome.text, ::testing::Not(HasSubstr("Timestep")));
}

}  // namespace
}  // namespace sluice::command_line_test
