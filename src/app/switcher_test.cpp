// Runs of several components in turn: what passes from one to the next, with which bits, and what
// is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "app/archive_runs_test_support.hpp"
#include "framework/base/test_support/environment.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::switcher_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

const fs::path decks = SLUICE_SOURCE_DIR "/inputs/mpm";
const std::string bar = (decks / "free_bar.ups").string();
const std::string implicit_bar = (decks / "free_bar_implicit.ups").string();
const std::string switched = (decks / "switched_bar.ups").string();

nlohmann::json report_of(const fs::path& archive) {
  return nlohmann::json::parse(text_of(archive / "run.json"), nullptr, false);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string part(const std::string& deck, int until, const std::string& more = {}) {
  std::string text = "<subcomponent><input_file>" + deck + "</input_file>";
  if (until > 0)
    text += "<SwitchCriteria type=\"Timestep\"><timestep>" + std::to_string(until) +
            "</timestep></SwitchCriteria>";
  return text + more + "</subcomponent>";
}

class Switcher : public ArchiveRuns {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    const fs::path file = folder_ / name;
    std::ofstream(file) << text;
    return file.string();
  }
  // The deck of the bar with these components.
  std::string deck_of(const std::string& parts) const {
    std::string text = text_of(switched);
    const auto from = text.find("<subcomponent>");
    const auto to = text.find("  </SimulationComponent>\n\n  <Time>");
    text.replace(from, to - from, parts + "\n");
    return write("switcher.ups", text);
  }
};

class SwitcherFaults : public Switcher {
 protected:
  void expect_refused(const std::string& deck, const std::string& says) const {
    const Outcome outcome = run_sluice({"run", deck, "-o", (folder_ / "refused").string()});
    EXPECT_EQ(outcome.status, 2) << outcome.text;
    EXPECT_THAT(outcome.text, AllOf(HasSubstr("1 fault in the deck"), HasSubstr(says)));
    EXPECT_FALSE(fs::exists(folder_ / "refused"));
    const Outcome check = run_sluice({"check", deck});
    EXPECT_EQ(check.status, 2) << check.text;
    EXPECT_THAT(check.text, AllOf(HasSubstr("1 error,"), HasSubstr(says)));
  }
};

// Measured: mass 0, momentum x 2e-16 of its scale.
constexpr double round_off = 1e-14;

void expect_kept(const nlohmann::json& report) {
  const auto& kept = report.at("conservation");
  EXPECT_LT(std::abs(kept.at("mass of material 0").at("drift").get<double>()), round_off);
  EXPECT_LT(std::abs(kept.at("momentum x").at("drift").get<double>()), round_off);
  EXPECT_NEAR(kept.at("momentum x").at("start").get<double>(), 2e-4, 1e-16);
}

TEST_F(Switcher, ExplicitStepsGoOnAsImplicitOnes) {
  const fs::path archive = run("run", switched);
  const nlohmann::json report = report_of(archive);
  expect_kept(report);
  EXPECT_LT(report.at("steps").get<int>(), 65);  // 100 of explicit steps alone
  const auto& event = report.at("events").at("next component");
  EXPECT_EQ(event.at("count"), 1);
  EXPECT_EQ(event.at("first").at("step"), 20);
  EXPECT_EQ(event.at("first").at("task"), "mpm -> impm");
  // The archive names what it ran: it needs no other file.
  EXPECT_THAT(text_of(archive / "input.xml"), HasSubstr("input_1.xml"));
  EXPECT_TRUE(fs::exists(archive / "input_2.xml"));
}

TEST_F(Switcher, ImplicitStepsGoOnAsExplicitOnes) {
  const nlohmann::json report =
      report_of(run("run", deck_of(part(implicit_bar, 7) + part(bar, 0))));
  expect_kept(report);
  EXPECT_EQ(report.at("events").at("next component").at("first").at("task"), "impm -> mpm");
}

// A switch to the same component changes no bit, wherever it is.
TEST_F(Switcher, ToItselfChangesNoBit) {
  const fs::path plain = run("plain", bar);
  const fs::path thrice = run("thrice", deck_of(part(bar, 13) + part(bar, 40) + part(bar, 0)));
  expect_same(plain, thrice);
  EXPECT_EQ(report_of(thrice).at("events").at("next component").at("count"), 2);
  EXPECT_EQ(report_of(thrice).at("conservation"), report_of(plain).at("conservation"));
  const fs::path plain_implicit = run("plain_implicit", implicit_bar);
  expect_same(plain_implicit,
              run("twice", deck_of(part(implicit_bar, 13) + part(implicit_bar, 0))));
}

// Before the switch, at it, and after it; the decks of the components come from the archive.
TEST_F(Switcher, RestartsOnBothSidesHaveTheSameBits) {
  const fs::path whole = run("whole", switched);
  for (const int step : {12, 20, 33}) {
    const std::string at = std::to_string(step);
    const fs::path first = run("first" + at, switched + " --max-steps " + at);
    const fs::path second = run("second" + at, "--restart " + first.string());
    expect_same(whole, second);
    EXPECT_EQ(report_of(second).at("events"), report_of(whole).at("events"));
    EXPECT_EQ(report_of(second).at("conservation"), report_of(whole).at("conservation"));
  }
}

TEST_F(Switcher, RanksAndBoxesHaveTheSameBits) {
  expect_same(run("one", switched), run("two", switched + " --boxes 3,1,1", 2));
}

TEST_F(Switcher, PlanSaysWhatPassesOn) {
  const Outcome plan = run_sluice({"plan", switched});
  EXPECT_EQ(plan.status, 0);
  EXPECT_THAT(plan.text, AllOf(HasSubstr("impm takes over particles of 'bar': p.velocity, "),
                               HasSubstr("; p.acceleration zero, as at the start of a run"),
                               HasSubstr("init p.acceleration: zero, as at the start of a run")));
}

TEST_F(SwitcherFaults, OfFiles) {
  expect_refused(deck_of(part("nowhere.ups", 5) + part("nowhere.ups", 0)),
                 "switcher.ups:15:19: error: <input_file>: the deck 'nowhere.ups' does not exist "
                 "(searched in the folder of this deck");
  expect_refused(deck_of(part("", 0)), "<input_file>: the deck '' does not exist");
  expect_refused(deck_of("<subcomponent/>"), "<subcomponent> needs <input_file>");
  expect_refused(deck_of(""), "has no <subcomponent>: nothing to run");
  const std::string inner = deck_of(part(bar, 0));
  fs::rename(inner, folder_ / "inner.ups");
  expect_refused(deck_of(part("inner.ups", 0)), "a switcher inside the switcher of ");
  expect_refused(deck_of(part(SLUICE_SOURCE_DIR "/inputs/ice/riemann_sod.ups", 0)),
                 "the component 'ice' in a switcher is known to the format, but not supported yet");
  expect_refused(deck_of(part(bar, 0, "<SimulationComponent type=\"impm\"/>")),
                 "but the deck of this component says 'mpm'");
}

TEST_F(SwitcherFaults, OfCriteria) {
  expect_refused(deck_of(part(bar, 5)), "<SwitchCriteria> in the last <subcomponent>");
  expect_refused(deck_of(part(bar, 0) + part(bar, 0)), "<subcomponent> 1 of 2 has no");
  expect_refused(deck_of(part(bar, 9) + part(bar, 9) + part(bar, 0)), "10 or more");
  const auto by = [](const std::string& type, const std::string& tag) {
    return part(
        bar, 0,
        "<SwitchCriteria type=\"" + type + "\"><" + tag + ">3</" + tag + "></SwitchCriteria>");
  };
  for (const std::string type : {"steadyBurn", "simpleBurn", "DDT1"})
    expect_refused(deck_of(by(type, "reactant_material") + part(bar, 0)),
                   "'" + type + "' is known to the format, but not supported yet");
  expect_refused(deck_of(by("Volume", "timestep") + part(bar, 0)),
                 "'Volume' is not a valid word (valid: Timestep)");
}

// A component's steps rest on its own; that of the run's deck has no effect.
TEST_F(SwitcherFaults, OfAMultiplierOfZero) {
  const auto with = [](std::string text, const std::string& value) {
    return replaced(std::move(text), "<timestep_multiplier>" + value + "<",
                    "<timestep_multiplier>0<");
  };
  const std::string zero = write("zero.ups", with(text_of(bar), "0.4"));
  expect_refused(deck_of(part(zero, 0)), "zero.ups:21:5: error: <timestep_multiplier>: '0' is out");
  const std::string whole = deck_of(part(bar, 0));
  write("switcher.ups", with(text_of(whole), "1"));
  const Outcome outcome = run_sluice({"check", whole});
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("<timestep_multiplier> 0 has no effect"));
}

TEST_F(SwitcherFaults, OfStates) {
  const std::string text = text_of(bar);
  const std::string plastic =
      write("plastic.ups",
            replaced(replaced(text, "comp_neo_hook", "comp_neo_hook_plastic"), "</shear_modulus>",
                     "</shear_modulus><yield_stress>1</yield_stress>"
                     "<hardening_modulus>0</hardening_modulus>"));
  expect_refused(deck_of(part(bar, 5) + part(plastic, 0)),
                 "which the particles of the earlier component do not have");
  const auto from = text.find("<material name"), to = text.find("</material>");
  const std::string two = write(
      "two.ups",
      replaced(text, "</material>", "</material>" + text.substr(from, to - from) + "</material>"));
  expect_refused(deck_of(part(bar, 5) + part(two, 0)), "2 materials, but 1 before");
}

// Decks of the public suite.
class PublicSwitchers : public Switcher {
 protected:
  void SetUp() override {
    const auto folder = folder_in_environment("SLUICE_DECKS");
    if (!folder) GTEST_SKIP() << "SLUICE_DECKS is not set: no collection of decks";
    suite_ = folder->string() + "/inputs/MPM/";
  }
  std::string suite_;
};

TEST_F(PublicSwitchers, RunAcrossTheirSwitch) {
  for (const std::string name : {"exp-imp", "imp-exp"}) {
    const nlohmann::json report =
        report_of(run(name, suite_ + name + ".ups --set Time/max_Timesteps=7"));
    EXPECT_EQ(report.at("events").at("next component").at("first").at("step"), 5) << name;
    EXPECT_LT(std::abs(report.at("conservation").at("momentum z").at("drift").get<double>()),
              1e-12);
  }
  const Outcome check = run_sluice({"check", suite_ + "multidisks.ups"});
  EXPECT_EQ(check.status, 2);
  EXPECT_THAT(check.text, HasSubstr("'inputs/MPM/disks_include1.ups' does not exist"));
}

}  // namespace
}  // namespace sluice::switcher_test
