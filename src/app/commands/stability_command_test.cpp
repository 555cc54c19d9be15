// sluice stability turns red when it should, and says so: a wrong bound of the step, a front that
// falls apart, what does not hold; what it records and compares; bad requests.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/command/command_test_support.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::stability_command_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class StabilityCommand : public testing::Test {
 protected:
  // A case of Sod's tube on 40 cells in the folder cases/.
  void write_case(const std::string& must_hold, const std::string& sweeps,
                  const std::string& name = "tube") const {
    fs::create_directories(folder_ / "cases");
    std::ofstream(folder_ / "cases" / (name + ".stability")) << fmt::format(
        R"({{"title": "Tube", "component": "fluid", "deck": "{}/inputs/ice/riemann_sod.ups",
             "set": "Grid/Level/Box/resolution=[40,1,1]", "quick": true,
             "must_hold": [{}], "sweeps": [{}]}})",
        SLUICE_SOURCE_DIR, must_hold, sweeps);
  }
  int stability(std::vector<std::string> words = {}) {
    words.insert(words.begin(), {"stability", "--cases", (folder_ / "cases").string(), "-o",
                                 (folder_ / "out").string(), "--no-picture"});
    const Outcome outcome = run_sluice(words);
    said_ = outcome.text;
    return outcome.status;
  }
  nlohmann::json map() const {
    return nlohmann::json::parse(text_of(folder_ / "out" / "stability.json"));
  }

  TemporaryFolder folder_;
  std::string said_;
};

// Exactly, density lies in 0.125 ... 1.
const char* const right_bound =
    R"({"variable": "rho_CC", "at_least": 0.1249, "at_most": 1.0001, "when": "always"})";

TEST_F(StabilityCommand, WhatHoldsIsGreenAndWhatDoesNotIsRedWithItsPlace) {
  write_case(right_bound, "");
  EXPECT_EQ(stability(), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("1 of 1 defaults hold"));
  write_case(R"({"variable": "rho_CC", "at_most": 0.9})", "");
  EXPECT_EQ(stability(), 1);
  EXPECT_THAT(said_, HasSubstr("rho_CC of material 0: at most 0.9 at the end: found"));
  EXPECT_THAT(said_, HasSubstr("cell ["));
  EXPECT_EQ(map()["cases"][0]["runs"][0]["verdict"], "red");
}

// The bound of the step is five times that of deck and scheme: steps are redone, if no more.
TEST_F(StabilityCommand, AWrongBoundOfTheStepIsNotGreen) {
  write_case(right_bound, R"({"name": "bound", "default": "1",
    "values": {"1": "Time/timestep_multiplier=1", "5": "Time/timestep_multiplier=5"}})");
  EXPECT_EQ(stability(), 0) << said_;
  const auto runs = map()["cases"][0]["runs"];
  EXPECT_EQ(runs[0]["verdict"], "green");
  EXPECT_NE(runs[1]["verdict"], "green") << said_;
}

TEST_F(StabilityCommand, VerdictsAreRecordedAndCompared) {
  const std::string record = (folder_ / "recorded.json").string();
  write_case(right_bound, "");
  EXPECT_EQ(stability({"--record", record}), 0);
  EXPECT_EQ(stability({"--against", record}), 0);
  EXPECT_THAT(said_, HasSubstr("no verdict differs"));
  write_case(R"({"variable": "rho_CC", "at_most": 0.9})", "");
  EXPECT_EQ(stability({"--against", record}), 1);
  EXPECT_THAT(said_, HasSubstr("worse: tube, default: red, was green"));
}

TEST_F(StabilityCommand, BadRequestsAreRefused) {
  write_case(right_bound, "");
  EXPECT_EQ(stability({"tub"}), 2);
  EXPECT_THAT(said_, HasSubstr("did you mean 'tube'"));
  EXPECT_EQ(stability({"--set", "a=1"}), 2);
  EXPECT_EQ(stability({"--against", "/nowhere.json"}), 2);
  write_case(R"({"variable": "rho", "at_most": 1})", "");
  EXPECT_EQ(stability(), 2);
  EXPECT_THAT(said_, HasSubstr("there is no 'rho' of material 0"));
  write_case(R"({"quantity": "mass", "drift_at_most": 1})", "");
  EXPECT_EQ(stability(), 2);
  EXPECT_THAT(said_, HasSubstr("no conserved quantity \"mass\""));
}

TEST_F(StabilityCommand, ADeckIsSweptAndItsDistanceToFailureTold) {
  fs::create_directories(folder_ / "cases");
  EXPECT_EQ(stability({SLUICE_SOURCE_DIR "/inputs/ice/riemann_sod.ups", "--set",
                       "Grid/Level/Box/resolution=[40,1,1]"}),
            0)
      << said_;
  EXPECT_THAT(said_, HasSubstr("step: "));
  EXPECT_THAT(said_, HasSubstr("resolution: holds up to factor 0.5"));
  EXPECT_THAT(said_, HasSubstr("nothing to stiffen"));
}

}  // namespace
}  // namespace sluice::stability_command_test
