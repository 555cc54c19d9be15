// Reading hard cases, verdicts, margins, changes, and how far a deck is from failing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/loading/deck_scaling.hpp"
#include "app/stability/deck_stability.hpp"
#include "app/stability/stability_series.hpp"
#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::stability_test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class StabilityFolder : public testing::Test {
 protected:
  StabilityFolder() { std::ofstream(folder_ / "deck.ups") << "<Uintah_specification/>"; }

  std::string write(const std::string& text) const {
    std::ofstream(folder_ / "block.stability") << text;
    return (folder_ / "block.stability").string();
  }
  std::string refusal(const std::string& text) const {
    try {
      read_stability_case(write(text));
    } catch (const InputError& fault) {
      return fault.what();
    }
    return "accepted";
  }

  TemporaryFolder folder_;
};

const char* const two_sweeps = R"({
  // step and resolution
  "title": "Block", "component": "solids", "deck": "deck.ups", "set": "a=1", "quick": true,
  "must_hold": [{"quantity": "total energy", "drift_at_most": 0.01}],
  "sweeps": [
    {"name": "multiplier", "default": "0.4", "limit": 0.8,
     "values": {"0.2": "m=0.2", "0.4": "m=0.4", "0.8": "m=0.8", "1.2": "m=1.2"}},
    {"name": "basis", "default": "gimp", "values": {"gimp": "b=gimp", "cpdi": ["b=cpdi", "c=1"]}}]
})";

TEST_F(StabilityFolder, EachValueOfEachSweepIsARunAndTheDefaultIsOne) {
  const StabilityCase hard = read_stability_case(write(two_sweeps));
  EXPECT_EQ(hard.name, "block");
  EXPECT_TRUE(hard.quick);
  ASSERT_EQ(hard.must_hold.size(), 1u);
  EXPECT_EQ(hard.must_hold[0]->text(), "total energy drifts at most 0.01 of its scale");
  const auto points = points_of(hard);
  ASSERT_EQ(points.size(), 5u);
  EXPECT_THAT(points[0].overrides, ElementsAre("a=1"));
  EXPECT_THAT(points[1].overrides, ElementsAre("a=1", "m=0.2"));
  EXPECT_THAT(points[4].overrides, ElementsAre("a=1", "b=cpdi", "c=1"));
  EXPECT_TRUE(hard.sweeps[0].values[2].counts);
  EXPECT_FALSE(hard.sweeps[0].values[3].counts);
}

std::string with_bound(const std::string& bound) {
  return R"({"title": "t", "component": "fluid", "deck": "deck.ups", "must_hold": [)" + bound +
         "]}";
}

TEST_F(StabilityFolder, FaultsOfFilesAreNamed) {
  EXPECT_THAT(refusal("{"), HasSubstr("block.stability: this is not JSON"));
  EXPECT_THAT(refusal(R"({"titel": "t"})"), HasSubstr("did you mean 'title'"));
  EXPECT_THAT(refusal(R"({"title": "t", "component": "flud"})"), HasSubstr("'fluid'"));
  EXPECT_THAT(refusal(R"({"title": "t", "component": "fluid", "deck": "no.ups"})"),
              HasSubstr("no.ups is neither at"));
  EXPECT_THAT(refusal(R"({"title": "t", "component": "fluid", "deck": "deck.ups"})"),
              HasSubstr("\"must_hold\" is missing"));
  EXPECT_THAT(refusal(with_bound(R"({"quantity": "total energy"})")),
              HasSubstr("one of \"drift_at_most\" and \"grows_at_most\""));
  EXPECT_THAT(refusal(with_bound(R"({"variabel": "p.x"})")), HasSubstr("did you mean 'variable'"));
  EXPECT_THAT(refusal(with_bound(R"({"variable": "p.x"})")),
              HasSubstr("bounds of p.x are missing"));
  EXPECT_THAT(refusal(with_bound(R"({"variable": "p.x", "at_most": "1"})")),
              HasSubstr("\"at_most\" must be a number"));
  EXPECT_THAT(refusal(with_bound(R"({"variable": "p.x", "at_most": 1, "when": "now"})")),
              HasSubstr("unknown time of a bound \"now\""));
  EXPECT_EQ(refusal(with_bound(R"({"event": "particle left the domain", "at_most": 0})")),
            "accepted");
}

TEST(Requirement, BoundsAreCheckedAgainstTheReport) {
  const Json report = Json::parse(R"({
    "conservation": {"total energy": {"drift": -0.03, "scale": 2}},
    "energy_account": {"transfer": -0.2, "contact": 0.1, "within particles": -5},
    "events": {"step redone with a smaller one": {"count": 3, "first": {"step": 7}}}})");
  const std::string archive;
  const auto found = [&](const std::string& bound) {
    const TemporaryFolder folder;
    const std::string name = (folder / "x.stability").string();
    std::ofstream(name) << with_bound(bound);
    std::ofstream(folder / "deck.ups") << "<Uintah_specification/>";
    return read_stability_case(name).must_hold[0]->check({report, archive});
  };
  EXPECT_TRUE(found(R"({"quantity": "total energy", "drift_at_most": 0.03})").held);
  EXPECT_FALSE(found(R"({"quantity": "total energy", "drift_at_most": 0.02})").held);
  EXPECT_TRUE(found(R"({"quantity": "total energy", "grows_at_most": 0})").held);
  const Finding lost = found(R"({"lost_energy_at_most": 0.04})");
  EXPECT_FALSE(lost.held);
  EXPECT_NEAR(lost.value, .05, 1e-15);
  EXPECT_FALSE(found(R"({"event": "step redone with a smaller one", "at_most": 2})").held);
  EXPECT_TRUE(found(R"({"event": "another", "at_most": 0})").held);
  EXPECT_THROW(found(R"({"quantity": "mass of gas", "drift_at_most": 1})"), InputError);
}

// A map of the case above with these verdicts of 0.2, the default, 0.8 and 1.2.
CaseMap map_with(const StabilityCase& hard, const std::vector<StabilityVerdict>& verdicts) {
  CaseMap map{hard, {}};
  for (const StabilityPoint& point : points_of(hard)) {
    StabilityResult r;
    r.point = point;
    r.verdict = StabilityVerdict::green;
    if (point.sweep < 0) r.verdict = verdicts[1];
    if (point.sweep == 0) r.verdict = verdicts[point.value];
    map.results.push_back(std::move(r));
  }
  return map;
}

TEST_F(StabilityFolder, TheMarginEndsAtTheFirstFailureAboveTheDefault) {
  constexpr StabilityVerdict green = StabilityVerdict::green, amber = StabilityVerdict::amber,
                             red = StabilityVerdict::red;
  const StabilityCase hard = read_stability_case(write(two_sweeps));
  EXPECT_EQ(map_with(hard, {green, green, green, red}).margin(0), 2);
  EXPECT_EQ(map_with(hard, {green, green, amber, green}).margin(0), 1);
  EXPECT_EQ(map_with(hard, {green, red, green, green}).margin(0), 0);
  const CaseMap whole = map_with(hard, {red, green, green, green});
  EXPECT_NEAR(whole.margin(0).value(), 3, 1e-12);
  EXPECT_TRUE(whole.never_failed_above(0));
  EXPECT_EQ(whole.margin(1), std::nullopt);
}

TEST_F(StabilityFolder, WhatIsBeyondTheLimitDoesNotCount) {
  constexpr StabilityVerdict green = StabilityVerdict::green, red = StabilityVerdict::red;
  const StabilityCase hard = read_stability_case(write(two_sweeps));
  const MapTotals totals = totals_of({map_with(hard, {green, green, red, red})});
  EXPECT_EQ(totals.points, 4);
  EXPECT_EQ(totals.points_held, 3);
  EXPECT_EQ(totals.defaults_held, 1);
}

TEST_F(StabilityFolder, ChangesSinceARecordedMapAreTold) {
  constexpr StabilityVerdict green = StabilityVerdict::green, amber = StabilityVerdict::amber,
                             red = StabilityVerdict::red;
  const StabilityCase hard = read_stability_case(write(two_sweeps));
  const auto before = {map_with(hard, {green, green, green, red})};
  const auto now = {map_with(hard, {green, green, amber, green})};
  for (const Json& recorded : {map_json(before), verdicts_json(before)}) {
    const MapChanges changes = changes_since(recorded, now);
    EXPECT_THAT(changes.worse, ElementsAre("block, multiplier 0.8: amber, was green"));
    EXPECT_THAT(changes.better, ElementsAre("block, multiplier 1.2: green, was red"));
    EXPECT_TRUE(changes_since(recorded, before).worse.empty());
  }
  EXPECT_THROW(changes_since(Json::object(), now), JsonError);
}

class SweptDeck : public testing::Test {
 protected:
  // Runs are green up to these factors of step and moduli.
  DeckStability sweep(double step, double stiff, double budget = 8) {
    return sweep_deck(
        SLUICE_SOURCE_DIR "/inputs/mpm/free_bar.ups", {}, budget,
        [&](const StabilityCase& hard, const StabilityPoint& point) {
          StabilityResult r;
          r.point = point;
          r.verdict = StabilityVerdict::green;
          r.steps = 100;
          const double factor =
              point.sweep < 0 ? 1 : std::stod(hard.sweeps[point.sweep].values[point.value].name);
          if (point.sweep == 0) r.steps = static_cast<int>(100 / factor);
          if ((point.sweep == 0 && factor > step) || (point.sweep == 2 && factor > stiff))
            r.verdict = StabilityVerdict::red;
          ++runs_;
          return r;
        });
  }
  int runs_ = 0;
};

TEST_F(SweptDeck, TheFactorOfTheStepIsFoundToWithinTenPercent) {
  for (const double truth : {1.02, 1.2, 1.4, 1.95, 3.7}) {
    const auto found = sweep(truth, 100);
    const DistanceToFailure& step = found.distances[0];
    EXPECT_LE(step.held, truth);
    EXPECT_GT(step.failed, truth * .999);
    EXPECT_LE(step.failed / step.held, 1.1 + 1e-12);
    EXPECT_THAT(step.text(), HasSubstr("from failing"));
  }
  const auto far = sweep(100, 2);
  EXPECT_EQ(far.distances[0].failed, 0);
  EXPECT_EQ(far.distances[0].held, 4);
  EXPECT_EQ(far.distances[1].held, .5);
  EXPECT_EQ(far.distances[2].name, "moduli of the solids");
  EXPECT_EQ(far.distances[2].held, 2);
  EXPECT_EQ(far.distances[2].failed, 4);
}

TEST_F(SweptDeck, TheBudgetEndsTheSweeps) {
  const auto found = sweep(1.4, 100, 2.5);
  EXPECT_THAT(found.distances[0].note, HasSubstr("budget"));
  EXPECT_THAT(found.distances[2].note, HasSubstr("budget"));
  EXPECT_LE(runs_, 4);
}

TEST(DeckScaling, EveryModulusIsScaledAndNothingElse) {
  const Deck deck = read_deck_text(
      "<Uintah_specification><Time><timestep_multiplier>0.5</timestep_multiplier></Time>"
      "<MaterialProperties><MPM>"
      "<material><constitutive_model type='a'><shear_modulus>1e6</shear_modulus><beta>2</beta>"
      "</constitutive_model></material>"
      "<material><constitutive_model type='b'><youngs_modulus>3</youngs_modulus>"
      "</constitutive_model></material></MPM></MaterialProperties>"
      "<Grid><Level><Box><lower>[0,0,0]</lower><upper>[4,2,0.1]</upper><resolution>[40, 20, "
      "1]</resolution></Box></Level></Grid>"
      "</Uintah_specification>",
      "deck.ups");
  EXPECT_THAT(
      stiffness_overrides(*deck.root, 2),
      ElementsAre(
          "MaterialProperties[1]/MPM[1]/material[1]/constitutive_model[1]/shear_modulus[1]=2000000",
          "MaterialProperties[1]/MPM[1]/material[2]/constitutive_model[1]/youngs_modulus[1]=6"));
  EXPECT_THAT(step_overrides(*deck.root, 1.5), ElementsAre("Time/timestep_multiplier=0.75"));
  EXPECT_THAT(resolution_overrides(*deck.root, .5),
              ElementsAre("Grid/Level[1]/Box[1]/resolution=[20,10,1]"));
}

}  // namespace
}  // namespace sluice::stability_test
