// sluice accuracy on a corner of the study of Sod's tube: numbers, orders, files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "app/process/study_process.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::verification::accuracy_command_test {
namespace {

namespace fs = std::filesystem;

class Accuracy : public testing::Test {
 protected:
  int accuracy(const std::vector<std::string>& words) const {
    ProcessRequest request;
    request.words = {command_, "accuracy"};
    request.words.insert(request.words.end(), words.begin(), words.end());
    request.output = folder_ / "log";
    return run_process(request);
  }
  std::string log() const { return last_lines(folder_ / "log", 1000); }

  std::string command_ = SLUICE_COMMAND;
  const std::string study_ = std::string(SLUICE_SOURCE_DIR) + "/regression/accuracy/sod.study";
  TemporaryFolder folder_{TemporaryFolder::Place::disk};
};

TEST_F(Accuracy, CornerOfTheSodStudy) {
  const fs::path out = folder_ / "out";
  ASSERT_EQ(accuracy({study_, "-o", out.string(), "--repeat", "1", "--only",
                      "*order [12], CFL 0.8, N [124]00"}),
            0)
      << log();
  std::ifstream in(out / "sod.json");
  const auto json = nlohmann::json::parse(in);
  const auto& rows = json.at("rows");
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[4].at("setting"), "order 2, CFL 0.8");
  EXPECT_EQ(rows[4].at("cells"), 200);
  EXPECT_TRUE(rows[4].at("default").get<bool>());
  EXPECT_LE(rows[4].at("error").get<double>(), 1.25 * 2.59e-3);
  EXPECT_GT(rows[4].at("seconds").get<double>(), 0);
  EXPECT_GT(rows[4].at("order").get<double>(), .6);
  // First order costs accuracy: at equal resolution it is worse by far.
  EXPECT_GT(rows[1].at("error").get<double>(), 2 * rows[4].at("error").get<double>());
  EXPECT_THAT(log(), testing::HasSubstr("cheapest setting"));
  EXPECT_TRUE(fs::exists(out / "sod.csv"));
  EXPECT_TRUE(fs::exists(out / "sod.png")) << log();
  EXPECT_FALSE(fs::exists(out / "run"));  // archives are not kept
}

// A detonation has no exact solution here: the error is that from a finer run.
TEST_F(Accuracy, AgainstAReferenceRun) {
  const fs::path out = folder_ / "out", study = folder_ / "stick.study";
  std::ofstream(study) << R"({"title": "Rate stick", "variable": "press_CC", "deck": ")"
                       << SLUICE_SOURCE_DIR << R"(/inputs/ice/rate_stick.ups",
      "set": ["Time/maxTime=5e-6"], "resolution": [[50,1,1], [100,1,1]],
      "reference": {"resolution": [200,1,1]}})";
  ASSERT_EQ(accuracy({study.string(), "-o", out.string(), "--repeat", "1"}), 0) << log();
  EXPECT_THAT(log(), testing::HasSubstr("reference, N 200:"));
  std::ifstream in(out / "stick.json");
  const auto json = nlohmann::json::parse(in);
  const auto& rows = json.at("rows");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_GT(rows[1].at("error").get<double>(), 0);
  EXPECT_LT(rows[1].at("error").get<double>(), rows[0].at("error").get<double>());
}

TEST_F(Accuracy, WithoutThePythonToolsTheNumbersAreStillThere) {
  fs::create_directories(folder_ / "bin");
  command_ = (folder_ / "bin" / "sluice").string();
  fs::copy_file(SLUICE_COMMAND, command_);
  const fs::path out = folder_ / "out";
  ASSERT_EQ(
      accuracy({study_, "-o", out.string(), "--repeat", "1", "--only", "order 2, CFL 0.4, N 100"}),
      0)
      << log();
  EXPECT_THAT(log(),
              testing::HasSubstr("warning: no picture: the Python tools are not installed with"));
  EXPECT_TRUE(fs::exists(out / "sod.json"));
  EXPECT_FALSE(fs::exists(out / "sod.png"));
}

TEST_F(Accuracy, BadStudiesAndPatternsAreRefused) {
  EXPECT_EQ(accuracy({(folder_ / "no.study").string()}), 2);
  EXPECT_EQ(accuracy({study_, "-o", (folder_ / "out").string(), "--only", "order 7"}), 2);
  EXPECT_THAT(log(), testing::HasSubstr("matches none of the 54 runs"));
}

}  // namespace
}  // namespace sluice::verification::accuracy_command_test
