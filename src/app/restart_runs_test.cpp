// Restarts as users ask for them: other intervals, at the end, from anywhere, without the deck.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/command/command_test_support.hpp"
#include "framework/archive/archive.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::restart_runs_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path inputs = SLUICE_SOURCE_DIR "/inputs";

class RestartRuns : public ::testing::Test {
 protected:
  // A tube of few cells, 0.2 s long.
  Outcome tube(std::vector<std::string> more) const {
    more.insert(more.begin(), {(inputs / "ice/shock_tube.ups").string(), "--set",
                               "Grid/Level/Box/resolution=[40,1,1]", "--set",
                               "DataArchiver/outputInterval=0.05"});
    return run(more);
  }
  Outcome run(std::vector<std::string> words) const {
    words.insert(words.begin(), {"run", "--progress", "none", "-o", folder_.path().string()});
    return run_sluice(words);
  }
  fs::path archive(int number) const {
    return folder_ / ("shock_tube.uda.00" + std::to_string(number));
  }
  std::vector<double> outputs(int number) const {
    std::vector<double> times;
    const Archive opened = Archive::open(archive(number));
    for (const StepEntry& s : opened.outputs()) times.push_back(s.time);
    return times;
  }

  TemporaryFolder folder_;
};

TEST_F(RestartRuns, AnotherIntervalIsCountedInItsOwnMultiples) {
  const std::string exactly = "Time/clamp_time_to_output=true";
  ASSERT_EQ(tube({"--set", exactly, "--max-steps", "10"}).status, 0);
  const std::size_t before = outputs(0).size();
  const Outcome restarted =
      run({"--restart", archive(0).string(), "--set", "DataArchiver/outputInterval=0.04"});
  ASSERT_EQ(restarted.status, 0) << restarted.text;
  const std::vector<double> all = outputs(1);
  const double reached = Archive::open(archive(0)).checkpoints().back().time;
  std::vector<double> expected;
  for (int n = 1; n <= 5; ++n)
    if (n * 0.04 > reached) expected.push_back(n * 0.04);
  ASSERT_EQ(all.size(), before + expected.size());
  for (std::size_t n = 0; n < expected.size(); ++n)
    EXPECT_NEAR(all[before + n], expected[n], 1e-15);
}

TEST_F(RestartRuns, WhereNothingIsLeftNothingIsMade) {
  ASSERT_EQ(tube({"--set", "DataArchiver/checkpoint/@lastTimestep=true"}).status, 0);
  const fs::path link = folder_ / "shock_tube.uda";
  const Outcome again = run({"--restart", link.string()});
  EXPECT_EQ(again.status, 0) << again.text;
  EXPECT_THAT(again.text, HasSubstr("nothing is left to do: the checkpoint of step"));
  EXPECT_THAT(again.text, HasSubstr("maxTime = 0.2; no archive is made"));
  EXPECT_EQ(fs::read_symlink(link), "shock_tube.uda.000");
  EXPECT_FALSE(fs::exists(archive(1)));
  const Outcome longer = run({"--restart", link.string(), "--set", "Time/maxTime=0.21"});
  EXPECT_EQ(longer.status, 0) << longer.text;
  EXPECT_THAT(longer.text, Not(HasSubstr("nothing is left")));
  EXPECT_EQ(fs::read_symlink(link), "shock_tube.uda.001");
}

TEST_F(RestartRuns, AFileOfTheArchivesNameIsKept) {
  std::ofstream(folder_ / "shock_tube.uda") << "my notes";
  const Outcome outcome = tube({"--max-steps", "2"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.text, HasSubstr("warning: " + (folder_ / "shock_tube.uda").string() +
                                      " is a file and is kept: no link"));
  EXPECT_EQ(text_of(folder_ / "shock_tube.uda"), "my notes");
}

TEST_F(RestartRuns, AMissingParentIsNamed) {
  ASSERT_EQ(tube({"--max-steps", "10"}).status, 0);
  ASSERT_EQ(run({"--restart", archive(0).string(), "--max-steps", "20"}).status, 0);
  fs::create_directory(folder_ / "elsewhere");
  const fs::path moved = folder_ / "elsewhere/shock_tube.uda.001";
  fs::rename(archive(1), moved);
  const std::string missing = (folder_ / "elsewhere/shock_tube.uda.000").string();
  const Outcome first =
      run_sluice({"extract", moved.string(), "--var", "press_CC", "--time", "first"});
  EXPECT_EQ(first.status, 2);
  EXPECT_THAT(first.text, HasSubstr("is in the archive " + missing));
  EXPECT_THAT(first.text, HasSubstr("--copy"));
  EXPECT_EQ(run_sluice({"extract", moved.string(), "--var", "press_CC", "--time", "last"}).status,
            0);
  const Outcome copy = run({"--restart", moved.string(), "--copy", "--set", "Time/maxTime=0.21"});
  EXPECT_EQ(copy.status, 2) << copy.text;
  EXPECT_THAT(copy.text, HasSubstr(missing));
}

// With its include, its table and the table's folder gone, from another folder, twice.
TEST_F(RestartRuns, AnArchiveKeepsTheFilesThatItsDeckNames) {
  const fs::path deck = folder_ / "deck", away = folder_ / "away";
  fs::create_directories(deck / "tables");
  fs::create_directory(away);
  std::string text = text_of(inputs / "mpm/rigid_piston.ups");
  const std::string name = "rigid_piston.txt";
  text.replace(text.find(name), name.size(), "tables/motion.txt");
  const std::size_t time = text.find("<Time>"), end = text.find("</Time>") + 7;
  std::ofstream(deck / "time.xml")
      << "<Uintah_Include>" + text.substr(time, end - time) + "</Uintah_Include>";
  text.replace(time, end - time, "<include href=\"time.xml\"/>");
  std::ofstream(deck / "piston.ups") << text;
  fs::copy_file(inputs / "mpm" / name, deck / "tables/motion.txt");
  const auto history = [&](int n) {
    return text_of(folder_ / ("solids.uda.00" + std::to_string(n)) / "TotalMomentum.dat");
  };
  ASSERT_EQ(run({(deck / "piston.ups").string(), "--set", "Time/maxTime=0.1"}).status, 0);
  const Outcome first =
      run({(deck / "piston.ups").string(), "--set", "Time/maxTime=0.1", "--max-steps", "10"});
  ASSERT_EQ(first.status, 0) << first.text;
  fs::remove_all(deck);
  // Another table of that name stands where the run goes on.
  fs::create_directory(away / "input_files");
  std::ofstream(away / "input_files/motion.txt") << "0 0 0 0\n9 5 0 0\n";
  const auto go_on = [&](const std::string& from, const std::string& more) {
    return run_in_shell("cd " + away.string() + " && " SLUICE_COMMAND " run --restart " +
                        (folder_ / from).string() + " -o " + folder_.path().string() +
                        " --progress none " + more);
  };
  const Outcome second = go_on("solids.uda.001", "--max-steps 20");
  ASSERT_EQ(second.status, 0) << second.text;
  const Outcome third = go_on("solids.uda.002", "");
  ASSERT_EQ(third.status, 0) << third.text;
  EXPECT_EQ(history(3), history(0));
  EXPECT_EQ(text_of(folder_ / "solids.uda.003/input_files/motion.txt"),
            text_of(inputs / "mpm" / name));
}

TEST_F(RestartRuns, ADeckByALinkFindsItsFilesBesideTheTarget) {
  fs::create_directories(folder_ / "a");
  fs::create_directories(folder_ / "b");
  for (const char* file : {"rigid_piston.ups", "rigid_piston.txt"})
    fs::copy_file(inputs / "mpm" / file, folder_ / "a" / file);
  std::string text = text_of(folder_ / "a/rigid_piston.ups");
  const std::size_t time = text.find("<Time>"), end = text.find("</Time>") + 7;
  std::ofstream(folder_ / "a/time.xml")
      << "<Uintah_Include>" + text.substr(time, end - time) + "</Uintah_Include>";
  text.replace(time, end - time, "<include href=\"time.xml\"/>");
  std::ofstream(folder_ / "a/deck.ups") << text;
  fs::create_symlink("../a/deck.ups", folder_ / "b/link.ups");
  const Outcome outcome = run_sluice({"check", (folder_ / "b/link.ups").string()});
  EXPECT_EQ(outcome.status, 0) << outcome.text;
}

// More threads than processors only wait for each other.
TEST_F(RestartRuns, ThreadsBeyondTheProcessorsAreNotMade) {
  const Outcome many = tube({"--threads", "9999", "--json", "-"});
  EXPECT_EQ(many.status, 0);
  EXPECT_THAT(many.text, HasSubstr("note: --threads 9999: this process has "));
  EXPECT_THAT(many.text, Not(HasSubstr("\"threads\": 9999")));
}

TEST_F(RestartRuns, WhatDoesNotFitIntoMemoryIsToldBeforeItStarts) {
  const Outcome outcome = tube({"--set", "Grid/Level/Box/resolution=[6000,3000,3000]"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.text, HasSubstr("the run needs "));
  EXPECT_THAT(outcome.text, HasSubstr(" TiB of memory at its peak, but "));
  EXPECT_THAT(outcome.text, HasSubstr("--any-memory starts it nevertheless"));
  EXPECT_FALSE(fs::exists(archive(0)));
}

#ifndef __SANITIZE_ADDRESS__  // which reserves all addresses
TEST_F(RestartRuns, LimitsOfAProcessCountAndMayBeTried) {
  const std::string run = "ulimit -v 1000000; " SLUICE_COMMAND " run " +
                          (inputs / "ice/shock_tube.ups").string() +
                          " --set Grid/Level/Box/resolution=[20000000,1,1] --no-output "
                          "--progress none --max-steps 1 ";
  const Outcome told = run_in_shell(run);
  EXPECT_EQ(told.status, 2) << told.text;
  EXPECT_THAT(told.text, HasSubstr("976.6 MiB are the limit on addresses (ulimit -v)"));
  const Outcome tried = run_in_shell(run + "--any-memory");
  EXPECT_EQ(tried.status, 3) << tried.text;
  EXPECT_THAT(tried.text, Not(HasSubstr("the run needs")));
}
#endif

}  // namespace
}  // namespace sluice::restart_runs_test
