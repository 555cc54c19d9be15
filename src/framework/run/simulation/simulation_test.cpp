// Whole runs of a mock component: ends, acceptance, failure, archives, restart.
#include "framework/run/simulation/simulation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/archive/archive.hpp"
#include "framework/archive/compare/compare.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/run/test_support/mock_component.hpp"

namespace sluice::simulation_test {
namespace {

using namespace run_test;
namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class Runs : public testing::Test {
 protected:
  // A tube that saves a step label, a diagnostic and a history.
  static Scene saving_tube(int boxes = 1) {
    Scene scene = tube(boxes);
    scene.output.filebase = "tube.uda";
    scene.output.timestep_interval = 4;
    scene.output.initial_timestep = true;
    scene.output.checkpoint.timestep_interval = 4;
    scene.output.checkpoint.cycle = 0;
    const auto save = [&](const char* label) {
      SaveRequest r;
      r.label = label;
      scene.output.saves.push_back(r);
    };
    mock_labels();
    for (const char* label : {"mock_flux", "mock_square", "MockTotal"}) save(label);
    return scene;
  }
  RunOptions options(const char* sub) const {
    RunOptions o;
    o.parent = folder_ / sub;
    fs::create_directories(o.parent);
    o.progress = ProgressMode::none;
    o.deck_xml = "<Uintah_specification/>";
    return o;
  }
  static RunReport run(const Scene& scene, const MockComponent& component, const RunOptions& o) {
    return Simulation(scene, component, world(), o).run();
  }
  static MockComponent mock(const Scene& scene) { return MockComponent(scene.grid.levels.front()); }
  TemporaryFolder folder_;
};

TEST_F(Runs, EndExactlyAtTheTimeAskedForAndKeepTheTotals) {
  const Scene scene = tube();
  RunOptions o = options("end");
  o.output = false;
  const RunReport r = run(scene, mock(scene), o);
  EXPECT_EQ(r.status, RunStatus::done);
  EXPECT_EQ(r.time, 1);
  EXPECT_EQ(r.steps, 16);  // of half a cell
  EXPECT_EQ(r.cells, 40);
  EXPECT_FALSE(r.archive);
  EXPECT_EQ(r.step_limit, "mock: greed dx");
  EXPECT_LE(r.worst_drift, 1e-15);
  EXPECT_EQ(r.events_json, "{}");
  EXPECT_TRUE(fs::is_empty(o.parent));
}

TEST_F(Runs, GreedyStepsAreRedoneSmallerAndCounted) {
  const Scene scene = tube();
  MockComponent greedy = mock(scene);
  greedy.greed = 3;  // of dx: 3, 1.5, 0.75
  RunOptions o = options("greedy");
  o.output = false;
  const RunReport r = run(scene, greedy, o);
  EXPECT_EQ(r.status, RunStatus::done);
  const auto events = nlohmann::json::parse(r.events_json);
  const auto& smaller = events.at("step redone with a smaller one");
  EXPECT_GE(smaller.at("count").get<int>(), r.steps);
  EXPECT_EQ(smaller.at("first").at("step").get<int>(), 1);
  EXPECT_LE(r.worst_drift, 1e-15);
}

TEST_F(Runs, AFaultThatMaskingCuresNeedsNoSmallerStep) {
  const Scene scene = tube();
  MockComponent c = mock(scene);
  c.most = 1.6;
  RunOptions o = options("masked");
  o.output = false;
  const RunReport r = run(scene, c, o);
  EXPECT_EQ(r.status, RunStatus::done);
  EXPECT_EQ(r.steps, 16);
  const auto events = nlohmann::json::parse(r.events_json);
  EXPECT_TRUE(events.contains("step redone with first-order faces"));
  EXPECT_FALSE(events.contains("step redone with a smaller one"));
}

TEST_F(Runs, AHopelessStepFailsInWordsWithACheckpointOfTheLastGoodState) {
  const Scene scene = saving_tube();
  MockComponent c = mock(scene);
  c.fails_after = 0.4;  // six steps are good: the seventh ends at .4375
  const RunReport r = run(scene, c, options("fail"));
  EXPECT_EQ(r.status, RunStatus::failed);
  EXPECT_EQ(r.last_step, 7);
  EXPECT_THAT(r.message, AllOf(HasSubstr("step 8"), HasSubstr("cell [0, 0, 0]"),
                               HasSubstr("courant number"), HasSubstr("task 'update'")));
  EXPECT_LE(r.worst_drift, 1e-15);  // of the steps that were accepted
  const Archive archive = Archive::open(r.archive.value());
  EXPECT_EQ(archive.checkpoints().back().step, 7);
  std::int64_t values = 0;
  EXPECT_TRUE(archive.read_checkpoint(archive.checkpoints().back()).verify(values).empty());
}

TEST_F(Runs, ArchivesHoldWhatTheDeckAskedFor) {
  const Scene scene = saving_tube(3);
  const RunReport r = run(scene, mock(scene), options("archive"));
  const Archive archive = Archive::open(r.archive.value());
  std::vector<int> steps;
  for (const StepEntry& e : archive.outputs()) steps.push_back(e.step);
  EXPECT_THAT(steps, testing::ElementsAre(0, 4, 8, 12, 16));
  const ArchiveStep first = archive.read_output(archive.outputs().front());
  EXPECT_EQ(first.find("mock_flux", 0, 0), nullptr);  // there is no step before the start
  ASSERT_NE(first.find("mock_square", 0, 0), nullptr);
  const ArchiveStep last = archive.read_output(archive.outputs().back());
  const FieldInfo* flux = last.find("mock_flux", 0, 0);
  ASSERT_NE(flux, nullptr);
  EXPECT_EQ(last.range(*flux), (IndexBox{{0, 0, 0}, {41, 1, 1}}));  // the closing face, once
  EXPECT_TRUE(fs::exists(archive.folder() / "MockTotal.dat"));
  EXPECT_TRUE(fs::exists(archive.folder() / "run.json"));
}

TEST_F(Runs, ARestartOnOtherBoxesGivesTheSameBits) {
  const Scene scene = saving_tube(), other = saving_tube(4);
  const RunReport whole = run(scene, mock(scene), options("whole"));
  RunOptions o = options("half");
  o.limits.max_steps = 10;
  const RunReport half = run(scene, mock(scene), o);
  EXPECT_EQ(half.status, RunStatus::max_steps);
  EXPECT_EQ(Archive::open(half.archive.value()).select_checkpoint().step, 10) << "of its end";
  o = options("rest");
  o.restart = half.archive.value();
  o.restart_step = 9;
  const RunReport rest = run(other, mock(other), o);
  EXPECT_EQ(rest.status, RunStatus::done);
  EXPECT_EQ(rest.last_step, 16);
  EXPECT_EQ(rest.steps, 16 - 9);  // from the checkpoint of step 9
  CompareOptions compare_all;
  const CompareResult same = compare(Archive::open(whole.archive.value()),
                                     Archive::open(rest.archive.value()), compare_all);
  EXPECT_EQ(same.exit_status(), 0);
  EXPECT_GT(same.values, 0);
  EXPECT_EQ(rest.conservation_json, whole.conservation_json);
}

TEST_F(Runs, ARestartStepsAsTheDeckSaysNow) {
  const Scene scene = saving_tube();
  RunOptions o = options("half");
  o.limits.max_steps = 10;
  const RunReport half = run(scene, mock(scene), o);
  o = options("rest");
  o.restart = half.archive.value();
  o.restart_step = 9;
  o.limits.max_steps = 10;
  MockComponent slower = mock(scene);
  slower.greed = 0.25;
  const RunReport rest = run(scene, slower, o);
  EXPECT_EQ(rest.steps, 1);
  const double cell = scene.grid.levels.front().spacing.x;
  EXPECT_EQ(half.time, 10 * 0.5 * cell);
  EXPECT_EQ(rest.time, 9 * 0.5 * cell + 0.25 * cell);
}

TEST_F(Runs, UnknownLabelsAreRefusedWithTheNearestName) {
  Scene scene = saving_tube();
  scene.output.saves.front().label = "mock_flx";
  const MockComponent c = mock(scene);
  try {
    run(scene, c, options("unknown"));
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("mock_flx"), HasSubstr("mock_flux")));
  }
}

}  // namespace
}  // namespace sluice::simulation_test
