// sluice regress FOLDER: gold that --bless wrote, archives of a user's own runs, .dat files of
// another program, small files and lists of the public suite; and what has moved, told.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/command/command_test_support.hpp"
#include "app/regress/regress_folder.hpp"
#include "app/regress/regress_keys.hpp"
#include "app/regress/suite_list.hpp"
#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::regress_folder_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class RegressFolder : public testing::Test {
 protected:
  RegressFolder() {
    fs::create_directories(folder_ / "decks");
    set_deck("<cfl>0.4</cfl>");
  }
  // Sod's tube of 20 cells with this Courant number.
  void set_deck(const std::string& cfl) {
    std::string text = text_of(std::string(SLUICE_SOURCE_DIR) + "/inputs/ice/riemann_sod.ups");
    const auto replace = [&](const std::string& from, const std::string& to,
                             const std::string& by) {
      const std::size_t at = text.find(from), end = text.find(to, at) + to.size();
      ASSERT_LT(at, end) << from;
      text.replace(at, end - at, by);
    };
    replace("<resolution>", "</resolution>", "<resolution>[20,1,1]</resolution>");
    replace("<cfl>", "</cfl>", cfl);
    replace("<save label=\"rho_CC\"/>", "/>",
            "<save label=\"rho_CC\"/><save label=\"KineticEnergy\"/>");
    std::ofstream(deck()) << text;
  }
  fs::path deck() const { return folder_ / "decks" / "tube.ups"; }
  fs::path beside(const std::string& name) const { return folder_ / "decks" / name; }
  json regress(int status, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"regress", (folder_ / "decks").string(), "--json"});
    const Outcome outcome = run_sluice(more);
    EXPECT_EQ(outcome.status, status) << outcome.text;
    said_ = outcome.text;
    const json read = json::parse(outcome.text, nullptr, false);
    return read.is_discarded() ? json() : read.at("cases").at(0);
  }

  TemporaryFolder folder_{TemporaryFolder::Place::disk};
  std::string said_;
};

TEST_F(RegressFolder, WithoutGoldItFailsThenIsBlessedThenSame) {
  EXPECT_THAT(regress(1).dump(), HasSubstr("there is no gold beside"));
  EXPECT_EQ(regress(0, {"--bless"}).at("checks").at("outputs").at("verdict"), "blessed");
  EXPECT_TRUE(fs::exists(beside("tube.uda") / "index.xml"));
  const json same = regress(0);
  for (const char* check : {"outputs", "histories", "restart"})
    EXPECT_EQ(same.at("checks").at(check).at("verdict"), "same") << check << same.dump();
  EXPECT_THAT(same.at("checks").at("cost").at("message").get<std::string>(), HasSubstr(" on "));
}

TEST_F(RegressFolder, WhatMovedIsToldWithPlaceTimeAndSize) {
  regress(0, {"--bless"});
  set_deck("<cfl>0.2</cfl>");
  const fs::path page = folder_ / "page.html";
  const json moved = regress(1, {"--html", page.string()});
  const json& outputs = moved.at("checks").at("outputs");
  EXPECT_EQ(outputs.at("verdict"), "DIFFERENT");
  ASSERT_FALSE(outputs.at("moved").empty());
  for (const json& m : outputs.at("moved")) {
    EXPECT_THAT(m.at("where").get<std::string>(), HasSubstr("level 0 at ["));
    EXPECT_NEAR(m.at("change").get<double>(),
                m.at("after").get<double>() - m.at("before").get<double>(), 1e-15);
    EXPECT_GT(m.at("time").get<double>(), 0);
  }
  EXPECT_EQ(moved.at("checks").at("histories").at("verdict"), "DIFFERENT");
  const std::string html = text_of(page);
  for (const char* part : {"<!DOCTYPE html>", "tube", "rho_CC of material 0", "</html>"})
    EXPECT_THAT(html, HasSubstr(part));
  // Wide enough tolerances, in the small file.
  std::ofstream(beside("tube.json")) << R"({"tolerance": 10, "absolute": 10, "restart": false})";
  const json loose = regress(0);
  EXPECT_EQ(loose.at("checks").at("restart").at("verdict"), "-");
  // Of one label alone, and without it.
  std::ofstream(beside("tube.json"))
      << R"({"tolerance": 10, "absolute": 10, "restart": false, "tolerances": {"rho_CC": 0}})";
  regress(0);  // the absolute bound holds for it too
  std::ofstream(beside("tube.json"))
      << R"({"tolerance": 10, "restart": false, "tolerances": {"rho_CC": 0}})";
  for (const json& m : regress(1).at("checks").at("outputs").at("moved"))
    EXPECT_EQ(m.at("label"), "rho_CC of material 0");
  std::ofstream(beside("tube.json"))
      << R"({"tolerance": 10, "restart": false, "exclude": ["rho_CC"]})";
  EXPECT_EQ(regress(0).at("checks").at("outputs").at("verdict"), "same");
}

// As of another program: .dat files alone, beside input_as_run.xml, at other times. Every third
// line and the last, all values 1 % larger.
TEST_F(RegressFolder, HistoriesOfAnotherProgramAreComparedAtTheSameTimes) {
  fs::rename(deck(), beside("input_as_run.xml"));
  const Outcome plain =
      run_sluice({"run", beside("input_as_run.xml").string(), "-o", folder_.string(), "--progress",
                  "none", "--json", (folder_ / "run.json").string()});
  ASSERT_EQ(plain.status, 0) << plain.text;
  const std::string archive =
      json::parse(text_of(folder_ / "run.json")).at("archive").get<std::string>();
  std::ifstream in(archive + "/KineticEnergy.dat");
  std::vector<std::pair<double, double>> lines;
  for (double time, value; in >> time >> value;) lines.emplace_back(time, value);
  ASSERT_GT(lines.size(), 10U);
  std::ofstream out(beside("KineticEnergy.dat"));
  for (std::size_t n = 0; n < lines.size(); ++n)
    if (n % 3 == 0 || n + 1 == lines.size())
      out << fmt::format("{:.17g}\t{:.17g}\n", lines[n].first, 1.01 * lines[n].second);
  out.close();
  const json read = regress(1);
  EXPECT_EQ(read.at("name"), "decks");
  const json& moved = read.at("checks").at("histories").at("moved").at(0);
  EXPECT_EQ(moved.at("label"), "KineticEnergy.dat");
  EXPECT_THAT(moved.at("where").get<std::string>(), HasSubstr("between lines"));
  EXPECT_NEAR(moved.at("relative").get<double>(), 0.01 / 1.01, 1e-4);
  std::ofstream(beside("input_as_run.json")) << R"({"tolerance": 0.011})";
  EXPECT_EQ(regress(0).at("checks").at("histories").at("verdict"), "same");
}

TEST_F(RegressFolder, BadFilesAreRefused) {
  std::ofstream(beside("tube.json")) << R"({"tolerence": 1})";
  regress(2);
  EXPECT_THAT(said_, HasSubstr("did you mean 'tolerance'"));
  std::ofstream(beside("tube.json")) << R"({"gold": "nowhere.uda"})";
  regress(2);
  EXPECT_THAT(said_, HasSubstr("there is no"));
  fs::remove(deck());
  regress(2);
  EXPECT_THAT(said_, HasSubstr("holds no deck"));
}

TEST_F(RegressFolder, EveryKeyIsInTheHelpAndOnThePage) {
  const std::string help = run_sluice({"regress", "--help"}).text,
                    page = text_of(std::string(SLUICE_SOURCE_DIR) + "/docs/plan_and_costs.md");
  for (const RegressKey& key : regress_keys()) {
    EXPECT_THAT(help, HasSubstr(fmt::format("  {} ", key.name)));
    EXPECT_THAT(page, HasSubstr(fmt::format("| `{}` |", key.name)));
  }
}

// Entries as the suite has them; comments and other code are left out.
TEST_F(RegressFolder, ListsOfThePublicSuiteAreRead) {
  std::ofstream(folder_ / "ICE.py") << R"(
NIGHTLYTESTS = [ ("advect",  "advect.ups", 1, "All", ["exactComparison"]),
                 ("slabs", "sub/slabs.ups", 3, "All", ["no_restart", "abs_tolerance=1e-5"]),
  #              ("gone", "gone.ups", 1, "All"),
                 ("tube", 'tube.ups', 1.1, "Linux"),
               ]
def getTestList(me): return NIGHTLYTESTS
)";
  const auto tests = read_suite_list(folder_ / "ICE.py");
  ASSERT_EQ(tests.size(), 3U);
  RegressCase c;
  c.restart_in_the_middle = true;
  c.deck = "any/slabs.ups";
  for (const SuiteTest& test : tests) test.apply(c);
  EXPECT_EQ(c.ranks, 3);
  EXPECT_EQ(c.absolute, 1e-5);
  EXPECT_EQ(c.tolerance, 1e-6);
  EXPECT_FALSE(c.restart_in_the_middle);
  c.deck = "advect.ups";
  tests[0].apply(c);
  EXPECT_EQ(c.absolute + c.tolerance, 0);
  std::ofstream(folder_ / "bad.py") << R"(T = [("a", "a.ups", 1, "All", ["abs_tolerance=x"])])";
  EXPECT_THROW(read_suite_list(folder_ / "bad.py"), InputError);
}

}  // namespace
}  // namespace sluice::regress_folder_test
