// Looking at runs of solids: histories of single particles, plans, reports, tables and files for
// other programs, each against the archive or the run itself.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/command/command_test_support.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::solid_looking_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string disks = SLUICE_SOURCE_DIR "/inputs/mpm/colliding_disks.ups";

// Numbers of the lines of a text that do not begin with '#'.
std::vector<std::vector<double>> table_of(std::string text) {
  std::vector<std::vector<double>> table;
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::vector<double> row;
    for (double x = 0; words >> x;) row.push_back(x);
    if (!row.empty()) table.push_back(std::move(row));
  }
  return table;
}

class SolidRuns : public testing::Test {
 protected:
  // The archive of a run of the disks until they touch, coarse, in a folder of this name.
  fs::path run(const std::string& name, std::vector<std::string> more = {}) {
    const fs::path folder = folder_ / name;
    fs::create_directories(folder);
    std::vector<std::string> words = {"run", disks, "-o", folder.string(), "--progress", "none"};
    for (const char* one :
         {"Grid/Level/Box/resolution=[20,20,1]", "Time/maxTime=1.2",
          "DataArchiver/outputInterval=0.4", "DataAnalysis/Module/samplingFrequency=1e9",
          "DataArchiver/checkpoint/@timestepInterval=10", "DataArchiver/checkpoint/@cycle=0"})
      words.insert(words.end(), {"--set", one});
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_sluice(words);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    return folder / "colliding_disks.uda.000";
  }
  static std::map<std::string, std::string> histories(const fs::path& archive) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(archive / "particleExtract"))
      if (entry.is_regular_file())
        files[fs::relative(entry.path(), archive).string()] = text_of(entry.path());
    return files;
  }
  TemporaryFolder folder_;
};

// The four particles of colour 1 stand in the middle of one disk.
TEST_F(SolidRuns, ParticlesAboveTheThresholdAreFollowed) {
  const fs::path archive = run("plain");
  const auto files = histories(archive);
  ASSERT_EQ(files.size(), 4U);
  const Outcome stress =
      run_sluice({"extract", archive.string(), "--var", "p.stress", "--csv", "-"});
  EXPECT_THAT(stress.text, HasSubstr("value_xx,value_xy,value_xz,value_yx,value_yy,value_yz,"
                                     "value_zx,value_zy,value_zz"));
  const auto saved = table_of(stress.text);
  for (const auto& [name, text] : files) {
    EXPECT_THAT(name, HasSubstr("particleExtract/L-0/"));
    EXPECT_THAT(text, HasSubstr("# time x y z p.velocity.x p.velocity.y p.velocity.z p.stress.xx"));
    const auto rows = table_of(text);
    const double id = std::stod(name.substr(name.rfind('/') + 1));
    ASSERT_GT(rows.size(), 20U);
    ASSERT_EQ(rows.back().size(), 16U);
    bool found = false;
    for (const auto& of_archive : saved) {
      if (of_archive[3] != id) continue;
      found = true;
      EXPECT_EQ(of_archive[0], rows.back()[0]) << "the time";
      for (std::size_t d = 0; d < 3; ++d) EXPECT_EQ(of_archive[4 + d], rows.back()[1 + d]);
      for (std::size_t c = 0; c < 9; ++c) EXPECT_EQ(of_archive[7 + c], rows.back()[7 + c]);
    }
    EXPECT_TRUE(found) << name;
  }
}

TEST_F(SolidRuns, HistoriesDependOnNeitherBoxesNorRestarts) {
  const auto plain = histories(run("plain"));
  EXPECT_EQ(histories(run("boxes", {"--boxes", "3,4,1", "--threads", "2"})), plain);
  const fs::path half = run("half", {"--max-steps", "25"});
  const Outcome rest = run_sluice({"run", "--restart", half.string(), "--step", "21", "-o",
                                   (folder_ / "rest").string(), "--progress", "none"});
  ASSERT_EQ(rest.status, 0) << rest.text;
  fs::path later;
  for (const auto& entry : fs::directory_iterator(folder_ / "rest"))
    if (entry.is_directory() && !entry.is_symlink()) later = entry.path();
  EXPECT_EQ(histories(later), plain);
}

TEST_F(SolidRuns, WhatCannotBeFollowedIsRefused) {
  const auto said = [](const std::string& set) {
    const Outcome plan = run_sluice({"plan", disks, "--set", set});
    EXPECT_EQ(plan.status, 2) << set;
    return plan.text;
  };
  EXPECT_THAT(said("DataAnalysis/Module/Variables/analyze[1]/@label=p.velocitty"),
              HasSubstr("names no field of this run; did you mean 'p.velocity'"));
  EXPECT_THAT(said("MPM/withColor=false"), HasSubstr("write <withColor>true</withColor> in <MPM>"));
}

TEST_F(SolidRuns, ThePlanCountsParticlesAndTheFirstStep) {
  const Outcome plan = run_sluice({"plan", disks, "--json"});
  ASSERT_EQ(plan.status, 0) << plan.text;
  const auto json = nlohmann::json::parse(plan.text, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << plan.text;
  EXPECT_EQ(json.at("particles").at(0).at("count"), 1624);
  EXPECT_GT(json.at("memory").at("particles"), 0);
  EXPECT_THAT(json.at("stages").dump(), HasSubstr("particles to grid"));
  const fs::path record = folder_ / "run.json";
  const Outcome run =
      run_sluice({"run", disks, "--no-output", "--max-steps", "1", "--json", record.string()});
  ASSERT_EQ(run.status, 0) << run.text;
  EXPECT_THAT(run.text, HasSubstr("; 1,624 particles, "));
  EXPECT_THAT(run.text, Not(HasSubstr("ns per cell")));
  const auto told = nlohmann::json::parse(text_of(record));
  EXPECT_EQ(told.at("particle_updates"), 1624);
  EXPECT_GT(told.at("ns_per_particle_step"), 0);
  EXPECT_EQ(told.at("time"), json.at("time_step").at("first_step"));
}

TEST_F(SolidRuns, TensorsAreComparedAndExported) {
  const char* const step = "Time/delt_max=0.01";  // of both
  const fs::path archive = run("plain", {"--set", step});
  const fs::path other = run("other", {"--set", step, "--set", "MPM/interpolator=linear"});
  const auto compared = [&](const fs::path& with) {
    return run_sluice({"compare", "--vars", "p.stress", archive.string(), with.string()});
  };
  EXPECT_EQ(compared(archive).status, 0);
  const Outcome differing = compared(other);
  EXPECT_EQ(differing.status, 1) << differing.text;
  EXPECT_THAT(differing.text, HasSubstr("p.stress"));
  const fs::path files = folder_ / "vtk";
  const Outcome exported =
      run_sluice({"export", archive.string(), "--time", "last", "-o", files.string()});
  ASSERT_EQ(exported.status, 0) << exported.text;
  std::string particles;
  for (const auto& entry : fs::recursive_directory_iterator(files))
    if (entry.path().extension() == ".vtp") particles += text_of(entry.path());
  EXPECT_THAT(particles, testing::ContainsRegex("Name=\"p.stress\"[^>]*NumberOfComponents=\"9\""));
}

}  // namespace
}  // namespace sluice::solid_looking_test
