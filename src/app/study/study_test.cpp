// Reading studies, their runs, and what is concluded from the results.
#include "app/study/study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/process/study_process.hpp"
#include "app/study/study_measure.hpp"
#include "app/study/study_report.hpp"
#include "app/study/study_run.hpp"
#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::study_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class StudyFolder : public testing::Test {
 protected:
  StudyFolder() { std::ofstream(folder_ / "deck.ups") << "<Uintah_specification/>"; }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string refusal(const std::string& text) const {
    try {
      read_study(write("bad.study", text));
    } catch (const InputError& fault) {
      return fault.what();
    }
    return "accepted";
  }

  // A memory folder may refuse to run programs.
  TemporaryFolder folder_{TemporaryFolder::Place::disk};
};

const char* const two_ladders = R"({
  // order and Courant number
  "title": "Tube", "deck": "deck.ups", "variable": "vel_CC.y", "norm": "l2",
  "set": "Time/maxTime=0.1",
  "resolution": [[100,1,1], [200,1,1]],
  "ladders": [
    {"name": "order", "default": "2",
     "values": {"2": "a/@type=SecondOrder", "1": ["a/@type=FirstOrder", "b="]}},
    {"name": "CFL", "default": "0.4", "values": {"0.4": "c=0.4", "0.2": "c=0.2"}}],
  "targets": [0.1]
})";

TEST_F(StudyFolder, EveryCombinationRunsAtEveryResolution) {
  const Study study = read_study(write("tube.study", two_ladders));
  EXPECT_EQ(study.deck, (folder_ / "deck.ups").string());
  EXPECT_EQ(study.variable, "vel_CC");
  EXPECT_EQ(study.component, 1);
  EXPECT_THAT(study.targets, testing::ElementsAre(.1));
  const auto points = points_of(study);
  ASSERT_EQ(points.size(), 8u);
  EXPECT_EQ(points[0].setting, "order 2, CFL 0.4");
  EXPECT_TRUE(points[0].is_default);
  EXPECT_EQ(points[1].cells(), 200);
  EXPECT_EQ(points[7].setting, "order 1, CFL 0.2");
  EXPECT_FALSE(points[7].is_default);
  EXPECT_THAT(points[7].overrides,
              testing::ElementsAre("Time/maxTime=0.1", "a/@type=FirstOrder", "b=", "c=0.2",
                                   "Grid/Level/Box/resolution=[200,1,1]"));
  EXPECT_TRUE(matches(points[7], "order 1"));
  EXPECT_TRUE(matches(points[7], "*CFL 0.2*N 200"));
  EXPECT_FALSE(matches(points[7], "*N 100"));
}

TEST_F(StudyFolder, AReferenceIsARunOfItsOwn) {
  const Study study = read_study(write("finer.study", R"({
    "title": "Tube", "deck": "deck.ups", "variable": "p.x", "reduce": "mean", "material": 1,
    "set": "Time/maxTime=0.1",
    "resolution": [[100,1,1]], "reference": {"resolution": [800,1,1], "set": ["c=0.1"]}})"));
  EXPECT_EQ(study.material, 1);
  EXPECT_EQ(study.variable, "p.x");
  const StudyPoint point = reference_point(study);
  EXPECT_EQ(point.cells(), 800);
  EXPECT_THAT(point.overrides, testing::ElementsAre("Time/maxTime=0.1", "c=0.1",
                                                    "Grid/Level/Box/resolution=[800,1,1]"));
  EXPECT_THAT(refusal(R"({"title": "T", "deck": "deck.ups", "resolution": [[1,1,1]],
                          "reference": {"set": []}})"),
              HasSubstr("\"reference\" needs \"resolution\""));
}

TEST_F(StudyFolder, AFormulaOrANumberMayBeExact) {
  const std::string head = R"({"title": "T", "deck": "deck.ups", "resolution": [[1,1,1]], )";
  const Study stress = read_study(write("stress.study", head + R"("variable": "p.stress.yz",
      "exact": "2*x", "within": [[0,0,0], [1,2,3]], "offset": 300, "component": "solids",
      "default_is_slower_because": "It is."})"));
  EXPECT_EQ(stress.variable, "p.stress");
  EXPECT_EQ(stress.component, 5);
  EXPECT_EQ(stress.exact, "2*x");
  EXPECT_EQ(stress.within->second, (Vec3{1, 2, 3}));
  EXPECT_EQ(stress.offset, 300);
  EXPECT_EQ(stress.part, "solids");
  EXPECT_EQ(stress.why_slower, "It is.");
  const Study length = read_study(write(
      "length.study", head + R"("variable": "p.x.y", "reduce": "largest", "exact": 0.02145})"));
  EXPECT_EQ(length.variable, "p.x");
  EXPECT_EQ(length.component, 1);
  EXPECT_EQ(length.reduce, "largest");
  EXPECT_EQ(std::stod(*length.exact), 0.02145);
  EXPECT_THAT(refusal(head + R"("reduce": "median"})"), HasSubstr("unknown \"reduce\""));
  EXPECT_THAT(refusal(head + R"("reduce": "mean"})"), HasSubstr("needs \"exact\""));
  EXPECT_THAT(refusal(head + R"("exact": "2*"})"), HasSubstr("2*"));
  EXPECT_THAT(refusal(head + R"("exact": 1, "reference": {"resolution": [2,1,1]}})"),
              HasSubstr("exclude each other"));
  EXPECT_THAT(refusal(head + R"("variable": "p.stress.xx", "reference": {"resolution": [2,1,1]}})"),
              HasSubstr("needs \"reduce\""));
  EXPECT_THAT(refusal(head + R"("component": "flud"})"), HasSubstr("did you mean 'fluid'"));
  EXPECT_THAT(refusal(head + R"("within": [[0,0,0]]})"), HasSubstr("two corners"));
}

TEST_F(StudyFolder, TheErrorOfAReferenceIsThatOfHalfItsCells) {
  const std::string head = R"({"title": "T", "deck": "deck.ups", "resolution": [[10,1,1]],
      "reference": {"resolution": )";
  const auto coarser =
      coarser_reference_point(read_study(write("even.study", head + "[80,4,1]}}")));
  ASSERT_TRUE(coarser);
  EXPECT_EQ(coarser->resolution, (IntVec3{40, 2, 1}));
  EXPECT_EQ(coarser->overrides.back(), "Grid/Level/Box/resolution=[40,2,1]");
  EXPECT_FALSE(coarser_reference_point(read_study(write("odd.study", head + "[30,15,1]}}"))));
}

TEST_F(StudyFolder, AVariableThatIsNotSavedIsRefusedBeforeAnyRun) {
  std::ofstream(folder_ / "deck.ups") << "<Uintah_specification><DataArchiver>"
                                         "<save label=\"press_CC\"/></DataArchiver>"
                                         "</Uintah_specification>";
  const auto refused = [&](const std::string& more) -> std::string {
    const Study study = read_study(write(
        "some.study", R"({"title": "T", "deck": "deck.ups", "resolution": [[1,1,1]], )" + more));
    try {
      require_measurable(study);
    } catch (const InputError& fault) {
      return fault.what();
    }
    return "";
  };
  EXPECT_THAT(refused(R"("variable": "pres_CC", "exact": 1})"),
              HasSubstr("does not save \"pres_CC\" (did you mean 'press_CC'?"));
  EXPECT_THAT(refused(R"("variable": "press_CC"})"), HasSubstr("names no <Meta>"));
  EXPECT_EQ(refused(R"("variable": "press_CC", "exact": 1})"), "");
  EXPECT_EQ(refused(R"("variable": "lost energy"})"), "");
  EXPECT_EQ(refused(R"("variable": "rho_CC", "exact": 1,
                       "set": "DataArchiver/save[2]/@label=rho_CC"})"),
            "");
}

TEST_F(StudyFolder, SaysWhatIsWrongWithAStudy) {
  const std::string head = R"({"title": "T", "deck": "deck.ups", )";
  EXPECT_THAT(refusal("{"), HasSubstr("this is not JSON"));
  EXPECT_THAT(refusal(R"({"title": "T"})"), HasSubstr("entry \"deck\" is missing"));
  EXPECT_THAT(refusal(R"({"title": "T", "deck": "no.ups"})"), HasSubstr("no.ups is neither at"));
  EXPECT_THAT(refusal(head + R"("norm": "l3", "resolution": [[1,1,1]]})"),
              HasSubstr("unknown norm \"l3\""));
  EXPECT_THAT(refusal(head + R"("resolutions": [[1,1,1]]})"),
              HasSubstr("unknown entry \"resolutions\" (did you mean 'resolution'?"));
  EXPECT_THAT(refusal(head + R"("resolution": [[0,1,1]]})"), HasSubstr("whole numbers from 1 on"));
  EXPECT_THAT(refusal(head + R"("resolution": [[1,1,1]], "set": "cfl"})"),
              HasSubstr("\"cfl\" is not an override"));
  EXPECT_THAT(refusal(head + R"("resolution": [[1,1,1]], "variable": "vel_CC.u"})"),
              HasSubstr("must be x, y or z"));
  EXPECT_THAT(refusal(head + R"("resolution": [[1,1,1]],
                "ladders": [{"name": "order", "default": "3", "values": {"1": "a=b"}}]})"),
              HasSubstr("the default \"3\" is none of its values"));
  EXPECT_THROW(read_study("nowhere.study"), InputError);
}

// Those of regression/accuracy: each can be measured, and every component has at least six.
TEST(Studies, CoverEveryComponent) {
  std::map<std::string, int> counts;
  for (const auto& entry : fs::directory_iterator(SLUICE_SOURCE_DIR "/regression/accuracy")) {
    const Study study = read_study(entry.path().string());
    EXPECT_NO_THROW(require_measurable(study)) << entry.path();
    EXPECT_FALSE(study.part.empty()) << entry.path();
    ++counts[study.part];
  }
  EXPECT_EQ(counts.size(), 7u);
  for (const auto& [part, count] : counts) EXPECT_GE(count, 6) << part;
}

StudyResult result(const std::string& setting, int n, double error, double seconds) {
  StudyResult r;
  r.point.setting = setting;
  r.point.is_default = setting == "B";
  r.point.resolution = {n, 1, 1};
  r.status = "done";
  r.seconds = seconds;
  r.repeats = 3;
  r.error = error;
  r.norms.relative_l1 = error;
  return r;
}

StudyReport two_settings() {
  StudyReport report;
  report.study.title = "T";
  report.study.targets = {.02, .001};
  report.results = {result("A", 100, .04, 1), result("A", 200, .02, 4), result("A", 400, .01, 16),
                    result("B", 100, .03, .5), result("B", 200, .0075, 2)};
  return report;
}

TEST(StudyReport, ObservedOrderAndFront) {
  const StudyReport report = two_settings();
  EXPECT_FALSE(report.observed_order(0));
  EXPECT_NEAR(*report.observed_order(1), 1, 1e-14);
  EXPECT_FALSE(report.observed_order(3));  // first rung of another setting
  EXPECT_NEAR(*report.observed_order(4), 2, 1e-14);
  std::string front;
  for (std::size_t i = 0; i < 5; ++i) front += report.on_front(i) ? '*' : '.';
  EXPECT_EQ(front, "...**");
}

TEST(StudyReport, CostsAreReadBetweenTheRungs) {
  const auto costs = costs_of_target(two_settings(), .02);
  ASSERT_EQ(costs.size(), 2u);
  EXPECT_EQ(costs[0].setting, "B");  // error ~ N^-2, time ~ N^2
  EXPECT_NEAR(costs[0].cells, 100 * std::sqrt(1.5), 1e-9);
  EXPECT_NEAR(costs[0].seconds, .5 * 1.5, 1e-12);
  EXPECT_NEAR(costs[1].seconds, 4, 1e-12);  // a rung hits it
  EXPECT_TRUE(costs_of_target(two_settings(), .001).empty());
  const auto easy = costs_of_target(two_settings(), .5);
  EXPECT_TRUE(easy[0].measured);
  EXPECT_EQ(easy[0].seconds, .5);
}

TEST(StudyReport, FailedRunsAreShownAndCountForNothing) {
  StudyReport report = two_settings();
  report.results[4].status = "failed";
  report.results[4].message = "negative density";
  EXPECT_FALSE(report.observed_order(4));
  EXPECT_FALSE(report.on_front(4));
  EXPECT_EQ(costs_of_target(report, .02).size(), 1u);
  EXPECT_THAT(runs_table(report), HasSubstr("failed"));
  EXPECT_THAT(targets_table(report), HasSubstr("not reached by any run"));
  const auto json = nlohmann::json::parse(json_text(report));
  EXPECT_EQ(json["rows"][4]["message"], "negative density");
  EXPECT_TRUE(json["rows"][4]["error"].is_null());
  EXPECT_EQ(json["rows"][1]["order"], 1.0);
  std::ostringstream csv;
  write_csv(csv, report);
  EXPECT_THAT(csv.str(), HasSubstr("\nB,1,200,200,1,1,0,,,,,,,2,0,0,3,0,failed\n"));
}

TEST(StudyRun, TimingIsTheMedianAndItsQuartiles) {
  EXPECT_EQ(timing_of({3, 1, 2}).median, 2);
  EXPECT_EQ(timing_of({3, 1, 2}).spread, .5);
  EXPECT_EQ(timing_of({5}).spread, 0);
  EXPECT_EQ(timing_of({}).median, 0);
}

// A stand-in for sluice that fails in the ways a run can fail.
class FailingRuns : public StudyFolder {
 protected:
  StudyResult run(const std::string& script) const {
    const fs::path program = folder_ / "sluice";
    std::ofstream(program) << "#!/bin/sh\n"
                           << "while [ \"$1\" != --json ]; do shift; done; json=$2\n"
                           << script << "\n";
    fs::permissions(program, fs::perms::owner_all);
    Study study = read_study(write("tube.study", two_ladders));
    StudyRunner runner;
    runner.executable = program;
    runner.folder = folder_ / "out";
    return runner.run(study, points_of(study)[1]);
  }
};

TEST_F(FailingRuns, TheReasonIsKept) {
  const StudyResult failed =
      run("echo '{\"status\":\"failed\",\"steps\":7,\"wall_s\":0.25}' > $json; "
          "echo negative density in cell 3; exit 1");
  EXPECT_EQ(failed.status, "failed");
  EXPECT_EQ(failed.steps, 7);
  EXPECT_EQ(failed.repeats, 1);
  EXPECT_EQ(failed.seconds, .25);
  EXPECT_THAT(failed.message, HasSubstr("negative density in cell 3"));
  EXPECT_THAT(failed.command, HasSubstr("--set 'c=0.4'"));
}

TEST_F(FailingRuns, ACrashIsAFailedRunAndABadDeckIsTheUsersFault) {
  const StudyResult crashed = run("kill -9 $$");
  EXPECT_EQ(crashed.status, "failed");
  EXPECT_THAT(crashed.message, HasSubstr("exit status 137"));
  EXPECT_THROW(run("echo unknown tag; exit 2"), InputError);
  EXPECT_THROW(run("echo '{\"status\":\"done\",\"archive\":null}' > $json"), InputError);
}

TEST(Process, MissingProgramIsNamed) {
  ProcessRequest request;
  request.words = {"/no/such/program"};
  EXPECT_THROW(run_process(request), SystemError);
}

}  // namespace
}  // namespace sluice::study_test
