// How runs end for whoever has started them: exit status, last line, checkpoint.
#include "app/command/run_ending.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "app/command/command_test_support.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::run_ending_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class RunEnding : public ::testing::Test {
 protected:
  // A tube of few cells; `more` may make it endless.
  std::string run(const std::string& more) const {
    return std::string(SLUICE_COMMAND) +
           " run " SLUICE_SOURCE_DIR
           "/inputs/ice/shock_tube.ups --set Grid/Level/Box/resolution=[40,1,1] -o " +
           folder_.path().string() + " " + more;
  }
  // Starts the command, sends a signal to `whom` (from $p, the process started) once it steps, and
  // ends with its status.
  Outcome signalled(const std::string& command, const std::string& signal,
                    const std::string& whom) const {
    const std::string log = (folder_ / "log").string();
    return run_in_shell(command + " >" + log + " 2>&1 & p=$!; " + "until grep -q Timestep " + log +
                        "; do sleep 0.01; done; kill -" + signal + " " + whom +
                        "; wait $p; s=$?; cat " + log + "; exit $s");
  }
  bool has_checkpoint() const {
    return text_of(folder_ / "shock_tube.uda.000/checkpoints/index.xml").find("<timestep ") !=
           std::string::npos;
  }

  const std::string endless_ = "--progress plain --set Time/maxTime=1e9";
  TemporaryFolder folder_;
};

// Of the program: at its end the launcher's event loop may warn of pipes that are closed already.
std::string last_line(const std::string& text) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("[warn] Epoll")) last = line;
  return last;
}

// A picture of step 1 must not pass for one of the end.
TEST_F(RunEnding, TheLastOutputIsSaidToBeNotTheEnd) {
  const std::string options =
      "--set DataArchiver/outputInterval=9 --set DataArchiver/outputInitTimestep= "
      "--set DataArchiver/outputLastTimestep= --set Time/maxTime=0.02 ";
  const Outcome first = run_in_shell(run(options));
  ASSERT_EQ(first.status, 0) << first.text;
  EXPECT_THAT(first.text, testing::ContainsRegex("output of step 1 [(]t = [^)]*[)]; the run ended "
                                                 "at step [0-9]+ [(]t = 0.02[)]"));
  EXPECT_THAT(first.text, HasSubstr("--output-at-end"));
  const std::string archive = (folder_ / "shock_tube.uda").string(),
                    picture = " -o " + (folder_ / "p.png").string();
  const std::string plot = std::string(SLUICE_COMMAND) + " plot " + archive + picture;
  EXPECT_THAT(run_in_shell(plot).text, HasSubstr("note: output of step 1 "));
  EXPECT_THAT(run_in_shell(plot + " --time first").text, Not(HasSubstr("note:")));

  const Outcome second = run_in_shell(run(options + "--output-at-end"));
  ASSERT_EQ(second.status, 0) << second.text;
  EXPECT_THAT(second.text, Not(HasSubstr("output of step")));
  EXPECT_THAT(run_in_shell(plot).text, Not(HasSubstr("note:")));
  EXPECT_THAT(text_of(folder_ / "shock_tube.uda" / "input.xml"),
              HasSubstr("<outputLastTimestep>true</outputLastTimestep>"));
}

// A run that was cut has its state in a checkpoint alone.
TEST_F(RunEnding, ACheckpointIsShownToo) {
  const std::string options =
      "--set DataArchiver/outputInterval=9 --set DataArchiver/outputInitTimestep= "
      "--set DataArchiver/outputLastTimestep= --max-steps 7";
  const Outcome cut = run_in_shell(run(options));
  ASSERT_EQ(cut.status, 0) << cut.text;
  EXPECT_THAT(cut.text, HasSubstr("--checkpoint shows the checkpoint of step 7"));
  const std::string sluice = SLUICE_COMMAND, archive = " " + (folder_ / "shock_tube.uda").string();
  const Outcome drawn =
      run_in_shell(sluice + " plot" + archive + " --checkpoint -o " + (folder_ / "p.svg").string());
  EXPECT_EQ(drawn.status, 0) << drawn.text;
  EXPECT_THAT(drawn.text, Not(HasSubstr("note:")));
  EXPECT_THAT(text_of(folder_ / "p.svg"), HasSubstr("step 7"));
  const Outcome listed = run_in_shell(sluice + " info" + archive + " --checkpoint");
  EXPECT_THAT(listed.text, HasSubstr("labels of step 7"));
  EXPECT_EQ(run_in_shell(sluice + " compare" + archive + archive + " --checkpoint").status, 0);
  // The label of the mass, as the list has it.
  const std::string label = listed.text.substr(listed.text.find("labels of step 7"));
  std::istringstream words(label.substr(label.find('\n') + 1));
  std::string first, skipped;
  std::getline(words, skipped);
  words >> first;
  const Outcome rows = run_in_shell(sluice + " extract" + archive + " --checkpoint --var " + first);
  EXPECT_EQ(rows.status, 0) << rows.text;
  EXPECT_EQ(std::count(rows.text.begin(), rows.text.end(), '\n'), 41);
  EXPECT_EQ(run_in_shell(sluice + " extract" + archive + " --checkpoint --time '#3' --var " + first)
                .status,
            2);
}

// Removed while the run goes on: the next output says so.
TEST_F(RunEnding, WhatIsGoneEndsTheRunWithStatus3) {
  for (const char* gone : {"input.xml", "t00000", ""}) {
    const std::string archive = (folder_ / "shock_tube.uda.000").string();
    const std::string log = (folder_ / "log").string();
    const Outcome o =
        run_in_shell(run(endless_ + " --set DataArchiver/outputInterval= --set "
                                    "DataArchiver/outputTimestepInterval=2000 --quiet") +
                     " >" + log + " 2>&1 & p=$!; until test -e " + archive +
                     "/t00001/timestep.xml -o -e " + archive +
                     "/t00000/timestep.xml; do sleep 0.01; done; "
                     "rm -rf " +
                     archive + "/" + gone + "; wait $p; s=$?; cat " + log + "; exit $s");
    EXPECT_EQ(o.status, 3) << gone << o.text;
    EXPECT_THAT(o.text, HasSubstr("is gone")) << gone;
    std::filesystem::remove_all(folder_ / "shock_tube.uda.000");
    std::filesystem::remove(folder_ / "shock_tube.uda");
  }
}

// With the step that delt_min has made too long, and without.
TEST_F(RunEnding, AStepThatDeltMinRaisedIsNamedWhereItFails) {
  const Outcome raised =
      run_in_shell(run("--progress none --set Time/delt_min=0.05 "
                       "--set Time/delt_init=1"));
  EXPECT_EQ(raised.status, 1) << raised.text;
  EXPECT_THAT(raised.text, HasSubstr("warning: step 1 at time 0: delt_min raises"));
  EXPECT_THAT(raised.text, HasSubstr("<delt_min> 0.05 has raised this step above the stable one"));
}

TEST_F(RunEnding, ATimeLimitIsStatus4AndTheLastLineGoesOn) {
  const Outcome first = run_in_shell(run("--wall-limit 1e-9"));
  EXPECT_EQ(first.status, 4) << first.text;
  EXPECT_TRUE(has_checkpoint());
  const Outcome second = run_in_shell("cd / && " + last_line(first.text));
  EXPECT_EQ(second.status, 0) << second.text;
  EXPECT_THAT(second.text, HasSubstr("done: "));
}

TEST_F(RunEnding, WhereNothingIsWrittenTheLastLineSaysSo) {
  const Outcome outcome = run_in_shell(run("--wall-limit 1e-9 --no-output"));
  EXPECT_EQ(outcome.status, 4);
  EXPECT_THAT(last_line(outcome.text), HasSubstr("cannot be continued"));
}

TEST_F(RunEnding, ASignalIsStatus4) {
  const Outcome outcome = signalled(run(endless_), "TERM", "$p");
  EXPECT_EQ(outcome.status, 4) << outcome.text;
  EXPECT_TRUE(has_checkpoint());
  EXPECT_THAT(last_line(outcome.text), HasSubstr("sluice run --restart /"));
}

// Nothing of solids alone is swept over cells: they are asked for clock and signals all the same.
TEST_F(RunEnding, SolidsToo) {
  const std::string solids = std::string(SLUICE_COMMAND) +
                             " run " SLUICE_SOURCE_DIR
                             "/inputs/mpm/free_bar.ups --no-output --set Time/maxTime=1e9 ";
  EXPECT_EQ(run_in_shell(solids + "--wall-limit 1e-9").status, 4);
  EXPECT_EQ(signalled(solids + "--progress plain", "TERM", "$p").status, 4);
}

TEST_F(RunEnding, StepsThatWereAskedForAreAGoodEndWithACheckpoint) {
  const Outcome outcome = run_in_shell(run("--max-steps 3"));
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(text_of(folder_ / "shock_tube.uda.000/checkpoints/index.xml"),
              HasSubstr("t00003/timestep.xml"));
}

TEST_F(RunEnding, RanksThatRunOutOfTimeEndWith4) {
  const Outcome outcome = run_in_shell(on_ranks(2) + run("--wall-limit 1e-9"));
  EXPECT_EQ(outcome.status, 4) << outcome.text;
  EXPECT_TRUE(has_checkpoint());
  EXPECT_THAT(last_line(outcome.text),
              HasSubstr("mpirun -np 2 " SLUICE_COMMAND " run --restart /"));
}

// The launcher gives its ranks a terminal, whatever its own output is.
TEST_F(RunEnding, RanksWriteNoEscapeCodes) {
  const Outcome outcome = run_in_shell(on_ranks(2) + run("--max-steps 5"));
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("Timestep "));
  EXPECT_THAT(outcome.text, Not(HasSubstr("\033")));
}

TEST_F(RunEnding, ASignalToOneRankEndsAllWith4) {
  const Outcome outcome = signalled(on_ranks(2) + run(endless_), "TERM",
                                    "$(cat /proc/$p/task/*/children | awk 'NF {print $NF; exit}')");
  EXPECT_EQ(outcome.status, 4) << outcome.text;
  EXPECT_TRUE(has_checkpoint());
}

// The status is then the launcher's.
TEST_F(RunEnding, ASignalToTheLauncherLeavesACheckpoint) {
  const Outcome outcome = signalled(on_ranks(2) + run(endless_), "USR1", "$p");
  EXPECT_NE(outcome.status, 0) << outcome.text;
  EXPECT_TRUE(has_checkpoint());
}

TEST_F(RunEnding, LimitsOfFileSizesAreToldAsAFullDiskIs) {
  for (const int blocks : {0, 1, 2, 4, 9}) {  // of 512 bytes
    // The shell's own output must not be a file.
    const Outcome outcome =
        run_in_shell("(ulimit -f " + std::to_string(blocks) + "; " + run("--progress none") + ")");
    EXPECT_EQ(outcome.status, 3) << blocks << ": " << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("sluice: error: ")) << blocks;
    EXPECT_THAT(outcome.text, HasSubstr("File too large; raise the limit")) << blocks;
  }
}

TEST_F(RunEnding, StatusesAreListed) {
  for (const char* words : {" --help", " help"})
    EXPECT_THAT(run_in_shell(std::string(SLUICE_COMMAND) + words).text,
                HasSubstr("4 the run ended early"));
}

TEST(CommandToContinue, IsForAnyShellAndFolder) {
  ContinueWords words;
  words.archive = "/data/two words/a.uda.000";
  words.parent = ".";
  const std::string here = std::filesystem::current_path().string();
  EXPECT_EQ(command_to_continue(words),
            "sluice run --restart '/data/two words/a.uda.000' -o " + here);
  words = {"/data/it's.uda.000", "/out", 4, 2, true, "/opt/sluice/bin/sluice"};
  EXPECT_EQ(command_to_continue(words),
            "mpirun -np 4 /opt/sluice/bin/sluice run --restart '/data/it'\\''s.uda.000' -o /out "
            "--threads 2 --force-directions");
}

}  // namespace
}  // namespace sluice::run_ending_test
