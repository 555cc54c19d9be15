// sluice regress fails when it should: changed, missing and spoilt golden files, bad lists.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "app/command/command_test_support.hpp"
#include "app/regress/golden.hpp"
#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::regress_command_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RegressCommand : public testing::Test {
 protected:
  RegressCommand() {
    list(R"("set": ["Grid/Level/Box/resolution=[20,1,1]"], "variables": ["rho_CC", "vel_CC"],
            "restart": 5, "boxes": "3,1,1")");
  }

  void list(const std::string& entries) {
    std::ofstream(folder_ / "cases.json")
        << "// a comment\n{\"cases\": [{\"name\": \"tube\", \"deck\": \"" << SLUICE_SOURCE_DIR
        << "/inputs/ice/riemann_sod.ups\", " << entries << "}]}\n";
  }
  int regress(std::vector<std::string> words = {}) {
    words.insert(words.begin(), {"regress", "--cases", (folder_ / "cases.json").string()});
    const Outcome outcome = run_sluice(words);
    said_ = outcome.text;
    return outcome.status;
  }
  fs::path golden() const { return folder_ / "tube.csv"; }

  TemporaryFolder folder_;
  std::string said_;
};

TEST_F(RegressCommand, AGoldenIsMissedThenBlessedThenMet) {
  EXPECT_EQ(regress(), 1);
  EXPECT_THAT(said_, HasSubstr("--bless writes it"));
  EXPECT_FALSE(fs::exists(golden())) << "only --bless may write it";
  EXPECT_EQ(regress({"--bless"}), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("blessed"));
  const std::string blessed = text_of(golden());
  EXPECT_EQ(regress(), 0) << said_;
  EXPECT_EQ(text_of(golden()), blessed);
}

TEST_F(RegressCommand, OneChangedValueOrStepFails) {
  ASSERT_EQ(regress({"--bless"}), 0) << said_;
  const Golden good = read_golden(golden());
  Golden changed = good;
  changed.tables[0].rows[7].values[0] *= 1 + 1e-8;
  write_golden(changed, golden());
  EXPECT_EQ(regress(), 1);
  EXPECT_THAT(said_, HasSubstr("rho_CC, material 0, level 0: value differs in 1 of 20 values, most "
                               "in [7,0,0]"));
  changed = good;
  changed.tables[0].rows[7].values[0] *= 1 + 1e-11;  // round-off of another processor
  write_golden(changed, golden());
  EXPECT_EQ(regress(), 0) << said_;
  changed = good;
  changed.steps += 1;
  write_golden(changed, golden());
  EXPECT_EQ(regress(), 1);
  EXPECT_THAT(said_, HasSubstr("the golden run has"));
}

// A golden result of some output on the way says nothing about the end.
TEST_F(RegressCommand, AGoldenThatIsNotOfTheEndIsInvalid) {
  ASSERT_EQ(regress({"--bless"}), 0) << said_;
  Golden early = read_golden(golden());
  early.steps = 1;
  early.time *= 0.01;
  write_golden(early, golden());
  EXPECT_EQ(regress(), 2);
  EXPECT_THAT(said_, HasSubstr("is of step 1 at t = 0.002, but the run ended at step"));
  list(R"("set": ["Grid/Level/Box/resolution=[20,1,1]", "DataArchiver/outputLastTimestep=false",
          "DataArchiver/outputInterval=9"], "variables": ["rho_CC"])");
  EXPECT_EQ(regress({"--bless"}), 2);
  EXPECT_THAT(said_, HasSubstr("the last output is of step 1, but the run ended at step"));
}

// Of the public suite: its only output is at the end of a run five times as long.
TEST_F(RegressCommand, TheEndOfAShortenedRunIsCompared) {
  const char* decks = std::getenv("SLUICE_DECKS");
  if (decks == nullptr) GTEST_SKIP() << "SLUICE_DECKS names no folder of decks";
  const auto list = [&](const std::string& more) {
    std::ofstream(folder_ / "cases.json")
        << R"({"cases": [{"name": "tube", "deck": ")" << decks << R"(/inputs/ICE/riemann_sm.ups",)"
        << R"("set": ["Time/maxTime=1e-4")" << more
        << R"(], "variables": ["press_CC", "rho_CC", "vel_CC", "temp_CC"]}]})";
  };
  list("");
  ASSERT_EQ(regress({"--bless"}), 0) << said_;
  EXPECT_NEAR(read_golden(golden()).time, 1e-4, 1e-18);
  EXPECT_EQ(regress(), 0) << said_;
  for (const char* more : {R"(, "CFD/cfl=0.2")", R"(, "CFD/ICE/advection/@type=FirstOrder")"}) {
    list(more);
    EXPECT_EQ(regress(), 1) << more << said_;
  }
}

// Both materials, both levels; each change is found.
TEST_F(RegressCommand, EveryMaterialAndLevelIsCompared) {
  std::ofstream(folder_ / "cases.json")
      << "{\"cases\": [{\"name\": \"tube\", \"deck\": \"" << SLUICE_SOURCE_DIR
      << "/inputs/ice/amr_water_square.ups\", \"set\": [\"Time/max_Timesteps=2\"], "
         "\"variables\": [\"rho_CC\"]}]}\n";
  ASSERT_EQ(regress({"--bless"}), 0) << said_;
  const Golden good = read_golden(golden());
  std::set<std::string> titles;
  for (const GoldenTable& table : good.tables) titles.insert(table.title);
  for (const char* title : {"rho_CC, material 0, level 0", "rho_CC, material 1, level 0",
                            "rho_CC, material 0, level 1", "rho_CC, material 1, level 1"})
    EXPECT_EQ(titles.count(title), 1U) << title;
  for (std::size_t t = 0; t < good.tables.size(); ++t) {
    Golden changed = good;
    changed.tables[t].rows[5].values[0] += 1;
    write_golden(changed, golden());
    EXPECT_EQ(regress(), 1);
    EXPECT_THAT(said_, HasSubstr(good.tables[t].title + ": value differs in 1 of"));
  }
}

TEST_F(RegressCommand, AChangedDeckFails) {
  ASSERT_EQ(regress({"--bless"}), 0) << said_;
  list(R"("set": ["Grid/Level/Box/resolution=[20,1,1]", "CFD/cfl=0.3"],
          "variables": ["rho_CC", "vel_CC"])");
  EXPECT_EQ(regress(), 1);
}

TEST_F(RegressCommand, ARunThatFailsFails) {
  list(R"("set": ["CFD/cfl=-1"], "variables": ["rho_CC"])");
  EXPECT_EQ(regress({"--bless"}), 1);
  EXPECT_THAT(said_, HasSubstr("ended with status 2"));
  EXPECT_FALSE(fs::exists(golden()));
}

TEST_F(RegressCommand, AsJson) {
  ASSERT_EQ(regress({"--bless", "--json"}), 0) << said_;
  const auto report = nlohmann::json::parse(said_);
  const auto& checks = report.at("cases").at(0).at("checks");
  EXPECT_EQ(checks.at("golden").at("verdict"), "blessed");
  EXPECT_EQ(checks.at("restart").at("verdict"), "same");
  EXPECT_EQ(checks.at("boxes").at("verdict"), "same");
  EXPECT_EQ(checks.at("ranks").at("verdict"), "-");
}

TEST_F(RegressCommand, BadListsAndFilesAreRefused) {
  EXPECT_EQ(regress({"tub"}), 2);
  EXPECT_THAT(said_, HasSubstr("did you mean 'tube'"));
  list(R"("variables": ["rho_CC"], "tolerence": 1)");
  EXPECT_EQ(regress(), 2);
  EXPECT_THAT(said_, HasSubstr("tolerence"));
  list(R"("variables": [])");
  EXPECT_EQ(regress(), 2);
  list(R"("variables": ["rho_CC"], "ranks": 2)");
  EXPECT_EQ(regress(), 2);
  EXPECT_THAT(said_, HasSubstr("ranks needs boxes"));
  list(R"("variables": ["rho_CC"], "restart": 1)");
  EXPECT_EQ(regress(), 2);
  std::ofstream(folder_ / "cases.json") << "{";
  EXPECT_EQ(regress(), 2);
  fs::remove(folder_ / "cases.json");
  EXPECT_EQ(regress(), 2);
  EXPECT_THAT(said_, HasSubstr("no such file"));
}

TEST_F(RegressCommand, SpoiltGoldenFilesAreRefused) {
  const auto message = [&](const std::string& text) {
    std::ofstream(golden()) << text;
    try {
      read_golden(golden());
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("it was read");
  };
  const std::string start = "# sluice golden: steps 3, time 0.5\n",
                    head = start + "# rho_CC, material 0, level 0\ni,j,k,value\n";
  EXPECT_EQ(message(head + "0,0,0,1\n"), "it was read");
  EXPECT_EQ(message(start + "# p.mass, material 1\nid,value\n7,1\n"), "it was read");
  EXPECT_THAT(message("level,i\n"), HasSubstr("first line"));
  EXPECT_THAT(message(start), HasSubstr("no tables"));
  EXPECT_THAT(message(start + "0,0,0,1\n"), HasSubstr(":2: a table begins with"));
  EXPECT_THAT(message(start + "# rho_CC\ni,j,k\n"), HasSubstr(":3: no columns"));
  EXPECT_THAT(message(head + "0,0,0\n"), HasSubstr(":4: 3 values instead of 4"));
  EXPECT_THAT(message(head + "0,0,0,1\n1,0,0,x\n"), HasSubstr(":5: 'x' is not a number"));
}

TEST_F(RegressCommand, ParticlesAreComparedByTheirNumbers) {
  std::ofstream(folder_ / "cases.json")
      << "{\"cases\": [{\"name\": \"tube\", \"deck\": \"" << SLUICE_SOURCE_DIR
      << "/inputs/mpm/free_bar.ups\", \"set\": [\"Time/maxTime=0.1\"], "
         "\"variables\": [\"p.displacement\", \"p.mass\"]}]}\n";
  ASSERT_EQ(regress({"--bless"}), 0) << said_;
  EXPECT_EQ(regress(), 0) << said_;
  Golden changed = read_golden(golden());
  ASSERT_EQ(changed.tables.size(), 2U);
  EXPECT_EQ(changed.tables[0].title, "p.displacement, material 0");
  ASSERT_GT(changed.tables[0].rows.size(), 3U);
  changed.tables[0].rows[3].values[0] += 1e-3;
  write_golden(changed, golden());
  EXPECT_EQ(regress(), 1);
  EXPECT_THAT(said_, HasSubstr("p.displacement, material 0: x differs in 1 of "));
  EXPECT_THAT(said_, HasSubstr(fmt::format("particle {}", changed.tables[0].rows[3].place[0])));
}

TEST_F(RegressCommand, AVariableThatIsNotSavedFails) {
  list(R"("set": ["Grid/Level/Box/resolution=[20,1,1]"], "variables": ["no_such"])");
  EXPECT_EQ(regress({"--bless"}), 1);
  EXPECT_THAT(said_, HasSubstr("has no label no_such"));
  EXPECT_FALSE(fs::exists(golden()));
}

TEST_F(RegressCommand, AnotherBuildMustGiveTheSameBits) {
  ASSERT_EQ(regress({"--bless", "--against", SLUICE_COMMAND}), 0) << said_;
  EXPECT_EQ(regress({"--against", "no/such/sluice"}), 2);
  EXPECT_THAT(said_, HasSubstr("there is no such file"));
  EXPECT_EQ(regress({"--against", "/bin/false"}), 1);
  EXPECT_THAT(said_, HasSubstr("the against run ended with status 1"));
}

TEST(GoldenDifference, NaNIsADifference) {
  Golden a;
  a.steps = 1;
  a.tables = {{"rho_CC", {"i", "j", "k", "value"}, {{{0, 0, 0}, {1.0}}, {{1, 0, 0}, {2.0}}}}};
  Golden b = a;
  EXPECT_EQ(golden_difference(a, b, 1e-9), "");
  b.tables[0].rows[1].values[0] = std::nan("");
  EXPECT_THAT(golden_difference(a, b, 1e-9), HasSubstr("differs in 1 of 2 values"));
}

}  // namespace
}  // namespace sluice::regress_command_test
